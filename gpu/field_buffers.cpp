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

template <typename Number>
std::size_t bytes_of(const std::vector<Number>& numbers) {
  return numbers.size() * sizeof(Number);
}

}  // namespace

template <typename Number>
void FieldBuffers::send(const ConstFieldRef& X, Index y_rows) {
  const Index stride = padded(X.rows());
  auto& numbers = std::get<std::vector<Number>>(numbers_);
  numbers.assign(static_cast<std::size_t>(stride * X.cols()), 0);
  column_scale_.resize(static_cast<std::size_t>(X.cols()));
  for (Index c = 0; c < X.cols(); ++c) {
    const double scale = scale_of(X.col(c));
    column_scale_[static_cast<std::size_t>(c)] = scale;
    Eigen::Map<Eigen::VectorX<Number>>(numbers.data() + c * stride, X.rows()) =
        (X.col(c) / scale).template cast<Number>();
  }
  GlBuffer& x = x_.reserve(context_, bytes_of(numbers));
  x.write(0, bytes_of(numbers), numbers.data());
  y_in_use_ = &y_.reserve(context_, static_cast<std::size_t>(padded(y_rows) * X.cols()) * sizeof(Number));
  x.bind(x_binding);
  y_in_use_->bind(y_binding);
}

template <typename Number>
void FieldBuffers::receive(double scale, FieldRef Y) {
  const Index stride = padded(Y.rows());
  auto& numbers = std::get<std::vector<Number>>(numbers_);
  numbers.resize(static_cast<std::size_t>(stride * Y.cols()));
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  y_in_use_->read(bytes_of(numbers), numbers.data());
  for (Index c = 0; c < Y.cols(); ++c)
    Y.col(c) = (scale * column_scale_[static_cast<std::size_t>(c)]) *
               Eigen::Map<const Eigen::VectorX<Number>>(numbers.data() + c * stride, Y.rows())
                   .template cast<double>();
}

template void FieldBuffers::send<float>(const ConstFieldRef& X, Index y_rows);
template void FieldBuffers::send<double>(const ConstFieldRef& X, Index y_rows);
template void FieldBuffers::receive<float>(double scale, FieldRef Y);
template void FieldBuffers::receive<double>(double scale, FieldRef Y);

}  // namespace radiosity
