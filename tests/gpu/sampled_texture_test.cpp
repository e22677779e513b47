#include "gpu/device_operator.hpp"
#include "gpu/gl_operators.hpp"
#include "gpu/sampling_difference.hpp"
#include "gpu/upload.hpp"
#include "operators/operator_checks.hpp"
#include "tests/conformance/transport_cases.hpp"
#include "tests/gpu/device_test.hpp"

#include <cmath>
#include <cstdint>
#include <string>

namespace radiosity {
namespace {

/// BC1 blocks in compressed textures. Each upload compares its product with the CPU's, to what texture units
/// may round.
class SampledTextures : public DeviceTest {
 protected:
  static std::unique_ptr<LinearOperator> make(const std::string& spec, const FormFactors& form_factors,
                                              const std::shared_ptr<GlDevice>& where = device()) {
    return gl_operators(where, cpu_operators()).make(spec, form_factors);
  }

  static FormFactors coloured_room(Index n) {
    Eigen::MatrixXd reflectance(n, 3);
    reflectance << Eigen::VectorXd::Constant(n, 0.7), Eigen::VectorXd::Constant(n, 0.2),
        Eigen::VectorXd::LinSpaced(n, 0.1, 0.9);
    return symmetric_form_factors(random_kernel(n, 5), Eigen::VectorXd::LinSpaced(n, 1, 3), reflectance);
  }

  static Field product(const LinearOperator& transport, const Field& X) {
    Field Y(X.rows(), X.cols());
    transport.apply(X, Y);
    return Y;
  }
};

TEST_F(SampledTextures, HaveACertificateThatHoldsWhateverTheirUnitsRound) {
  for (TransportCase& data : transport_cases(70))
    for (const char* spec : {"dxt:reorder=rows,strategy=group,blocks=texture",
                             "dxt:map=linear,strategy=invocation,blocks=texture"}) {
      SCOPED_TRACE(data.name + ", " + spec);
      EXPECT_EQ(check_certificate(*make(spec, data.form_factors), data.reference, data.root_area), "");
    }
}

TEST_F(SampledTextures, AddToTheCertificateOfTheSameBlocksInABuffer) {
  const FormFactors form_factors = coloured_room(70);
  const Certificate sampled = make("dxt:blocks=texture", form_factors)->certificate();
  const Certificate decoded = make("dxt", form_factors)->certificate();
  EXPECT_GT(*sampled.operator_error, *decoded.operator_error);
  EXPECT_GT(*sampled.spectral_radius_bound, *decoded.spectral_radius_bound);
  EXPECT_FALSE(make("dxt:bounces=2,blocks=texture", form_factors)->certificate().operator_error.has_value());
}

TEST_F(SampledTextures, SumAllBouncesTooAndTakeOneChannelOrThree) {
  const FormFactors form_factors = coloured_room(33);
  const auto original = cpu_operators().make("dxt:bounces=3,reorder=none", form_factors);
  const auto copy = make("dxt:bounces=3,reorder=none,blocks=texture", form_factors);
  EXPECT_EQ(copy->describe(), original->describe() + ",blocks=texture");
  EXPECT_TRUE(copy->global());
}

TEST_F(SampledTextures, AreCutWhereTheyAreLargerThanADeviceAllowsAndGiveTheSameBits) {
  constexpr Index n = 300;  // 75 rows of 80 blocks
  const FormFactors form_factors = coloured_room(n);
  const Field X = Field::Random(n, 3).cwiseAbs();
  for (const char* strategy : {"group", "invocation"}) {
    const std::string spec = std::string("dxt:reorder=none,blocks=texture,strategy=") + strategy;
    const Field whole = product(*make(spec, form_factors), X);
    for (const int side : {4 * 80, 4 * 30, 4 * 7}) {
      const auto small = GlDevice::open({.debug = true, .texture_side = side});
      if (side == 4 * 7)
        EXPECT_THROW(make(spec, form_factors, small), Error) << "a row of blocks is more than a texture";
      else
        EXPECT_EQ(product(*make(spec, form_factors, small), X), whole) << side;
    }
  }
}

TEST_F(SampledTextures, OfOtherBlocksAreRefusedInASentence) {
  for (const char* spec : {"dxt:codec=bc4,blocks=texture", "dxt:matrix=kernel,blocks=texture"}) try {
      make(spec, coloured_room(6));
      ADD_FAILURE() << spec << " was not refused";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("codec=bc1"), std::string::npos) << error.what();
    }
  EXPECT_THROW(make("dense:f32,blocks=texture", coloured_room(6)), UsageError);
}

/// What texture units may round is no licence: patches that lost their light are found out.
TEST_F(SampledTextures, ThatLoseTexelsAreFoundOut) {
  constexpr Index n = 130;
  const auto room = [](const Eigen::MatrixXd& kernel) {
    return symmetric_form_factors(kernel, Eigen::VectorXd::Ones(n), Eigen::MatrixXd::Constant(n, 3, 0.7));
  };
  // Smooth: with logarithms, blocks from 0 to 1 may be rounded by as much as they are.
  const Eigen::MatrixXd kernel = Eigen::MatrixXd::NullaryExpr(n, n, [](Index i, Index j) {
    return (1.2 + std::cos(0.05 * static_cast<double>(i - j))) / (3 * static_cast<double>(n));
  });
  Eigen::MatrixXd damaged = kernel;
  damaged.bottomRows(4).setZero();
  damaged.rightCols(4).setZero();
  for (const std::string spec : {"dxt:exact=0,reorder=none", "dxt:exact=0,reorder=none,map=linear"}) {
    const auto original = cpu_operators().make(spec, room(kernel));
    const auto right = make(spec + ",blocks=texture", room(kernel));
    const auto wrong = make(spec + ",blocks=texture", room(damaged));
    const Eigen::MatrixXd& allowed = dynamic_cast<const OnDevice&>(*right).decoding_difference();
    EXPECT_NO_THROW(compare_products(*original, *right, "a device", allowed)) << spec;
    EXPECT_THROW(compare_products(*original, *wrong, "a device", allowed), Error) << spec;
  }
}

/// Each texel against what Mesa's decoder and NVIDIA's make of the same block: codes of 8 bits with weights
/// of 85/256, cut, and of 80.25/256 in green.
TEST(SampledTexelBounds, ContainWhatKnownTextureUnitsRound) {
  for (const bool logarithmic : {false, true}) {
    ColourTexture texture(4, 64, 1, {.logarithmic = logarithmic});
    for (Index b = 0; b < 16; ++b)
      texture.set_block(
          0, b,
          {static_cast<std::uint16_t>((17 + 3 * b) << 5), static_cast<std::uint16_t>(b << 5), 0xe4e4e4e4});
    const SampledTexelBounds bounds(texture);
    const auto number = [&](double code) {
      if (!logarithmic) return code / 255;
      return code == 0 ? 0.0 : std::exp(texture.curve().range * (code / 255 - 1));
    };
    for (Index c = 0; c < 64; ++c) {
      const auto widened = [](Index code) { return static_cast<double>(code << 2 | code >> 4); };
      const double first = widened(17 + 3 * (c / 4));
      const double second = widened(c / 4);
      const double weight = 80.25 / 256;
      const double cut[] = {first, second, std::floor(first + 85 * (second - first) / 256),
                            std::floor(first + 170 * (second - first) / 256)};
      const double weighed[] = {first, second, std::floor(first + weight * (second - first) + 0.5),
                                std::floor(second + weight * (first - second) + 0.5)};
      const auto texel = static_cast<double>(texture.texel(0, c, 0));
      EXPECT_LE(std::fabs(number(cut[c % 4]) - texel), bounds(0, c, 0)) << c;
      EXPECT_LE(std::fabs(number(weighed[c % 4]) - texel), bounds(0, c, 0)) << c;
    }
  }
}

TEST(SampledTexelBounds, AreZeroForBlack) {
  const ColourTexture texture(4, 64, 3, {});
  const SampledTexelBounds bounds(texture);
  for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(bounds(3, 7, channel), 0);
}

}  // namespace
}  // namespace radiosity
