#include "experiments/device/device_bounces.hpp"

#include "experiments/device/repeated_timing.hpp"
#include "experiments/dxt_radiosity/dxt_speed.hpp"
#include "experiments/dxt_radiosity/improvement_steps.hpp"
#include "gpu/device_operator.hpp"
#include "gpu/neumann_on_device.hpp"
#include "gpu/upload.hpp"

#include <fmt/format.h>

#include <utility>

namespace radiosity {
namespace {

/// E + T E, or what a global operator gives.
void sum_of_bounces(const LinearOperator& sum, const Field& E, Field& B) {
  B = E;
  sum.apply(1, E, sum.global() ? 0 : 1, B);
}

class BounceTimer {
 public:
  BounceTimer(const std::shared_ptr<GlDevice>& device, const FormFactors& form_factors, const Field& emission,
              long bounces, double seconds)
      : device_(device),
        root_area_(form_factors.mesh->area.cwiseSqrt()),
        E_(emission),
        bounces_(static_cast<int>(bounces)),
        seconds_(seconds) {}

  /// Bounce by bounce with T, the channels in one piece or one after the other.
  DeviceMethodSpeed iterated(const std::string& name, const LinearOperator& transport, bool packed,
                             const Field& reference) const {
    const DeviceTransport whole = transport_on_device(transport).value();
    std::vector<Field> emissions;
    std::vector<std::unique_ptr<NeumannOnDevice>> iterations;
    for (Index c = 0; c < (packed ? 1 : E_.cols()); ++c) {
      DeviceTransport part = whole;
      if (!packed) part = {whole.matrix, whole.left.col(c), whole.right.col(c), whole.order};
      iterations.push_back(std::make_unique<NeumannOnDevice>(part, root_area_));
      emissions.push_back(packed ? E_ : Field(E_.col(c)));
    }
    Field B = E_;
    DeviceMethodSpeed speed{.name = name, .bytes = transport.bytes().total()};
    const auto send = [&] {
      for (std::size_t part = 0; part < iterations.size(); ++part) iterations[part]->start(emissions[part]);
    };
    const auto receive = [&] {
      for (std::size_t part = 0; part < iterations.size(); ++part)
        B.middleCols(static_cast<Index>(part), emissions[part].cols()) = iterations[part]->solution();
    };
    send();
    speed.on_device = time_repeatedly(seconds_, [&] {
      const double before = whole.matrix->device_seconds();
      for (const auto& iteration : iterations) iteration->advance(bounces_);
      return whole.matrix->device_seconds() - before;
    });
    speed.with_transfers = time_by_clock(seconds_, [&] {
      send();
      for (const auto& iteration : iterations) iteration->advance(bounces_);
      receive();
    });
    speed.difference = difference(B, reference);
    return speed;
  }

  /// One product with what is summed up before.
  DeviceMethodSpeed summed(const std::string& name, const LinearOperator& on_cpu) const {
    const auto sum = upload(device_, on_cpu);
    Field B;
    Field reference;
    sum_of_bounces(on_cpu, E_, reference);
    DeviceMethodSpeed speed{.name = name, .bytes = sum->bytes().total()};
    speed.on_device = time_repeatedly(seconds_, [&] {
      const double before = sum->device_use()->device_seconds;
      sum_of_bounces(*sum, E_, B);
      return sum->device_use()->device_seconds - before;
    });
    speed.with_transfers = time_by_clock(seconds_, [&] { sum_of_bounces(*sum, E_, B); });
    speed.difference = difference(B, reference);
    return speed;
  }

 private:
  double difference(const Field& B, const Field& reference) const {
    return (root_area_.asDiagonal() * (B - reference)).norm() / (root_area_.asDiagonal() * reference).norm();
  }

  std::shared_ptr<GlDevice> device_;
  Eigen::VectorXd root_area_;
  const Field& E_;
  int bounces_;
  double seconds_;
};

}  // namespace

DeviceSpeedRound time_device_bounces(const std::shared_ptr<GlDevice>& device, const FormFactors& form_factors,
                                     const Field& emission, long bounces, double seconds,
                                     const OperatorRegistry& cpu) {
  const BounceTimer timer(device, form_factors, emission, bounces, seconds);
  DeviceSpeedRound round{form_factors.patch_count(), emission.cols(), bounces, {}};
  const auto transport = cpu.make("dense:f32", form_factors);
  const Field reference = after_bounces(*transport, emission, bounces);
  const auto on_device = upload(device, *transport);
  round.methods.push_back(timer.iterated("naive", *on_device, false, reference));
  round.methods.push_back(timer.iterated("packed", *on_device, true, reference));
  for (const auto& [name, spec] :
       {std::pair<std::string, std::string>{float_sum, fmt::format("bounces:k={},storage=f32", bounces)},
        {document_sum, fmt::format("{}:bounces={}", document_variant, bounces)},
        {improved_sum, fmt::format("{},bounces={}", improved_variant, bounces)}})
    round.methods.push_back(timer.summed(name, *cpu.make(spec, form_factors)));
  return round;
}

}  // namespace radiosity
