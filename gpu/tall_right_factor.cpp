#include "gpu/tall_right_factor.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <utility>

namespace radiosity {
namespace {

constexpr unsigned values_of_rank_binding = 5;
constexpr Index numbers_of_sum_group = 64;

}  // namespace

TallRightFactor::TallRightFactor(std::shared_ptr<GlDevice> device, std::shared_ptr<const TallOnDevice> V)
    : device_(std::move(device)), matrix_(std::move(V)) {}

TallRightFactor::TallRightFactor(std::shared_ptr<GlDevice> device, std::shared_ptr<const TallOnDevice> Q,
                                 const Eigen::VectorXd& values)
    : TallRightFactor(std::move(device), std::move(Q)) {
  if (in_double())
    upload_values<double>(values);
  else
    upload_values<float>(values);
}

template <typename Number>
void TallRightFactor::upload_values(const Eigen::VectorXd& values) {
  const CurrentContext current(*device_->context());
  values_scale_ = storage_scale<Number>(values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff());
  const Eigen::VectorX<Number> scaled = (values / values_scale_).template cast<Number>();
  const std::size_t bytes = static_cast<std::size_t>(scaled.size()) * sizeof(Number);
  values_.emplace(device_->context(), std::max(bytes, sizeof(Number)));
  if (bytes > 0) values_->write(0, bytes, scaled.data());
}

ByteCount TallRightFactor::bytes() const {
  if (values_) return {{{"values", values_->bytes()}}};
  return {{{"V", matrix_->bytes()}}};
}

void TallRightFactor::multiply(Index columns) const {
  const Index rank = matrix_->columns();
  const Index stride = FieldBuffers::padded(rank);
  const auto sums = static_cast<std::size_t>(std::max<Index>(matrix_->chunks() * columns * stride, 1));
  sums_.reserve(device_->context(), sums * (in_double() ? sizeof(double) : sizeof(float)))
      .bind(TallOnDevice::partial_binding);
  matrix_->multiply_transposed(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

  if (values_) values_->bind(values_of_rank_binding);
  if (sum_chunks_ == nullptr)
    sum_chunks_ = &device_->program(
        {"sum_chunks.comp", {{"SCALED", values_ ? 1 : 0}, {"DOUBLE", in_double() ? 1 : 0}}});
  const GlProgram& program = *sum_chunks_;
  program.use();
  program.set("chunks", matrix_->chunks());
  program.set("rank", rank);
  program.set("columns", columns);
  program.set("stride", stride);
  program.dispatch(columns * stride / numbers_of_sum_group);
}

}  // namespace radiosity
