#include "tests/conformance/transport_cases.hpp"

#include "form_factors/exact_rooms.hpp"
#include "foundation/random.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace radiosity {
namespace {

std::shared_ptr<const PatchMesh> mesh_of(const Eigen::VectorXd& area, const Eigen::MatrixXd& reflectance) {
  auto mesh = std::make_shared<PatchMesh>();
  mesh->patches.resize(static_cast<std::size_t>(area.size()));
  mesh->area = area;
  mesh->reflectance = reflectance;
  mesh->emission = Eigen::MatrixXd::Zero(reflectance.rows(), reflectance.cols());
  return mesh;
}

Eigen::VectorXd unequal_areas(Index n, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::VectorXd area(n);
  for (Index i = 0; i < n; ++i) area[i] = std::pow(10.0, random.uniform(-6, 6));
  return area;
}

Eigen::MatrixXd random_reflectance(Index n, Index channels, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::MatrixXd reflectance(n, channels);
  for (Index c = 0; c < channels; ++c)
    for (Index i = 0; i < n; ++i) reflectance(i, c) = i % 7 == 3 ? 0 : random.uniform(0.01, 0.999);
  return reflectance;
}

TransportCase make_case(std::string name, FormFactors form_factors) {
  OperatorReference reference = exact_entries(form_factors);
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  return {std::move(name), std::move(form_factors), std::move(reference), root_area};
}

}  // namespace

FormFactors symmetric_form_factors(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& area,
                                   const Eigen::MatrixXd& reflectance) {
  return form_factors_of(exact_rooms::Room{area, reflectance, kernel});
}

FormFactors unsymmetric_form_factors(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& area,
                                     const Eigen::MatrixXd& reflectance) {
  FormFactors form_factors;
  form_factors.mesh = mesh_of(area, reflectance);
  form_factors.unsymmetric = std::make_shared<const RowMajorMatrix<double>>(matrix);
  form_factors.exposed = Eigen::VectorXd::Ones(matrix.rows());
  return form_factors;
}

Eigen::MatrixXd random_kernel(Index n, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < j; ++i)
      if (random.uniform() < 0.65) kernel(i, j) = kernel(j, i) = random.uniform() / static_cast<double>(n);
  return kernel;
}

std::vector<TransportCase> transport_cases(Index n) {
  std::vector<TransportCase> cases;
  const Eigen::VectorXd area = unequal_areas(n, 61);
  const Eigen::MatrixXd kernel = random_kernel(n, 62);
  for (const Index channels : {1, 3})
    cases.push_back(make_case(fmt::format("random kernel, {} channels", channels),
                              symmetric_form_factors(kernel, area, random_reflectance(n, channels, 63))));
  cases.push_back(make_case(
      "F = 0", symmetric_form_factors(Eigen::MatrixXd::Zero(n, n), area, random_reflectance(n, 3, 64))));
  Eigen::MatrixXd isolated = kernel;
  if (n > 0) {
    isolated.row(n / 2).setZero();
    isolated.col(n / 2).setZero();
  }
  cases.push_back(
      make_case("isolated patch", symmetric_form_factors(isolated, area, random_reflectance(n, 1, 65))));
  const Eigen::MatrixXd unsymmetric = kernel.cwiseProduct(random_kernel(n, 66)) * static_cast<double>(n) * 2;
  Eigen::MatrixXd gathered = kernel.triangularView<Eigen::StrictlyUpper>();
  gathered += unsymmetric;
  cases.push_back(
      make_case("unsymmetric F", unsymmetric_form_factors(gathered, area, random_reflectance(n, 3, 67))));
  if (n == 6) {
    Eigen::MatrixXd cube = Eigen::MatrixXd::Constant(6, 6, 0.2000437760);  // squares that share an edge
    for (Index i = 0; i < 6; ++i) cube(i, i) = 0;
    for (Index i = 0; i < 6; i += 2) cube(i, i + 1) = cube(i + 1, i) = 0.1998248960;  // opposite squares
    cases.push_back(make_case("closed cube", symmetric_form_factors(cube, Eigen::VectorXd::Ones(6),
                                                                    Eigen::MatrixXd::Constant(6, 1, 0.9))));
  }
  return cases;
}

void allow_storage_error(TransportCase& data, double unit_roundoff) {
  data.reference.unit_roundoff = unit_roundoff;
  data.reference.entry_error.resize(0, 0);
  if (unit_roundoff != 0x1p-11) return;
  // binary16: numbers lie on a grid of 2^-24, and the largest is scaled to 2^14 at least.
  const PatchMesh& mesh = *data.form_factors.mesh;
  const Index n = mesh.patch_count();
  double largest = 0;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      largest = std::max(largest, data.form_factors.symmetric() ? (*data.form_factors.kernel)(i, j)
                                                                : (*data.form_factors.unsymmetric)(i, j));
  data.reference.entry_error = Eigen::MatrixXd::Constant(n, n, largest * 0x1p-39);
  if (data.form_factors.symmetric())
    data.reference.entry_error =
        data.root_area.cwiseInverse().asDiagonal() * data.reference.entry_error * data.root_area.asDiagonal();
}

}  // namespace radiosity
