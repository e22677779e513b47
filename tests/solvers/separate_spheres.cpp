#include "separate_spheres.hpp"

namespace radiosity::testing {

exact_rooms::Room separate_spheres(int count, Index n, double reflectance) {
  exact_rooms::Room all;
  all.area.resize(count * n);
  all.reflectance = Eigen::MatrixXd::Constant(count * n, 1, reflectance);
  all.kernel = Eigen::MatrixXd::Zero(count * n, count * n);
  for (Index k = 0; k < count; ++k) {
    const exact_rooms::Room sphere =
        exact_rooms::sphere_cavity(n, static_cast<std::uint64_t>(k) + 5, reflectance);
    all.area.segment(k * n, n) = sphere.area;
    all.kernel.block(k * n, k * n, n, n) = sphere.kernel;
  }
  return all;
}

}  // namespace radiosity::testing
