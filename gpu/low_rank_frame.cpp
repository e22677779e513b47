#include "gpu/low_rank_frame.hpp"

#include "foundation/error.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

constexpr unsigned frame_emission_binding = 3;
constexpr unsigned frame_radiosity_binding = 4;

double unit_of(const ConstFieldRef& field) {
  return storage_scale<float>(field.size() == 0 ? 0 : field.cwiseAbs().maxCoeff());
}

/// The fields of frames are in float32.
const FactorsOnDevice& require_float(const FactorsOnDevice& factors) {
  if (factors.in_double())
    fail<UsageError>("frames that stay on the device are in float32: take factors with storage=f32");
  return factors;
}

}  // namespace

LowRankFrame::LowRankFrame(const FactorsOnDevice& factors, Index columns)
    : factors_(require_float(factors)),
      emission_(factors.device().context(), factors.rows(), columns),
      product_(factors.device().context(), factors.rows(), columns),
      radiosity_(factors.device().context(), factors.rows(), columns),
      coefficients_(factors.device().context(), std::max<Index>(factors.rank(), 1), columns),
      subtraction_(&factors.device().program({"frame_sum.comp", {}})) {}

void LowRankFrame::send(const ConstFieldRef& emission) {
  unit_ = unit_of(emission);
  emission_.write(emission / unit_);
}

void LowRankFrame::sum() const {
  factors_.sum_on_device(emission_.buffer(), emission_.columns());
}

void LowRankFrame::compute() const {
  factors_.multiply_on_device(emission_.buffer(), product_.buffer(), emission_.columns());
  subtract(factors_.scale());
}

void LowRankFrame::compute_with(const ConstFieldRef& X) {
  const double unit = unit_of(X);
  coefficients_.write(X / unit);
  factors_.multiply_left_on_device(coefficients_.buffer(), product_.buffer(), emission_.columns());
  subtract(factors_.left_scale() * unit / unit_);
}

void LowRankFrame::subtract(double scale) const {
  product_.buffer().bind(FieldBuffers::y_binding);
  emission_.buffer().bind(frame_emission_binding);
  radiosity_.buffer().bind(frame_radiosity_binding);
  const Index numbers = emission_.stride() * emission_.columns();
  subtraction_->use();
  subtraction_->set("numbers", numbers);
  subtraction_->set("scale_bits", std::bit_cast<std::uint32_t>(static_cast<float>(scale)));
  subtraction_->dispatch(numbers / FieldBuffers::padding);
}

void LowRankFrame::receive(FieldRef radiosity) const {
  radiosity = unit_ * radiosity_.read();
}

}  // namespace radiosity
