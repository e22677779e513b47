// Registers an operator of its own next to the library's, compares them all, and checks the new one as the
// library checks its own: against its entries, and for what it costs and loses.
#include "threshold_operator.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <radiosity/experiments/comparison.hpp>
#include <radiosity/render/write_solution.hpp>
#include <radiosity/scene/built_in.hpp>
#include <string>

namespace {

using namespace radiosity;

bool passed = true;

void expect(bool holds, const std::string& what) {
  fmt::print("{} {}\n", holds ? "passed" : "FAILED", what);
  passed = passed && holds;
}

Field materialized(const LinearOperator& transport) {
  Field result(transport.size(), transport.size());
  transport.apply(Field::Identity(transport.size(), transport.size()), result);
  return result;
}

/// What every operator promises: a product does not depend on its neighbours, beta = 0 does not read Y, and R
/// F is symmetric between its diagonals.
void check_operator(const LinearOperator& transport, const FormFactors& form_factors) {
  const Field T = materialized(transport);
  const Field X = Field::Random(transport.size(), 3);
  Field Y = Field::Constant(transport.size(), 3, std::nan(""));
  transport.apply(X, Y);
  expect((Y - T * X).cwiseAbs().maxCoeff() <= 1e-13,
         "the product is that of the entries, and Y = NaN is not read");
  const Field balanced = form_factors.mesh->area.asDiagonal() * T;  // one reflectance in the cube
  expect((balanced - balanced.transpose()).cwiseAbs().maxCoeff() <= 1e-15, "reciprocity holds");
  const Field F = form_factors.mesh->reflectance.col(0).asDiagonal() * form_factors.matrix();
  expect(((F - T).array() >= -1e-15).all() && T.sum() < F.sum(),
         "entries were dropped and nothing was added");
}

void run(const std::string& json_file) {
  OperatorRegistry operators = cpu_operators();
  operators.add(threshold_operator());

  SilentMonitor monitor;
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 216}));
  const FormFactors form_factors = compute_form_factors(mesh, {}, monitor);
  check_operator(*operators.make("threshold:below=0.1", form_factors), form_factors);

  ComparisonOptions options;
  options.operators = {"dense", "csr", "threshold:below=0.1"};
  options.lights = LightCounts::parse("patch:2");
  const Comparison comparison = compare(form_factors, operators, cpu_solvers(), options, monitor);
  fmt::print("{}", comparison_table(comparison));
  write_comparison_json(json_file, comparison);

  const ComparisonResult& csr = comparison.results[1];
  const ComparisonResult& mine = comparison.results[2];
  expect(mine.spec == options.operators[2] && mine.solver == "cg",
         "the new operator is compared, and solved by cg");
  expect(mine.bytes < csr.bytes, "it takes less memory than csr");
  expect(mine.errors.radiosity_mean > 1e-4 && mine.errors.radiosity_mean < 0.5, "its error is seen");
  expect(csr.errors.radiosity_mean < 1e-5, "csr has none");

  const std::string picture = json_file + ".png";  // by a module of the package, loaded now
  fmt::print("{}\n", write_solution(picture, *mesh, mesh->emission, {.width = 40, .height = 40}, monitor));
  expect(std::filesystem::file_size(picture) > 0, "a picture is written");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : "comparison.json");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return passed ? 0 : 1;
}
