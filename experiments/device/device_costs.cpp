#include "experiments/device/device_costs.hpp"

#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/low_rank_radiosity/solved_factors.hpp"
#include "foundation/stopwatch.hpp"
#include "gpu/low_rank_on_device.hpp"
#include "gpu/upload.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace radiosity {
namespace {

// Of the ratio on a software renderer.
constexpr double dense_limit = 10;
constexpr double factors_limit = 15;
constexpr double blocks_limit = 3;

/// Processor seconds of all threads a run, from the total of several: the clock of a process leaves out what
/// its other threads have used since they were last looked at, so that the cheapest run would be too cheap.
double mean_cost(double seconds, const std::function<void()>& work) {
  constexpr int fewest_runs = 3;
  const Stopwatch watch;
  int runs = 0;
  for (; runs < fewest_runs || watch.seconds() < seconds; ++runs) work();
  return watch.cpu_seconds() / runs;
}

struct CostOfBoth {
  double cpu_seconds;
  double device_cpu_seconds;
};

/// Medians of several means, by turns: what else the machine does meets both.
CostOfBoth costs_by_turns(double seconds, const std::function<void()>& on_cpu,
                          const std::function<void()>& on_device) {
  constexpr int turns = 5;
  std::array<double, turns> cpu{};
  std::array<double, turns> device{};
  on_cpu();
  on_device();
  for (std::size_t turn = 0; turn < turns; ++turn) {
    cpu[turn] = mean_cost(seconds / turns, on_cpu);
    device[turn] = mean_cost(seconds / turns, on_device);
  }
  std::sort(cpu.begin(), cpu.end());
  std::sort(device.begin(), device.end());
  return {cpu[turns / 2], device[turns / 2]};
}

ProductCost cost_of_operator(const std::shared_ptr<GlDevice>& device, const LinearOperator& on_cpu,
                             Index columns, double limit, double seconds) {
  const auto copy = upload(device, on_cpu);
  const Field X = Field::Ones(on_cpu.size(), columns);
  Field Y(on_cpu.size(), columns);
  const CostOfBoth cost = costs_by_turns(
      seconds, [&] { on_cpu.apply(X, Y); }, [&] { copy->apply(X, Y); });
  return {on_cpu.describe(), columns, cost.cpu_seconds, cost.device_cpu_seconds, limit};
}

ProductCost cost_of_factors(const std::shared_ptr<GlDevice>& device, const ProductCostOptions& options,
                            Index columns) {
  const SolvedFactors factors = random_factors(options.factors, options.seed);
  const TallMatrix<float> V = full_matrix(factors.V);
  const LowRankOnDevice copy(device, factors.Y, V, device->preferred_strategy());
  const Field E = Field::Ones(options.factors.rows, columns);
  Field X(options.factors.rank, columns);
  Field Y(options.factors.rows, columns);
  const auto on_cpu = [&] {
    multiply_transposed(V, E, X);
    multiply(factors.Y, X, Y);
  };
  const CostOfBoth cost = costs_by_turns(options.seconds, on_cpu, [&] { copy.multiply(E, Y); });
  return {fmt::format("low-rank:n={},k={}", options.factors.rows, options.factors.rank), columns,
          cost.cpu_seconds, cost.device_cpu_seconds, factors_limit};
}

FormFactors in_one_channel(const FormFactors& form_factors) {
  PatchMesh mesh = *form_factors.mesh;
  mesh.reflectance = form_factors.mesh->reflectance.leftCols(1);
  mesh.emission = form_factors.mesh->emission.leftCols(1);
  FormFactors result = form_factors;
  result.mesh = std::make_shared<const PatchMesh>(std::move(mesh));
  return result;
}

}  // namespace

std::vector<ProductCost> measure_product_costs(const std::shared_ptr<GlDevice>& device,
                                               const FormFactors& form_factors,
                                               const ProductCostOptions& options,
                                               const OperatorRegistry& cpu) {
  std::vector<ProductCost> costs;
  const FormFactors one_channel = in_one_channel(form_factors);
  for (const char* spec : {"dense:f32", "dense:f16"}) {
    const auto on_cpu = cpu.make(spec, one_channel);
    for (const Index columns : {1, 3})
      costs.push_back(cost_of_operator(device, *on_cpu, columns, dense_limit, options.seconds));
  }
  for (const Index columns : {1, 3}) costs.push_back(cost_of_factors(device, options, columns));
  for (const FormFactors* channels : {&one_channel, &form_factors}) {
    const auto on_cpu = cpu.make("dxt", *channels);
    costs.push_back(cost_of_operator(device, *on_cpu, on_cpu->channels(), blocks_limit, options.seconds));
  }
  return costs;
}

}  // namespace radiosity
