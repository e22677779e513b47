// Hard case R2: the spectral radius is bounded before any Neumann run.

#include "operators/operator_registry.hpp"
#include "room_operators.hpp"
#include "solvers/spectral_radius.hpp"

#include <gtest/gtest.h>

namespace radiosity::testing {
namespace {

/// The radius by a thousand plain power steps on T^2, which cannot oscillate.
double power_radius(const Room& room) {
  double radius = 0;
  for (Index c = 0; c < room.reflectance.cols(); ++c) {
    const Eigen::MatrixXd T = room.transport(c);
    Eigen::VectorXd x = Eigen::VectorXd::Ones(room.size());
    double growth = 0;
    for (int k = 0; k < 1000; ++k) {
      const Eigen::VectorXd next = T * (T * x);
      growth = std::sqrt(next.norm() / x.norm());
      if (growth == 0) break;
      x = next / next.norm();
    }
    radius = std::max(radius, growth);
  }
  return radius;
}

TEST(SpectralRadius, LiesBetweenItsBounds) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    for (const Index channels : {1, 3}) {
      const Room room = open_room(70, seed, channels);
      const SpectralRadius bounds = bound_spectral_radius(RoomTransport(room));
      const double radius = power_radius(room);
      ASSERT_TRUE(bounds.upper.has_value());
      EXPECT_LE(radius, *bounds.upper * (1 + 1e-12));
      EXPECT_GE(radius, bounds.lower * (1 - 1e-12));
      EXPECT_LE(*bounds.upper, 1.1 * radius) << "a bound that is of no use";
      EXPECT_NEAR(bounds.estimate, radius, 0.05 * radius);
    }
}

TEST(SpectralRadius, IsExactForOneReflectanceInAClosedRoom) {
  const SpectralRadius bounds = bound_spectral_radius(RoomKernel(closed_room(70, 1, 0.9)));
  EXPECT_NEAR(*bounds.upper, 0.9, 1e-12);
  EXPECT_NEAR(bounds.lower, 0.9, 1e-12);
  EXPECT_EQ(bounds.products, 1);
}

TEST(SpectralRadius, TwoFacingPlatesDoNotMakeItOscillate) {
  Room room;
  room.area = Eigen::Vector2d(1, 9);
  room.reflectance = Eigen::MatrixXd::Constant(2, 1, 0.9);
  room.kernel = Eigen::Matrix2d{{0, 0.3}, {0.3, 0}};
  const SpectralRadius bounds = bound_spectral_radius(RoomTransport(room));
  EXPECT_GE(*bounds.upper, 0.27);
  EXPECT_LE(*bounds.upper, 0.3);
}

TEST(SpectralRadius, RowSumsAloneWouldBeTooSmallABound) {
  // The broken variant: the mean row sum is no bound once rows differ.
  const Room room = open_room(70, 2, 1);
  EXPECT_LT(room.transport(0).rowwise().sum().mean(), power_radius(room));
}

TEST(SpectralRadius, SignedSymmetricKernelsAreBoundedByLanczos) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Room room = closed_room(80, seed, 0.9);
    room.kernel.row(3) *= -1;
    room.kernel.col(3) *= -1;
    room.kernel -= 0.002 * Eigen::MatrixXd::Ones(80, 80);
    const SpectralRadius bounds = bound_spectral_radius(RoomKernel(room));
    ASSERT_TRUE(bounds.upper.has_value());
    EXPECT_LT(bounds.confidence, 1);
    EXPECT_LE(power_radius(room), *bounds.upper);
    EXPECT_LE(*bounds.upper, 1.05 * power_radius(room));
    // What positive fields alone say of a signed operator is nothing.
    EXPECT_FALSE(collatz_wielandt_bounds(RoomKernel(room)).upper.has_value());
  }
}

// Wavelets reproduce uniform fields, so that no product with one shows that their operator is signed.
TEST(SpectralRadius, LowRankFactorsAreSignedThoughNoProductShowsIt) {
  const FormFactors F = form_factors_of(closed_room(40, 3, 0.9));
  const auto wavelets = cpu_operators().make("wavelet:k=8", F);
  Field image(40, 1);
  wavelets->apply(Field::Ones(40, 1), image);
  EXPECT_GT(image.minCoeff(), 0);
  EXPECT_FALSE(bound_spectral_radius(*wavelets).upper.has_value());
  EXPECT_TRUE(bound_spectral_radius(*cpu_operators().make("svd:k=8,norm=area", F)).upper.has_value());
}

TEST(SpectralRadius, LanczosHelpsWhereRowsAreUneven) {
  Room room = closed_room(80, 4, 0.9);
  room.kernel.topLeftCorner(4, 4) *= 7;
  const SpectralRadius rows = collatz_wielandt_bounds(RoomKernel(room), 1);
  ASSERT_GE(*rows.upper, 1);
  EXPECT_LT(*bound_spectral_radius(RoomKernel(room), 1).upper, 1);
  EXPECT_GE(*bound_spectral_radius(RoomKernel(room), 1).upper, power_radius(room));
}

TEST(SpectralRadius, ADarkRoomHasNone) {
  Room room = closed_room(30, 1, 0);
  EXPECT_EQ(*bound_spectral_radius(RoomTransport(room)).upper, 0);
}

}  // namespace
}  // namespace radiosity::testing
