#include "gpu/conjugate_gradients_on_device.hpp"
#include "gpu/device_solver.hpp"
#include "gpu/gl_operators.hpp"
#include "gpu/gl_solvers.hpp"
#include "gpu/neumann_on_device.hpp"
#include "tests/conformance/transport_cases.hpp"
#include "tests/gpu/device_test.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace radiosity {
namespace {

class DeviceSolvers : public DeviceTest {
 protected:
  static std::unique_ptr<LinearOperator> on_device(const std::string& spec, const FormFactors& form_factors) {
    return gl_operators(device(), cpu_operators()).make(spec, form_factors);
  }
  static std::unique_ptr<Solver> solver(const std::string& spec, const LinearOperator& transport,
                                        const Eigen::VectorXd& root_area, double tolerance = 1e-6) {
    return gl_solvers(cpu_solvers()).make(spec, {transport, root_area, {.tolerance = tolerance}});
  }

  /// Room for 70 patches of areas from 1e-2 to 1e2 in three colours, one of them black in places.
  static TransportCase coloured_room() {
    for (TransportCase& data : transport_cases(70))
      if (data.form_factors.symmetric() && data.form_factors.mesh->channels() == 3) return data;
    return {};
  }
  static Field lights(const TransportCase& data) {
    Field E = Field::Zero(data.root_area.size(), 6);
    for (Index j = 0; j < E.cols(); ++j) E(3 * j + 1, j) = 5 + static_cast<double>(j);
    E(2, 5) = 1e-3;
    return E;
  }
  static double difference(const Eigen::VectorXd& root_area, const Field& B, const Field& reference) {
    return area_norms(root_area, Field(B - reference))
        .cwiseQuotient(area_norms(root_area, reference))
        .maxCoeff();
  }
};

TEST_F(DeviceSolvers, GiveTheRadiosityThatTheSolversOfTheCpuGive) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  const auto exact = cpu_operators().make("dense", data.form_factors);
  const auto transport = on_device("dense:f32", data.form_factors);
  const auto reference = cpu_solvers().make("lu", {*exact, data.root_area, {}});
  const Field B = solve(*reference, E);
  for (const char* spec : {"cg:fields=device", "neumann:fields=device"}) {
    const auto iterated = solver(spec, *transport, data.root_area);
    EXPECT_LE(difference(data.root_area, solve(*iterated, E), B), 3e-6) << spec;
    EXPECT_LE(iterated->residual(), 1e-6) << spec;
    EXPECT_GT(iterated->products(), 3) << spec;
    EXPECT_EQ(iterated->describe(), spec);
  }
}

/// Of signed operators no solver knows that the series converges; here it does.
TEST_F(DeviceSolvers, IterateWithEveryFormOfAnOperatorThatStandsForT) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  for (const char* spec : {"csr:f32", "dense:f16", "svd:k=8", "2msc:k=8", "svd:k=8,norm=area,method=lanczos",
                           "sparse-v:k=8", "dxt:reorder=rows", "dxt:codec=bc4,reorder=morton",
                           "quantized:closure=none", "dxt:matrix=kernel,codec=u8,reorder=rows"}) {
    SCOPED_TRACE(spec);
    const auto transport = on_device(spec, data.form_factors);
    const Field B = solve(*solver("gmres", *transport, data.root_area), E);
    const auto on = transport_on_device(*transport).value();
    NeumannOnDevice neumann(on, data.root_area);
    neumann.start(E);
    neumann.advance(200);
    EXPECT_LE(difference(data.root_area, neumann.solution(), B), 3e-6);
    if (!transport->symmetric()) continue;
    EXPECT_LE(
        difference(data.root_area, solve(*solver("cg:fields=device", *transport, data.root_area), E), B),
        3e-6);
  }
}

/// Nothing but one norm a column comes back between the beginning and the end, and not in every step.
TEST_F(DeviceSolvers, ReadNoFieldBackBetweenSteps) {
  const TransportCase data = coloured_room();
  const auto transport = on_device("dense:f32", data.form_factors);
  const auto on = transport_on_device(*transport).value();
  const auto& kernel = dynamic_cast<const KernelOperator&>(*transport);
  NeumannOnDevice neumann(on, data.root_area);
  ConjugateGradientsOnDevice gradients(on, kernel);
  for (DeviceIteration* iteration :
       {static_cast<DeviceIteration*>(&neumann), static_cast<DeviceIteration*>(&gradients)}) {
    iteration->start(lights(data));
    const CurrentContext current(*device()->context());
    const GlTraffic before = device()->context()->traffic();
    for (int look = 0; look < 3; ++look) iteration->advance(5);
    const GlTraffic after = device()->context()->traffic();
    EXPECT_EQ(after.sendings, before.sendings) << "a field was sent";
    EXPECT_EQ(after.receipts, before.receipts + 3);
    EXPECT_EQ(after.received_bytes - before.received_bytes, 3 * 6 * 4 * sizeof(float));
  }
  // What is counted is seen: iterated on the CPU, both go with every step.
  const CurrentContext current(*device()->context());
  const auto on_cpu = solver("cg:fields=cpu", *transport, data.root_area);
  on_cpu->start(lights(data));
  const GlTraffic before = device()->context()->traffic();
  for (int step = 0; step < 3; ++step) on_cpu->step();
  EXPECT_GE(device()->context()->traffic().sendings, before.sendings + 3);
  EXPECT_GE(device()->context()->traffic().receipts, before.receipts + 3);
}

TEST_F(DeviceSolvers, ShowTheResidualAndTheRadiosityThatTheDeviceHasBetweenSteps) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  const auto transport = on_device("dense:f32", data.form_factors);
  const auto on = transport_on_device(*transport).value();
  NeumannOnDevice neumann(on, data.root_area);
  neumann.start(E);
  const Eigen::RowVectorXd seen = neumann.advance(3);
  Field B = E;
  Field gathered(E.rows(), E.cols());
  for (int bounce = 0; bounce < 2; ++bounce) {
    transport->apply(B, gathered);
    B = E + gathered;
  }
  transport->apply(B, gathered);
  const Eigen::RowVectorXd expected = area_norms(data.root_area, Field(E + gathered - B));
  EXPECT_LE((seen - expected).cwiseAbs().maxCoeff(), 1e-5 * area_norms(data.root_area, E).maxCoeff());
  EXPECT_LE(difference(data.root_area, neumann.solution(), Field(E + gathered)), 1e-6);
}

/// float32 alone would end at about 1e-7 ||B|| / ||E||; rounds of corrections go on as products allow.
TEST_F(DeviceSolvers, SolveInFurtherRoundsWhatOneInFloatDoesNotReach) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  const auto transport = on_device("dense:f32", data.form_factors);
  const auto on_cpu = solver("cg:fields=cpu", *transport, data.root_area, 1e-9);
  const Field B = solve(*on_cpu, E);
  for (const char* spec : {"cg", "neumann"}) {
    const auto iterated = solver(spec, *transport, data.root_area, 1e-9);
    EXPECT_LE(difference(data.root_area, solve(*iterated, E), B), 1e-6) << spec;
    EXPECT_LE(iterated->residual(), 8 * 0x1p-24 * 4) << spec << ": more than the rounding of products";
  }
}

TEST_F(DeviceSolvers, AddUpInSharedMemoryOrWithoutItToTheSameNorms) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  const auto transport = on_device("dense:f32", data.form_factors);
  const auto on = transport_on_device(*transport).value();
  const auto& kernel = dynamic_cast<const KernelOperator&>(*transport);
  NeumannOnDevice shared_sum(on, data.root_area, RowStrategy::group);
  NeumannOnDevice plain_sum(on, data.root_area, RowStrategy::invocation);
  ConjugateGradientsOnDevice shared_steps(on, kernel, RowStrategy::group);
  ConjugateGradientsOnDevice plain_steps(on, kernel, RowStrategy::invocation);
  for (const auto& [shared, plain] : {std::pair<DeviceIteration*, DeviceIteration*>{&shared_sum, &plain_sum},
                                      {&shared_steps, &plain_steps}}) {
    shared->start(E);
    plain->start(E);
    const Eigen::RowVectorXd norms = plain->advance(1);
    EXPECT_LE((shared->advance(1) - norms).cwiseAbs().maxCoeff(), 1e-4 * norms.maxCoeff());
    EXPECT_GT(norms.minCoeff(), 0);
    EXPECT_LE(difference(data.root_area, shared->solution(), plain->solution()), 1e-5);
  }
}

TEST_F(DeviceSolvers, FollowReflectancesThatChange) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  const auto transport = on_device("dense:f32", data.form_factors);
  auto& kernel = dynamic_cast<KernelOperator&>(*transport);
  const auto iterated = solver("cg:fields=device", *transport, data.root_area);
  const Field before = solve(*iterated, E);
  kernel.set_reflectance(kernel.reflectance() / 2);
  const Field darker = solve(*iterated, E);
  EXPECT_LE(difference(data.root_area, darker, solve(*solver("gmres", *transport, data.root_area), E)), 3e-6);
  EXPECT_GT(difference(data.root_area, before, darker), 1e-2);
}

TEST_F(DeviceSolvers, LeaveToTheCpuWhatHasNoFormForTheDevice) {
  const TransportCase data = coloured_room();
  const auto closed = on_device("dense:f32,closure=symmetric", data.form_factors);
  EXPECT_EQ(solver("cg", *closed, data.root_area)->describe(), "cg");
  const auto open = on_device("dense:f32", data.form_factors);
  EXPECT_EQ(solver("", *open, data.root_area)->describe(), "cg:fields=device");
  EXPECT_EQ(solver("cg:fields=cpu", *open, data.root_area)->describe(), "cg");
  EXPECT_THROW(solver("cg:fields=device", *closed, data.root_area), UsageError);
  const auto unsymmetric = on_device("svd:k=8", data.form_factors);
  EXPECT_THROW(solver("cg:fields=device", *unsymmetric, data.root_area), UsageError);
}

/// Products on the device, fields on the CPU: float32 would stop at 1e-7.
TEST_F(DeviceSolvers, ReachDoublePrecisionWithFactorsThatHaveIt) {
  const TransportCase data = coloured_room();
  const Field E = lights(data);
  for (const std::string spec : {"svd:k=9,storage=f64", "svd:k=9,norm=area,storage=f64"}) {
    const auto original = cpu_operators().make(spec, data.form_factors);
    const auto transport = on_device(spec, data.form_factors);
    const Field B = solve(*cpu_solvers().make("lu", {*original, data.root_area, {}}), E);
    for (const char* name : {"woodbury", "gmres"}) {
      const auto found = solver(name, *transport, data.root_area, 1e-13);
      EXPECT_LE(difference(data.root_area, solve(*found, E), B), 1e-12) << spec << " " << name;
    }
    EXPECT_THROW(solver("neumann:fields=device", *transport, data.root_area), UsageError) << spec;
  }
}

}  // namespace
}  // namespace radiosity
