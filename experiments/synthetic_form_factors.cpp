#include "experiments/synthetic_form_factors.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <memory>

namespace radiosity {

FormFactors synthetic_form_factors(Index n, Index channels) {
  auto kernel = std::make_shared<SymmetricTiles<double>>(n, [](Index, Index) { return true; });
  constexpr Index size = SymmetricTiles<double>::tile_size;
  parallel_for(static_cast<std::size_t>(kernel->tile_rows()), [&](std::size_t row) {
    const auto I = static_cast<Index>(row);
    for (Index tile = kernel->row_begin(I); tile < kernel->row_begin(I + 1); ++tile)
      for (Index r = 0; r < std::min(size, n - I * size); ++r)
        for (Index c = 0; c < std::min(size, n - kernel->tile_column(tile) * size); ++c) {
          const Index i = I * size + r;
          const Index j = kernel->tile_column(tile) * size + c;
          kernel->tile_data(tile)[r * size + c] =
              static_cast<double>(1 + (i + j) % 17) / (18.0 * static_cast<double>(n));
        }
  });
  auto mesh = std::make_shared<PatchMesh>();
  mesh->patches.resize(static_cast<std::size_t>(n));
  mesh->area = Eigen::VectorXd::Ones(n);
  mesh->reflectance = Eigen::MatrixXd::Constant(n, channels, 0.5);
  mesh->emission = Eigen::MatrixXd::Zero(n, channels);
  FormFactors form_factors;
  form_factors.mesh = mesh;
  form_factors.kernel = kernel;
  form_factors.exposed = Eigen::VectorXd::Ones(n);
  return form_factors;
}

}  // namespace radiosity
