#include "gpu/field_buffers.hpp"

#include "kernels/stored_number.hpp"

#include <cmath>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

/// 1 for numbers that are not finite, which then arrive as they are.
double scale_of(const Eigen::Ref<const Eigen::VectorXd>& column) {
  const double largest = column.cwiseAbs().maxCoeff();
  return std::isfinite(largest) ? storage_scale<float>(largest) : 1;
}

std::size_t float_bytes(Index numbers) {
  return static_cast<std::size_t>(numbers) * sizeof(float);
}

}  // namespace

void FieldBuffers::send(const ConstFieldRef& X, Index y_rows) {
  const Index stride = padded(X.rows());
  numbers_.assign(static_cast<std::size_t>(stride * X.cols()), 0);
  column_scale_.resize(static_cast<std::size_t>(X.cols()));
  for (Index c = 0; c < X.cols(); ++c) {
    const double scale = scale_of(X.col(c));
    column_scale_[static_cast<std::size_t>(c)] = scale;
    Eigen::Map<Eigen::VectorXf>(numbers_.data() + c * stride, X.rows()) = (X.col(c) / scale).cast<float>();
  }
  GlBuffer& x = x_.reserve(context_, float_bytes(stride * X.cols()));
  x.write(0, float_bytes(stride * X.cols()), numbers_.data());
  y_in_use_ = &y_.reserve(context_, float_bytes(padded(y_rows) * X.cols()));
  x.bind(x_binding);
  y_in_use_->bind(y_binding);
}

void FieldBuffers::receive(double scale, FieldRef Y) {
  const Index stride = padded(Y.rows());
  numbers_.resize(static_cast<std::size_t>(stride * Y.cols()));
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  y_in_use_->read(float_bytes(stride * Y.cols()), numbers_.data());
  for (Index c = 0; c < Y.cols(); ++c)
    Y.col(c) = (scale * column_scale_[static_cast<std::size_t>(c)]) *
               Eigen::Map<const Eigen::VectorXf>(numbers_.data() + c * stride, Y.rows()).cast<double>();
}

}  // namespace radiosity
