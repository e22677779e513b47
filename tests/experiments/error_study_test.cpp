#include "experiments/low_rank_radiosity/adjacent_patches.hpp"
#include "experiments/low_rank_radiosity/error_study.hpp"
#include "experiments/low_rank_radiosity/error_study_findings.hpp"
#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/low_rank_radiosity/error_study_spectrum.hpp"
#include "experiments/operator_measures.hpp"
#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "tests/temporary_folder.hpp"
#include "well_formed.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace radiosity::testing {
namespace {

ErrorStudyOptions small_error_study() {
  ErrorStudyOptions options;
  options.scenes = {"cube", "no-such-room"};
  options.patches = 150;
  options.reflectances = {std::nullopt, 0.9};
  options.rank_step = 2;
  options.lights = {.area = 2, .point = 2, .patch = 2};
  options.training = {.area = 12, .point = 12};
  return options;
}

const ErrorStudy& small_study_of_errors() {
  static const ErrorStudy study = [] {
    SilentMonitor monitor;
    return measure_low_rank_errors(small_error_study(), cpu_operators(), monitor);
  }();
  return study;
}

FormFactors cube_form_factors(Index patches) {
  SilentMonitor monitor;
  return compute_form_factors(
      std::make_shared<PatchMesh>(make_patches(built_in_scene("cube"), {.patches = patches})), {}, monitor);
}

TEST(ErrorStudy, HasEveryFactorizationAtEveryRank) {
  const ErrorStudy& study = small_study_of_errors();
  const std::size_t ranks = studied_ranks(150, small_error_study()).size();
  EXPECT_EQ(study.factorizations.size(), studied_factorizations().size() * ranks * 2);
  EXPECT_EQ(study.problems().size(), 2u) << "scenes that are not built in are left out";
  EXPECT_EQ(study.spectra.size(), 1u);
  for (const LowRankError& row : study.factorizations) {
    ASSERT_TRUE(row.errors) << row.factorization << ": " << row.refusal;
    EXPECT_GT(row.errors->radiosity_mean, 0) << row.factorization;
    EXPECT_LE(row.errors->radiosity_mean, row.errors->radiosity_rms * (1 + 1e-12)) << row.factorization;
    EXPECT_LE(row.errors->radiosity_rms, row.errors->radiosity_max * (1 + 1e-12)) << row.factorization;
    EXPECT_GE(row.errors->indirect_mean, row.errors->radiosity_mean) << row.factorization;
    EXPECT_LE(row.rank, 2 * row.k) << row.factorization;
    EXPECT_GT(row.bytes_per_patch, 0);
    EXPECT_LT(row.spectral_radius, 1) << row.factorization;
    EXPECT_NE(study.bound(row.problem, row.rank), nullptr) << row.factorization << row.rank;
  }
}

// Eckart and Young: nothing of rank k is below SVD in the norm in which it was made. Uniform reflectance, so
// that T has the singular vectors of K.
TEST(ErrorStudy, AreaSvdIsLeastInT) {
  const auto& rows = small_study_of_errors().factorizations;
  for (const LowRankError& svd : rows) {
    if (svd.factorization != area_svd) continue;
    for (const LowRankError& row : rows) {
      if (!(row.problem == svd.problem) || row.rank > svd.rank) continue;
      EXPECT_GE(row.operator_error, svd.operator_error * (1 - 1e-6)) << row.factorization << row.k;
    }
  }
}

TEST(ErrorStudy, ErrorsInTAreThoseOfTheOperator) {
  const FormFactors form_factors = cube_form_factors(54);
  const Eigen::MatrixXd kernel = materialize(*form_factors.kernel);
  SilentMonitor monitor;
  for (const char* spec : {"svd:k=6", "svd:k=6,norm=area", "2msc:k=6,mesh=uniform,sides=two", "cur:k=6"}) {
    const LowRankParts parts = low_rank_parts(cpu_operators(), spec, form_factors);
    const auto transport = cpu_operators().make(spec, form_factors);
    EXPECT_NEAR(relative_operator_error(form_factors.mesh->reflectance,
                                        squared_row_errors(kernel, form_factors.mesh->area, parts),
                                        kernel.rowwise().squaredNorm()),
                *relative_frobenius_error(*transport, form_factors, monitor), 1e-7)
        << spec;
    EXPECT_EQ(parts.bytes(), transport->bytes().total()) << spec;
  }
  EXPECT_THROW(low_rank_parts(cpu_operators(), "dense", form_factors), UsageError);
}

TEST(ErrorStudy, NestedFactorizationsAreThoseOfTheSmallerRank) {
  const FormFactors form_factors = cube_form_factors(54);
  for (const LowRankFactorization& factorization : studied_factorizations()) {
    if (!factorization.nested) continue;
    const char* separator = factorization.spec.find(':') == std::string::npos ? ":k=" : ",k=";
    const LowRankParts large =
        low_rank_parts(cpu_operators(), factorization.spec + separator + "12", form_factors);
    const LowRankParts small =
        low_rank_parts(cpu_operators(), factorization.spec + separator + "5", form_factors);
    const LowRankParts leading = large.leading(5);
    EXPECT_EQ(leading.U, small.U) << factorization.name;
    EXPECT_EQ(leading.V, small.V) << factorization.name;
    EXPECT_EQ(leading.bytes(), small.bytes()) << factorization.name;
    EXPECT_NE(large.leading(6).bytes(), small.bytes()) << factorization.name;
  }
}

TEST(ErrorStudy, RanksGrowToAQuarter) {
  ErrorStudyOptions options;
  options.rank_step = 2;
  EXPECT_EQ(studied_ranks(400, options), (std::vector<Index>{8, 16, 32, 64, 100}));
  EXPECT_EQ(studied_ranks(864, ErrorStudyOptions{}), (std::vector<Index>{8, 24, 72, 216}));
  EXPECT_TRUE(studied_ranks(30, options).empty());
  options.scenes = {"cube"};
  options.patches = 24;
  SilentMonitor monitor;
  EXPECT_THROW(measure_low_rank_errors(options, cpu_operators(), monitor), UsageError);
  options.scenes = {"no-such-room"};
  EXPECT_THROW(measure_low_rank_errors(options, cpu_operators(), monitor), UsageError);
}

// The cube has 12 edges, each with one pair of patches for each step along it.
TEST(AdjacentPatches, OfTheCubeLieAlongItsEdges) {
  for (const Index steps : {2, 5}) {
    const PatchMesh mesh = make_patches(built_in_scene("cube"), {.patches = 6 * steps * steps});
    const auto pairs = adjacent_patches(mesh);
    EXPECT_EQ(static_cast<Index>(pairs.size()), 12 * steps);
    for (const auto& [i, j] : pairs) {
      EXPECT_LT(i, j);
      EXPECT_NEAR(mesh.normal.col(i).dot(mesh.normal.col(j)), 0, 1e-12);
      EXPECT_NEAR((mesh.centroid.col(i) - mesh.centroid.col(j)).norm(),
                  std::sqrt(0.5) / static_cast<double>(steps), 1e-12);
    }
  }
}

TEST(SpectrumStudy, TheShelfGoesWithTheAdjacentPairs) {
  const SpectrumStudy& spectrum = small_study_of_errors().spectra.front();
  ASSERT_EQ(spectrum.patches, 150);
  EXPECT_EQ(spectrum.adjacent_pairs, 60);
  EXPECT_EQ(spectrum.eigenvalues.size(), 150u);
  EXPECT_NEAR(spectrum.eigenvalues.front(), 1, 1e-6) << "a closed room";
  // All patches of the cube have one area: F is K, and singular values are magnitudes of eigenvalues.
  for (std::size_t k = 0; k < spectrum.eigenvalues.size(); ++k)
    EXPECT_NEAR(spectrum.singular_values[k], spectrum.eigenvalues[k], 1e-9);
  EXPECT_GT(count_above_shelf(spectrum.eigenvalues), spectrum.adjacent_pairs);
  EXPECT_LT(count_above_shelf(spectrum.without_adjacent), count_above_shelf(spectrum.eigenvalues) / 2);
}

TEST(ErrorFindings, ExponentsOfPowerLawsAreFound) {
  std::vector<std::array<double, 2>> points;
  for (const double x : {1.0, 2.0, 7.0, 30.0}) points.push_back({x, 3 * std::pow(x, -1.5)});
  points.push_back({0, 1});
  ASSERT_TRUE(fitted_exponent(points));
  EXPECT_NEAR(*fitted_exponent(points), -1.5, 1e-12);
  EXPECT_FALSE(fitted_exponent({{2, 1}, {2, 3}}));
  EXPECT_FALSE(fitted_exponent({}));
}

/// A study in which SVD has the error 1/k and the rival `gain` times less on half of the bytes.
ErrorStudy invented_study(double gain) {
  ErrorStudy study;
  const ErrorStudyProblem problem{"invented", 100, 0.5};
  for (const Index k : {8, 16}) {
    const double error = 1 / static_cast<double>(k);
    const auto row = [&](const char* name, double bytes, double of_B, double of_T) {
      LowRankError made{problem, name, k, k, bytes, of_T, 0.5, LightErrors{}, ""};
      made.errors->radiosity_mean = made.errors->radiosity_rms = of_B;
      made.errors->of_kind = {of_B, of_B, of_B};
      return made;
    };
    study.factorizations.push_back(row(plain_svd, 8.0 * static_cast<double>(k), error, 2 * error));
    study.factorizations.push_back(
        row(uniform_two_mesh, 4.0 * static_cast<double>(k), error / gain, 3 * error));
    BestRankError bound;
    bound.problem = problem;
    bound.rank = k;
    bound.errors.radiosity_rms = error / 4;
    bound.alone = {error / 8, std::nullopt, std::nullopt};
    study.bounds.push_back(bound);
  }
  return study;
}

TEST(ErrorFindings, SayWhoWinsAndByHowMuch) {
  const ProblemFindings wins = find_in_study(invented_study(3)).front();
  EXPECT_EQ(wins.ranks, 2);
  EXPECT_EQ(wins.svd_beaten_in_B, 2);
  EXPECT_EQ(wins.svd_beaten_by_others, 2);
  EXPECT_EQ(wins.svd_least_in_T, 2);
  EXPECT_NEAR(wins.largest_gain, 3, 1e-12);
  EXPECT_EQ(wins.strongest_rival.factorization, uniform_two_mesh);
  EXPECT_NEAR(wins.svd_over_best_low, 4, 1e-12);
  EXPECT_NEAR(wins.svd_over_alone[0], 8, 1e-12);
  EXPECT_EQ(wins.svd_over_alone[1], 0);
  EXPECT_EQ(wins.two_mesh_wins[0], 2);
  ASSERT_EQ(wins.at_equal_bytes.size(), 2u);
  // 64 bytes buy the rival its k = 16.
  EXPECT_EQ(wins.at_equal_bytes[0].factorization, uniform_two_mesh);
  EXPECT_NEAR(wins.at_equal_bytes[0].error, 1.0 / 48, 1e-12);
  for (const ErrorDecay& decay : wins.decays) EXPECT_NEAR(*decay.over_rank, -1, 1e-9) << decay.factorization;

  EXPECT_EQ(find_in_study(invented_study(1.005)).front().svd_beaten_in_B, 0) << "too little to notice";

  const ProblemFindings loses = find_in_study(invented_study(0.9)).front();
  EXPECT_EQ(loses.svd_beaten_in_B, 0);
  EXPECT_EQ(loses.two_mesh_wins[0], 0);
  EXPECT_EQ(loses.at_equal_rank[0].factorization, plain_svd);
  EXPECT_EQ(loses.at_equal_bytes[0].factorization, uniform_two_mesh) << "half the bytes win over 0.9";
}

TEST(ErrorFindings, SentencesFollowTheMeasurements) {
  const std::string wins = answers(invented_study(3)).front();
  EXPECT_NE(wins.find("area norm at 2, at most by a factor of 3"), std::string::npos) << wins;
  const std::string loses = answers(invented_study(0.9)).front();
  EXPECT_NE(loses.find("area norm at 0."), std::string::npos) << loses;
}

TEST(ErrorStudy, WritesFilesAndASection) {
  const TemporaryFolder temporary;
  write_error_study(temporary.path(), small_study_of_errors());
  std::ifstream csv(temporary.path() / "low_rank_errors.csv");
  std::string line;
  std::size_t lines = 0;
  std::size_t commas = std::string::npos;
  while (std::getline(csv, line)) {
    // The names of factorizations, in quotes, may hold one.
    const auto quoted = std::count(line.begin(), line.end(), '"') == 2 ? line.find('"') : std::string::npos;
    if (quoted != std::string::npos) line.erase(quoted, line.find('"', quoted + 1) - quoted + 1);
    const auto found = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    if (lines++ == 0) commas = found;
    EXPECT_EQ(found, commas) << line;
  }
  EXPECT_EQ(lines, 1 + small_study_of_errors().factorizations.size() + small_study_of_errors().bounds.size());
  std::ifstream in(temporary.path() / "low_rank_errors.json");
  const auto document = nlohmann::json::parse(in);
  EXPECT_EQ(document["factorizations"].size(), small_study_of_errors().factorizations.size());
  EXPECT_EQ(document["spectra"][0]["eigenvalues"].size(), 150u);
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "low_rank_spectra.csv"));

  const ReportSection section = error_study_section(small_study_of_errors(), "the command");
  for (const ReportBlock& block : section.blocks) {
    const auto* figure = std::get_if<ReportFigure>(&block);
    if (figure == nullptr) continue;
    EXPECT_EQ(test::xml_problem(std::get<std::string>(figure->image)), "");
  }
  Report report;
  report.sections.push_back(section);
  EXPECT_NE(to_html(report).find("best of rank k"), std::string::npos);
}

}  // namespace
}  // namespace radiosity::testing
