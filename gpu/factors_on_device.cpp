#include "gpu/factors_on_device.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <utility>

namespace radiosity {

FactorsOnDevice::FactorsOnDevice(std::shared_ptr<GlDevice> device, std::string left_name,
                                 std::shared_ptr<const TallOnDevice> U,
                                 std::shared_ptr<const RightFactorOnDevice> V)
    : DeviceMatrix(std::move(device), U->rows(), U->rows()),
      left_name_(std::move(left_name)),
      left_(std::move(U)),
      right_(std::move(V)) {}

ByteCount FactorsOnDevice::bytes() const {
  ByteCount bytes = left_bytes();
  const ByteCount right = right_->bytes();
  bytes.parts.insert(bytes.parts.end(), right.parts.begin(), right.parts.end());
  return bytes;
}

void FactorsOnDevice::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  if (rank() == 0)
    Y.setZero();
  else
    run(C, Y, left_scale(), [this](Index columns) { left_->multiply(columns); });
}

void FactorsOnDevice::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  if (rank() == 0) return;
  run(X, C, right_scale(), [this](Index columns) {
    device().fields().bind_y(RightFactorOnDevice::coefficients_binding);
    right_->multiply(columns);
  });
}

void FactorsOnDevice::multiply_left_on_device(const GlBuffer& C, const GlBuffer& Y, Index columns) const {
  C.bind(FieldBuffers::x_binding);
  Y.bind(FieldBuffers::y_binding);
  left_->multiply(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FactorsOnDevice::sum_on_device(const GlBuffer& X, Index columns) const {
  X.bind(FieldBuffers::x_binding);
  dispatch_sums(columns);
}

GlBuffer& FactorsOnDevice::dispatch_sums(Index columns) const {
  const Index numbers = columns * FieldBuffers::padded(std::max<Index>(rank(), 1));
  const std::size_t number_bytes = in_double() ? sizeof(double) : sizeof(float);
  GlBuffer& coefficients =
      coefficients_.reserve(device().context(), static_cast<std::size_t>(numbers) * number_bytes);
  if (rank() == 0) return coefficients;
  coefficients.bind(RightFactorOnDevice::coefficients_binding);
  right_->multiply(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  return coefficients;
}

void FactorsOnDevice::dispatch(Index columns) const {
  dispatch_sums(columns).bind(FieldBuffers::x_binding);
  left_->multiply(columns);
}

}  // namespace radiosity
