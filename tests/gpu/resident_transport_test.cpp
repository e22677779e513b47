#include "gpu/gl_operators.hpp"
#include "gpu/resident_transport.hpp"
#include "tests/conformance/transport_cases.hpp"
#include "tests/gpu/device_test.hpp"

#include <epoxy/gl.h>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {
namespace {

constexpr Index room_patches = 150;  // no multiple of 64
constexpr int products = 4;

/// With as many distinct reflectances as there are channels.
FormFactors coloured_room(Index channels) {
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(room_patches, channels, 0.6);
  for (Index channel = 0; channel < channels; ++channel)
    for (Index i = 0; i < room_patches; ++i)
      reflectance(i, channel) -= 0.05 * static_cast<double>((i + channel) % 4);
  return symmetric_form_factors(random_kernel(room_patches, 5), Eigen::VectorXd::Ones(room_patches),
                                reflectance);
}

/// R F B by products on the CPU, of the emission's columns.
Field reflected_light(const LinearOperator& transport, const Field& emission) {
  Field reflected(emission.rows(), emission.cols());
  Field B = emission;
  for (int product = 0; product < products; ++product) {
    transport.apply(B, reflected);
    if (transport.global()) return reflected - emission;
    B = emission + reflected;
  }
  return reflected;
}

/// Twice the roundoff of `products` sums of n products, of the largest component.
double allowed(const Field& expected) {
  return 2 * products * static_cast<double>(room_patches + 8) * 0x1p-24 * expected.cwiseAbs().maxCoeff();
}

/// One of every kind that a device multiplies with.
const std::vector<std::string> transports = {"dense:f32",
                                             "dense:f16",
                                             "csr:f32",
                                             "svd:k=20",
                                             "svd:k=20,norm=area,method=lanczos",
                                             "sparse-v:k=20",
                                             "svd:k=20,global=1",
                                             "svd:k=20,norm=area,global=1",
                                             "sparse-v:k=20,global=1",
                                             "bounces:k=3",
                                             "dxt",
                                             "dxt:codec=bc4",
                                             "dxt:bounces=3,reorder=rows",
                                             "quantized:closure=none",
                                             "topk:closure=none",
                                             "dxt:matrix=kernel,reorder=rows",
                                             "neumann-sparse:threshold=1e-4"};

class FrameTransport : public DeviceTest {
 protected:
  static std::unique_ptr<LinearOperator> on_device(const std::string& spec, const FormFactors& form_factors) {
    return gl_operators(device(), cpu_operators()).make(spec, form_factors);
  }

  /// R F B as the device finds it.
  static Field reflected_there(const LinearOperator& transport, const Field& emission,
                               const Field& reflectance) {
    ResidentTransport resident(device(), transport, products);
    const CurrentContext current(*device()->context());
    resident.emission().write(emission);
    resident.run();
    const Field irradiance = resident.irradiance().read();
    device()->context()->check("a frame's transport");
    return reflectance.cwiseProduct(irradiance);
  }
};

/// D1: the plain arithmetic of the CPU, in float32 storage and double precision.
TEST_F(FrameTransport, EqualsTheProductsOfTheCpu) {
  const FormFactors form_factors = coloured_room(3);
  const Field emission = Field::Random(room_patches, 3).cwiseAbs();
  for (const std::string& spec : transports) {
    SCOPED_TRACE(spec);
    const auto original = cpu_operators().make(spec, form_factors);
    const Field expected = reflected_light(*original, emission);
    const Field found =
        reflected_there(*on_device(spec, form_factors), emission, form_factors.mesh->reflectance);
    EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), allowed(expected));
    const Field fewer = expected - reflected_light(*original, 0.999 * emission);
    EXPECT_GT(fewer.cwiseAbs().maxCoeff(), allowed(expected)) << "would not notice a thousandth";
  }
}

TEST_F(FrameTransport, OfAGreyOperatorTakesColouredLight) {
  const FormFactors form_factors = coloured_room(1);
  const Field emission = Field::Random(room_patches, 3).cwiseAbs();
  for (const std::string& spec : transports) {
    SCOPED_TRACE(spec);
    const Field expected = reflected_light(*cpu_operators().make(spec, form_factors), emission);
    const Field found = reflected_there(*on_device(spec, form_factors), emission,
                                        form_factors.mesh->reflectance.replicate(1, 3));
    EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), allowed(expected));
  }
}

TEST_F(FrameTransport, RefusesWhatIsNotOnTheDeviceAsAWhole) {
  const auto registry = gl_operators(device(), cpu_operators());
  const FormFactors form_factors = coloured_room(3);
  EXPECT_THROW(ResidentTransport(device(), *registry.make("dense:f32,closure=rows", form_factors), 1),
               UsageError);
  EXPECT_THROW(ResidentTransport(device(), *cpu_operators().make("dense:f32", form_factors), 1), UsageError);
  EXPECT_THROW(ResidentTransport(device(), *registry.make("dense:f32", form_factors), 0), UsageError);
  EXPECT_THROW(ResidentTransport(device(), *registry.make("svd:k=20,storage=f64", form_factors), 1),
               UsageError);
}

}  // namespace
}  // namespace radiosity
