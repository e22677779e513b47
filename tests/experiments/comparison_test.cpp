#include "experiments/comparison.hpp"
#include "experiments/form_factor_report.hpp"
#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>

namespace radiosity::testing {
namespace {

using Json = nlohmann::json;

/// A user's own operator: the exact one, dimmed. Its error is known without computing anything.
class DimmedTransport final : public LinearOperator {
 public:
  DimmedTransport(std::unique_ptr<LinearOperator> exact, double factor)
      : exact_(std::move(exact)), factor_(factor) {}
  Index size() const override { return exact_->size(); }
  Index channels() const override { return exact_->channels(); }
  ByteCount bytes() const override { return {{{"entries", 12345}}}; }
  std::string describe() const override { return "dimmed"; }

 private:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override {
    exact_->apply(alpha * factor_, X, beta, Y);
  }
  std::unique_ptr<LinearOperator> exact_;
  double factor_;
};

OperatorRegistry operators_with_dimmed() {
  OperatorRegistry registry = cpu_operators();
  registry.add({"dimmed", "", "dimmed:factor=1", [](Spec& spec, const FormFactors& form_factors) {
                  return std::make_unique<DimmedTransport>(cpu_operators().make("dense", form_factors),
                                                           spec.number("factor", 1, 0, 1));
                }});
  return registry;
}

FormFactors form_factors_of(const std::string& scene, Index patches,
                            FormFactorMethod method = FormFactorMethod::accurate) {
  SilentMonitor monitor;
  FormFactorOptions options;
  options.method = method;
  return compute_form_factors(
      std::make_shared<PatchMesh>(make_patches(built_in_scene(scene), {.patches = patches})), options,
      monitor);
}

Comparison run(const FormFactors& form_factors, const std::vector<std::string>& specs,
               const std::string& lights, const std::string& solver = "") {
  SilentMonitor monitor;
  ComparisonOptions options;
  options.operators = specs;
  options.solver = solver;
  options.machine = Machine{"the test's", 1, 1, 0};
  if (!lights.empty()) options.lights = LightCounts::parse(lights);
  return compare(form_factors, operators_with_dimmed(), cpu_solvers(), options, monitor);
}

Json written(const Comparison& comparison) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "comparison.json";
  write_comparison_json(file, comparison);
  std::ifstream in(file);
  return Json::parse(in);
}

std::set<std::string> keys(const Json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

/// What may differ from run to run or from machine to machine.
void remove_measurements(Json& document) {
  document.erase("machine");
  for (const char* key : {"seconds", "cpu_seconds", "rays_per_second", "rays"})
    document["form_factors"].erase(key);
  for (Json& result : document["results"])
    for (const char* key : {"build_seconds", "apply_seconds", "solve_seconds"}) result.erase(key);
}

/// Numbers may differ in the rounding of float32, whose order is the instruction set's; everything else is
/// the same.
bool same(const Json& a, const Json& b) {
  if (a.is_number_float() || b.is_number_float()) {
    if (!a.is_number() || !b.is_number()) return false;
    const double x = a.get<double>();
    const double y = b.get<double>();
    return std::abs(x - y) <= 1e-8 + 1e-3 * std::max(std::abs(x), std::abs(y));
  }
  if (a.type() != b.type() && !(a.is_number() && b.is_number())) return false;
  if (a.is_object()) {
    if (keys(a) != keys(b)) return false;
    for (const auto& [name, value] : a.items())
      if (!same(value, b.at(name))) return false;
    return true;
  }
  if (a.is_array()) return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same);
  return a == b;
}

/// Compares with a file of this folder, and a copy whose error of the third result is one percent off.
void expect_golden(const Json& actual, const std::string& name) {
  const std::string file = RADIOSITY_SOURCE_DIR "/tests/experiments/" + name;
  std::ifstream in(file);
  ASSERT_TRUE(in) << file << " is missing; this run gave\n" << actual.dump(2);
  const Json golden = Json::parse(in);
  EXPECT_TRUE(same(actual, golden)) << "If the change is meant, put this into " << file << ":\n"
                                    << actual.dump(2);
  Json broken = golden;
  broken["results"][2]["error"]["radiosity_mean"] =
      1.01 * golden["results"][2]["error"]["radiosity_mean"].get<double>();
  EXPECT_FALSE(same(actual, broken)) << "an error that is one percent off must be noticed";
}

TEST(Comparison, ATinyOneIsWhatItHasAlwaysBeen) {
  const Comparison comparison =
      run(form_factors_of("cube", 54), {"dense", "dense:f32", "dense:f16", "csr", "dimmed:factor=0.9"},
          "area:2,point:2,patch:1");
  Json actual = written(comparison);
  remove_measurements(actual);
  expect_golden(actual, "golden_comparison.json");
}

/// What a comparison says of every operator but its times.
Json errors_and_bytes(const std::vector<std::string>& specs) {
  const Json document = written(run(form_factors_of("cornell-box-closed", 200), specs, "area:3,point:2"));
  Json table;
  for (const Json& result : document["results"])
    table["results"].push_back({{"operator", result["operator"]},
                                {"solver", result["solver"]},
                                {"bytes", result["bytes"]},
                                {"error", result["error"]}});
  return table;
}

TEST(Comparison, ATinyOneOfLowRankIsWhatItHasAlwaysBeen) {
  expect_golden(errors_and_bytes({"svd:k=40", "svd:k=40,norm=area", "rsvd:k=40", "qr:k=40,mesh=uniform",
                                  "qr:k=40,columns=pivoted", "cur:k=40", "wavelet:k=40", "dct:k=40",
                                  "2msc:k=40,mesh=uniform", "2msc:k=40,mesh=uniform,sides=two",
                                  "sparse-v:k=40,mesh=adaptive", "sparse-v:k=40,factors=direct,mesh=uniform",
                                  "svd:k=40,global=1", "neumann-sparse:threshold=1e-3"}),
                "golden_low_rank.json");
}

TEST(Comparison, ATinyOneOfCompressedMatricesIsWhatItHasAlwaysBeen) {
  expect_golden(
      errors_and_bytes({"bounces:k=3", "bounces:k=inf", "dxt", "dxt:reorder=none,start=random",
                        "dxt:reorder=morton,range=auto,fill=1,fit=cluster", "dxt:reorder=2opt,closure=rows",
                        "dxt:bounces=3", "dxt:codec=bc4,range=6,fill=1", "dxt:codec=u8", "dxt:codec=bf16",
                        "dxt:matrix=kernel,reorder=morton,range=6,fill=1",
                        "dxt:matrix=kernel,codec=u4,closure=symmetric"}),
      "golden_compressed.json");
}

TEST(Comparison, TheJsonHasTheKeysOfTheContract) {
  const Json document = written(run(form_factors_of("cornell-box", 60), {"csr", "dense"}, "patch:2"));
  EXPECT_EQ(keys(document), (std::set<std::string>{"scene", "machine", "form_factors", "results"}));
  EXPECT_EQ(keys(document["scene"]),
            (std::set<std::string>{"name", "triangles", "patches", "channels", "closed", "area"}));
  EXPECT_EQ(keys(document["machine"]),
            (std::set<std::string>{"cpu", "threads", "read_bandwidth_gb_s", "load"}));
  EXPECT_EQ(keys(document["form_factors"]),
            (std::set<std::string>{"method", "closure", "rays", "seconds", "cpu_seconds", "rays_per_second",
                                   "row_sum_min", "row_sum_max", "row_sum_rms", "reciprocity_max",
                                   "back_hits", "leaks"}));
  ASSERT_EQ(document["results"].size(), 2u);
  EXPECT_EQ(document["results"][0]["operator"], "csr");
  EXPECT_EQ(document["results"][1]["operator"], "dense");
  for (const Json& result : document["results"]) {
    EXPECT_EQ(keys(result), (std::set<std::string>{
                                "operator", "solver", "device", "renderer", "device_difference_max", "bytes",
                                "build_seconds", "apply_seconds", "solve_seconds", "error", "row_sum_min",
                                "row_sum_max", "spectral_radius", "iterations", "certificate", "remark"}));
    EXPECT_EQ(keys(result["certificate"]), (std::set<std::string>{"bound", "kind", "confidence", "vectors",
                                                                  "products", "ratio_min", "ratio_max"}));
    EXPECT_GE(result["certificate"]["ratio_min"], 1);
    EXPECT_LE(result["certificate"]["ratio_max"], 4);
    EXPECT_EQ(keys(result["apply_seconds"]), (std::set<std::string>{"min", "median"}));
    EXPECT_EQ(keys(result["solve_seconds"]), (std::set<std::string>{"min", "median"}));
    EXPECT_EQ(keys(result["error"]),
              (std::set<std::string>{"operator_frobenius", "radiosity_mean", "radiosity_max", "indirect_mean",
                                     "indirect_max"}));
    EXPECT_TRUE(result["renderer"].is_null());
    EXPECT_EQ(result["device"], "cpu");
    EXPECT_GT(result["apply_seconds"]["min"], 0);
    EXPECT_LE(result["apply_seconds"]["min"], result["apply_seconds"]["median"]);
  }
  EXPECT_EQ(document["machine"]["cpu"], "the test's");
  EXPECT_EQ(document["scene"]["channels"], 3);
  EXPECT_FALSE(document["scene"]["closed"]);
}

TEST(Comparison, ADimmedOperatorHasTheErrorThatItMustHave) {
  const FormFactors form_factors = form_factors_of("cube", 54);
  const Comparison comparison = run(form_factors, {"dense", "dimmed:factor=0.75"}, "area:3");
  const ComparisonResult& exact = comparison.results[0];
  const ComparisonResult& dimmed = comparison.results[1];
  EXPECT_LE(*exact.errors.operator_frobenius, 1e-15);
  EXPECT_LE(*exact.errors.radiosity_max, 2e-6) << "the solver's tolerance";
  EXPECT_NEAR(*dimmed.errors.operator_frobenius, 0.25, 1e-12);
  EXPECT_NEAR(*dimmed.row_sum_max, 0.75, 1e-6);
  EXPECT_NEAR(*dimmed.spectral_radius, 0.375, 1e-3);
  EXPECT_EQ(dimmed.bytes, 12345u);
  EXPECT_EQ(dimmed.solver, "gmres:restart=30");
  EXPECT_GT(*dimmed.errors.indirect_mean, *dimmed.errors.radiosity_mean) << "the light itself has no error";
}

TEST(Comparison, GatheredFormFactorsAreComparedByGmres) {
  const FormFactors form_factors = form_factors_of("cornell-box-closed", 80, FormFactorMethod::gather);
  const Comparison comparison = run(form_factors, {"dense:f32"}, "patch:2");
  EXPECT_EQ(comparison.results[0].solver, "gmres:restart=30");
  EXPECT_LE(*comparison.results[0].errors.operator_frobenius, 1e-6);
  EXPECT_LE(*comparison.results[0].errors.radiosity_max, 1e-5);
}

TEST(Comparison, OperatorsThatAnswerByThemselvesNeedNoSolver) {
  const Comparison comparison =
      run(form_factors_of("cube", 54),
          {"svd:k=20,storage=f64", "svd:k=20,storage=f64,global=1", "neumann-sparse"}, "area:2,point:1");
  const ComparisonResult& with_solver = comparison.results[0];
  const Json results = written(comparison)["results"];
  for (const std::size_t i : {1, 2}) {
    EXPECT_EQ(keys(results[i]), keys(results[0]));
    EXPECT_EQ(results[i]["iterations"], 0);
    for (const char* key : {"solver", "row_sum_min", "row_sum_max", "spectral_radius"})
      EXPECT_TRUE(results[i][key].is_null()) << key;
    EXPECT_TRUE(results[i]["error"]["operator_frobenius"].is_null());
    EXPECT_GE(results[i]["certificate"]["ratio_min"], 1);
    EXPECT_LE(results[i]["certificate"]["bound"], 4 * results[i]["error"]["radiosity_max"].get<double>());
  }
  EXPECT_NEAR(*comparison.results[1].errors.indirect_max, *with_solver.errors.indirect_max, 1e-5);
  EXPECT_LT(*comparison.results[2].errors.indirect_max, 0.1 * *with_solver.errors.indirect_max);
}

TEST(Comparison, WithoutLightsTheSceneLightsItself) {
  const FormFactors form_factors = form_factors_of("cube", 24);
  EXPECT_EQ(run(form_factors, {"dense"}, "").lights.emission, form_factors.mesh->emission);
  auto dark = std::make_shared<PatchMesh>(*form_factors.mesh);
  dark->emission.setZero();
  FormFactors unlit = form_factors;
  unlit.mesh = dark;
  EXPECT_THROW(run(unlit, {"dense"}, ""), UsageError);
}

std::string refusal(const std::vector<std::string>& specs, const std::string& solver = "") {
  try {
    run(form_factors_of("cube", 24), specs, "patch:1", solver);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Comparison, AnOperatorThatCannotBeBuiltEndsIt) {
  EXPECT_NE(refusal({"dense", "dense:f17"}).find("dense:f17"), std::string::npos);
  EXPECT_NE(refusal({"sparse"}).find("csr"), std::string::npos) << "the known ones are listed";
  EXPECT_NE(refusal({}).find("at least one operator"), std::string::npos);
  EXPECT_NE(refusal({"dimmed"}, "cg").find("symmetric kernel"), std::string::npos);
  EXPECT_NE(refusal({"svd:k=8,global=1"}, "cg").find("leave the solver away"), std::string::npos);
}

TEST(Comparison, TheTableHasALineForEachOperator) {
  const std::string table = comparison_table(run(form_factors_of("cube", 24), {"dense", "csr"}, "patch:1"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_NE(table.find("indirect"), std::string::npos);
}

TEST(Timing, TakesTheShortestAndTheMiddle) {
  EXPECT_EQ(Timing::of({3, 1, 2}).min, 1);
  EXPECT_EQ(Timing::of({3, 1, 2}).median, 2);
  EXPECT_EQ(Timing::of({4, 1, 2, 3}).median, 2.5);
  EXPECT_THROW(Timing::of({}), UsageError);
}

TEST(Machine, IsDescribedAndMeasured) {
  const Machine machine = measure_machine();
  EXPECT_FALSE(machine.cpu.empty());
  EXPECT_GE(machine.threads, 1);
  EXPECT_GE(machine.load, 0);
  EXPECT_GT(machine.read_bandwidth_gb_s, 0.05);
  EXPECT_LT(machine.read_bandwidth_gb_s, 1e5) << "nothing was read";
}

TEST(GroupFormFactors, OfTheCubeAreTheKnownOnes) {
  const FormFactors form_factors = form_factors_of("cube", 54);
  const GroupFormFactors groups = group_form_factors(form_factors);
  ASSERT_EQ(groups.names.size(), 6u);
  EXPECT_LE((groups.areas - Eigen::VectorXd::Ones(6)).cwiseAbs().maxCoeff(), 1e-12);
  for (Index g = 0; g < 6; ++g) {
    EXPECT_NEAR(groups.matrix.row(g).sum(), 1, 1e-6);
    EXPECT_NEAR(groups.matrix(g, g), 0, 1e-12);
    for (Index h = 0; h < 6; ++h) {
      if (g == h) continue;
      const bool opposite = groups.matrix(g, h) < 0.2;
      EXPECT_NEAR(groups.matrix(g, h), opposite ? 0.199824896 : 0.200043776, 1e-6);  // hard case G1
    }
  }
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "groups.json";
  write_form_factor_json(file, form_factors, Machine{"none", 1, 1, 0}, groups);
  std::ifstream in(file);
  const Json document = Json::parse(in);
  EXPECT_EQ(keys(document), (std::set<std::string>{"scene", "machine", "form_factors", "groups", "areas",
                                                   "matrix", "standard_error"}));
  EXPECT_EQ(document["matrix"].size(), 6u);
  EXPECT_EQ(document["matrix"][0].size(), 6u);
  const std::string table = group_table(groups);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
}

}  // namespace
}  // namespace radiosity::testing
