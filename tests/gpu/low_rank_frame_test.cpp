#include "foundation/random.hpp"
#include "gpu/low_rank_frame.hpp"
#include "gpu/low_rank_on_device.hpp"
#include "gpu/sparse_v_on_device.hpp"
#include "tests/gpu/device_test.hpp"

#include <vector>

namespace radiosity {
namespace {

using Frames = DeviceTest;

Eigen::MatrixXd random_matrix(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.uniform(0, 1); });
}

/// n = 200 rows in segments of unequal length.
const std::vector<std::int64_t> offsets = {0, 30, 30, 130, 200};

Eigen::MatrixXd plain_v() {
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(200, 4);
  for (Index p = 0; p < 4; ++p)
    V.col(p)
        .segment(offsets[static_cast<std::size_t>(p)],
                 offsets[static_cast<std::size_t>(p) + 1] - offsets[static_cast<std::size_t>(p)])
        .setOnes();
  return V;
}

TEST_F(Frames, GiveThePlainAlgorithmsRadiosity) {
  const Eigen::MatrixXd Y = -1e-3 * random_matrix(200, 4, 1);
  const Eigen::MatrixXd V = plain_v();
  const Eigen::MatrixXd E = 1e4 * random_matrix(200, 3, 2);
  const Eigen::MatrixXd expected = E - Y * (V.transpose() * E);
  const LowRankOnDevice full(device(), TallMatrix<float>(Y), TallMatrix<float>(V), RowStrategy::group);
  const SparseVOnDevice sparse(device(), TallMatrix<float>(Y), Segments(offsets), RowStrategy::invocation);
  for (const FactorsOnDevice* factors :
       {static_cast<const FactorsOnDevice*>(&full), static_cast<const FactorsOnDevice*>(&sparse)}) {
    const CurrentContext current(*device()->context());
    LowRankFrame frame(*factors, 3);
    Eigen::MatrixXd B(200, 3);
    frame.send(E);
    frame.compute();
    frame.receive(B);
    EXPECT_LE((B - expected).cwiseAbs().maxCoeff(), 200 * 0x1p-24 * expected.maxCoeff());
    B.setZero();
    frame.compute_with(V.transpose() * E);
    frame.receive(B);
    EXPECT_LE((B - expected).cwiseAbs().maxCoeff(), 200 * 0x1p-24 * expected.maxCoeff());
    EXPECT_GT((B - E).minCoeff(), 1) << "light is reflected";
  }
}

/// D1: nothing grows from frame to frame.
TEST_F(Frames, StayAsExactWhileALightMovesThroughAHundred) {
  const Eigen::MatrixXd Y = -1e-3 * random_matrix(200, 4, 1);
  const Eigen::MatrixXd V = plain_v();
  const SparseVOnDevice sparse(device(), TallMatrix<float>(Y), Segments(offsets), RowStrategy::invocation);
  const CurrentContext current(*device()->context());
  LowRankFrame frame(sparse, 1);
  Eigen::MatrixXd B(200, 1);
  const GlTraffic before = device()->context()->traffic();
  for (Index moment = 0; moment < 100; ++moment) {
    Eigen::MatrixXd E = Eigen::MatrixXd::Zero(200, 1);
    E(2 * moment, 0) = 7;
    frame.send(E);
    frame.compute();
    frame.receive(B);
    const Eigen::MatrixXd expected = E - Y * (V.transpose() * E);
    ASSERT_LE((B - expected).cwiseAbs().maxCoeff(), 200 * 0x1p-24 * 7) << moment;
  }
  EXPECT_EQ(device()->context()->traffic().sendings, before.sendings + 100);
  EXPECT_EQ(device()->context()->traffic().receipts, before.receipts + 100);
}

TEST_F(Frames, RefuseFactorsInDoublePrecision) {
  const TallMatrix<double> Y(random_matrix(200, 4, 1));
  const LowRankOnDevice factors(device(), Y, Y, RowStrategy::group);
  const CurrentContext current(*device()->context());
  EXPECT_THROW(LowRankFrame(factors, 1), UsageError);
}

}  // namespace
}  // namespace radiosity
