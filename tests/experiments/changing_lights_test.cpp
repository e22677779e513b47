#include "experiments/low_rank_radiosity/changing_lights.hpp"
#include "experiments/low_rank_radiosity/shared_factor_frame.hpp"
#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

ChangingLightsOptions small_patio() {
  ChangingLightsOptions options;
  options.patches = 700;
  options.coarse_patches = 500;
  options.frames = 6;
  options.pictures = 3;
  options.width = 64;
  options.height = 48;
  options.seconds = 0.05;
  options.tolerance = 1e-2;
  return options;
}

TEST(ChangingLights, TurnRoundTheCourtAndAreAnsweredInEveryFrame) {
  SilentMonitor monitor;
  const ChangingLights lights = measure_changing_lights(small_patio(), monitor);
  EXPECT_EQ(lights.powers.rows(), 6);
  EXPECT_EQ(lights.powers.cols(), 16);
  EXPECT_GE(lights.powers.minCoeff(), 0);
  EXPECT_LE(lights.powers.maxCoeff(), 1);
  EXPECT_GT((lights.powers.row(0) - lights.powers.row(3)).norm(), 1) << "they change";
  EXPECT_EQ(lights.errors.size(), 6U);
  for (const double error : lights.errors) {
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 0.1);
  }
  EXPECT_GT(lights.largest_disagreement, 0);
  EXPECT_LE(lights.largest_disagreement, 1e-6);
  EXPECT_LT(lights.shared_factor_bytes, lights.three_factor_bytes * 3);
  ASSERT_EQ(lights.times.size(), 2U);
  for (const LightFrameTimes& times : lights.times) {
    EXPECT_GT(times.one_channel.min, 0);
    EXPECT_GE(times.three_factors.median, times.three_factors.min);
    EXPECT_GT(times.shared_factor.min, 0);
  }
}

TEST(ChangingLights, WriteFramesAndASection) {
  const TemporaryFolder temporary;
  SilentMonitor monitor;
  ChangingLightsOptions options = small_patio();
  options.largest_dense = 0;
  const ReportSection section = changing_lights(temporary.path() / "results", "command", options, monitor);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  std::ifstream file(temporary.path() / "results/low_rank_patio.json");
  const auto json = nlohmann::json::parse(file);
  EXPECT_EQ(json.at("frames"), 6);
  EXPECT_TRUE(json.at("errors").empty());
  const fs::path frames = temporary.path() / "results/low_rank_patio";
  EXPECT_EQ(std::distance(fs::directory_iterator(frames), fs::directory_iterator()), 3);
  EXPECT_TRUE(fs::exists(frames / "0004.png"));
}

TEST(ChangingLights, RefuseWhatCannotBeShown) {
  SilentMonitor monitor;
  ChangingLightsOptions options = small_patio();
  options.coarse_patches = 20;
  EXPECT_THROW(measure_changing_lights(options, monitor), UsageError);
  options = small_patio();
  options.pictures = 7;
  EXPECT_THROW(measure_changing_lights(options, monitor), UsageError);
}

struct SmallFactors {
  Segments V{{0, 30, 50, 71, 100}};
  Eigen::MatrixXd U{100, 4};
  Eigen::MatrixXd reflectance{100, 3};

  SmallFactors() {
    RandomStream random(3);
    for (double& entry : U.reshaped()) entry = random.uniform(0, 0.01);
    for (double& entry : reflectance.reshaped()) entry = random.uniform(0.1, 0.9);
  }

  Eigen::MatrixXd answer(const Eigen::MatrixXd& E, const Eigen::MatrixXd& rho) const {
    Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(100, 4);
    for (Index p = 0; p < 4; ++p)
      for (auto s = V.offsets()[static_cast<std::size_t>(p)];
           s < V.offsets()[static_cast<std::size_t>(p) + 1]; ++s)
        indicator(s, p) = 1;
    Eigen::MatrixXd B(100, 3);
    for (Index c = 0; c < 3; ++c) {
      const Eigen::MatrixXd T = rho.col(c).asDiagonal() * U * indicator.transpose();
      B.col(c) = LuFactors(Eigen::MatrixXd::Identity(100, 100) - T).solve(E.col(c));
    }
    return B;
  }
};

TEST(SharedFactorFrame, SolvesForEveryColourAndForNewOnes) {
  const SmallFactors room;
  const TallMatrix<float> U(room.U);
  SharedFactorFrame frame(room.V, U, room.reflectance);
  RandomStream random(5);
  Eigen::MatrixXd E(100, 3);
  for (double& entry : E.reshaped()) entry = random.uniform();
  Eigen::MatrixXd B(100, 3);
  frame.solve(E, B);
  const Eigen::MatrixXd exact = room.answer(E, room.reflectance);
  EXPECT_LE((B - exact).norm(), 1e-6 * exact.norm());
  const Eigen::MatrixXd repainted = room.reflectance.colwise().reverse();
  const Eigen::MatrixXd new_exact = room.answer(E, repainted);
  EXPECT_GT((B - new_exact).norm(), 1e-2 * new_exact.norm());
  frame.set_reflectance(repainted);
  frame.solve(E, B);
  EXPECT_LE((B - new_exact).norm(), 1e-6 * new_exact.norm());
  EXPECT_EQ(frame.bytes(), U.entry_bytes() + 5 * 8 + 3 * 16 * 8);
}

}  // namespace
}  // namespace radiosity
