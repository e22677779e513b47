#include "experiments/dxt_radiosity/bounce_methods.hpp"
#include "experiments/dxt_radiosity/dxt_speed.hpp"
#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace radiosity {
namespace {

FormFactors small_coloured_box() {
  SilentMonitor monitor;
  return compute_form_factors(
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 100})),
      {}, monitor);
}

TEST(BounceMethods, AllGiveTheSameBounces) {
  const FormFactors form_factors = small_coloured_box();
  Field emission = form_factors.mesh->emission;
  emission.col(0).array() += 1;  // so that channels differ and everything emits
  const Field exact = after_bounces(*cpu_operators().make("dense", form_factors), emission, 3);
  const BounceMethod methods[] = {naive_method(form_factors, 3), packed_method(form_factors, 3),
                                  colour_method(form_factors, 3),
                                  summed_method("sum", "bounces:k=3", form_factors, cpu_operators())};
  for (const BounceMethod& method : methods) {
    Field radiosity;
    method.answer(emission, radiosity);
    EXPECT_LE((radiosity - exact).norm(), 1e-6 * exact.norm()) << method.name;
  }
  Field once, dense_once = after_bounces(*cpu_operators().make("dense", form_factors), emission, 1);
  summed_method("T", "dense:f32", form_factors, cpu_operators()).answer(emission, once);
  EXPECT_LE((once - dense_once).norm(), 1e-6 * dense_once.norm());
  Field fewer;
  naive_method(form_factors, 2).answer(emission, fewer);
  EXPECT_GT((fewer - exact).norm(), 1e-3 * exact.norm()) << "two bounces are not three";
  EXPECT_EQ(methods[0].bytes, methods[1].bytes);
  EXPECT_NEAR(static_cast<double>(methods[2].bytes) / static_cast<double>(methods[0].bytes), 3, 0.2);
}

TEST(BounceMethods, TheNaiveOneHasOneScalarMatrixInFloat) {
  const FormFactors form_factors = small_coloured_box();
  const auto n = static_cast<double>(form_factors.patch_count());
  const auto bytes = static_cast<double>(naive_method(form_factors, 3).bytes);
  EXPECT_GE(bytes, 4 * n * n);
  EXPECT_LT(bytes, 2 * 4 * n * n) << "rows are padded, but neither doubles nor three colours";
}

TEST(BounceMethods, TheNaiveOneMultipliesEachChannelByItsReflectance) {
  // Bounce by bounce in double, one channel at a time; with channels exchanged it is another B.
  const FormFactors form_factors = small_coloured_box();
  const Eigen::MatrixXd F = form_factors.matrix();
  const Field emission = Field::Ones(F.rows(), 3);
  Field radiosity;
  naive_method(form_factors, 3).answer(emission, radiosity);
  const auto plain = [&](Index reflectance_of) {
    const auto rho = form_factors.mesh->reflectance.col(reflectance_of).asDiagonal();
    Eigen::VectorXd sent = emission.col(0), B = sent;
    for (int bounce = 0; bounce < 3; ++bounce) {
      sent = rho * (F * sent);
      B += sent;
    }
    return B;
  };
  for (Index channel = 0; channel < 3; ++channel) {
    EXPECT_LE((radiosity.col(channel) - plain(channel)).norm(), 1e-6 * plain(channel).norm());
    EXPECT_GT((radiosity.col(channel) - plain((channel + 1) % 3)).norm(), 1e-3 * plain(channel).norm());
  }
}

TEST(DxtSpeed, MeasuresAllMethodsAndWritesThem) {
  DxtSpeedOptions options;
  options.patches = {60, 100};
  options.patches_beyond_cache = {140};
  options.patches_over_bounces = 60;
  options.bounce_counts = {1, 2};
  options.lights = {.area = 1, .point = 1};
  options.seconds = 0.001;
  SilentMonitor monitor;
  const DxtSpeeds speeds = measure_dxt_speeds(options, cpu_operators(), cpu_solvers(), monitor);
  ASSERT_EQ(speeds.over_patches.size(), 3U);
  ASSERT_EQ(speeds.over_bounces.size(), 2U);
  const SpeedRound& round = speeds.over_patches[1];
  EXPECT_LT(*round.method("naive").error_of_bounces, 1e-6);
  EXPECT_LT(*round.method(float_sum).error_of_bounces, 1e-6);
  EXPECT_GT(*round.method(document_sum).error_of_bounces, *round.method(improved_sum).error_of_bounces);
  EXPECT_LE(round.method(solved_kernel).error, round.method(improved_sum).error);
  for (const MethodSpeed& method : round.methods) {
    EXPECT_GT(method.time.min, 0) << method.name;
    EXPECT_LE(method.time.min, method.time.median) << method.name;
  }
  EXPECT_THROW(round.method("another"), Error);
  const SpeedRound& beyond = speeds.over_patches.back();
  EXPECT_GT(beyond.patches, round.patches);
  EXPECT_EQ(beyond.find(improved_sum), nullptr);
  EXPECT_LT(*beyond.method("naive").error_of_bounces, *beyond.method(document_sum).error_of_bounces);
  EXPECT_LE(beyond.method(solved_kernel).error, beyond.method(document_sum).error);
  EXPECT_EQ(round.naive_reads(), 9);
  EXPECT_GT(round.reading.min, 0);
  EXPECT_EQ(round.factor_bytes(), 4.0 * static_cast<double>(round.patches * round.patches));
  EXPECT_DOUBLE_EQ(round.seconds_to_read(round.factor_bytes()), round.reading.min);
  EXPECT_GT(speeds.over_bounces[0].method("naive").error, speeds.over_bounces[1].method("naive").error);

  const ReportSection section = dxt_speed_section(speeds, options, "command");
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  const TemporaryFolder temporary;
  write_dxt_speeds(temporary.path(), speeds);
  std::ifstream file(temporary.path() / "dxt_speed.json");
  EXPECT_EQ(nlohmann::json::parse(file).at("over_patches").at(0).at("methods").size(), 7U);
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "dxt_speed.csv"));
}

}  // namespace
}  // namespace radiosity
