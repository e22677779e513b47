#include "gpu/factors_on_device.hpp"

#include <epoxy/gl.h>

namespace radiosity {

void FactorsOnDevice::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  if (rank_ == 0)
    Y.setZero();
  else
    run(C, Y, left_scale(), [this](Index columns) { dispatch_left(columns); });
}

void FactorsOnDevice::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  if (rank_ == 0) return;
  run(X, C, right_scale(), [this](Index columns) {
    device().fields().bind_y(coefficients_binding);
    dispatch_right(columns);
  });
}

void FactorsOnDevice::multiply_left_on_device(const GlBuffer& C, const GlBuffer& Y, Index columns) const {
  C.bind(FieldBuffers::x_binding);
  Y.bind(FieldBuffers::y_binding);
  dispatch_left(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void FactorsOnDevice::sum_on_device(const GlBuffer& X, Index columns) const {
  X.bind(FieldBuffers::x_binding);
  dispatch_sums(columns);
}

GlBuffer& FactorsOnDevice::dispatch_sums(Index columns) const {
  const Index numbers = columns * FieldBuffers::padded(std::max<Index>(rank_, 1));
  GlBuffer& coefficients =
      coefficients_.reserve(device().context(), static_cast<std::size_t>(numbers) * sizeof(float));
  if (rank_ == 0) return coefficients;
  coefficients.bind(coefficients_binding);
  dispatch_right(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  return coefficients;
}

void FactorsOnDevice::dispatch(Index columns) const {
  dispatch_sums(columns).bind(FieldBuffers::x_binding);
  dispatch_left(columns);
}

}  // namespace radiosity
