#include "gpu/low_rank_on_device.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

constexpr unsigned values_of_rank_binding = 5;
constexpr Index numbers_of_sum_group = 64;

std::size_t bytes_of_floats(Index numbers) {
  return static_cast<std::size_t>(std::max<Index>(numbers, 1)) * sizeof(float);
}

}  // namespace

LowRankOnDevice::LowRankOnDevice(std::shared_ptr<GlDevice> device_of_factors, const TallMatrix<float>& U,
                                 const TallMatrix<float>& V, RowStrategy strategy)
    : FactorsOnDevice(device_of_factors, U.rows(), U.columns()), left_(device_of_factors, U, strategy) {
  right_.emplace(device_of_factors, V, strategy);
}

LowRankOnDevice::LowRankOnDevice(std::shared_ptr<GlDevice> device_of_factors, const TallMatrix<float>& Q,
                                 const Eigen::VectorXd& values, RowStrategy strategy)
    : FactorsOnDevice(device_of_factors, Q.rows(), Q.columns()), left_(device_of_factors, Q, strategy) {
  const CurrentContext current(*device().context());
  values_scale_ = storage_scale<float>(values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff());
  const Eigen::VectorXf scaled = (values / values_scale_).cast<float>();
  values_.emplace(device().context(), bytes_of_floats(scaled.size()));
  if (scaled.size() > 0) values_->write(0, bytes_of_floats(scaled.size()), scaled.data());
}

ByteCount LowRankOnDevice::bytes() const {
  if (!right_) return {{{"Q", left_.bytes()}, {"values", values_->bytes()}}};
  return {{{"U", left_.bytes()}, {"V", right_->bytes()}}};
}

void LowRankOnDevice::dispatch_right(Index columns) const {
  const Index stride = FieldBuffers::padded(rank());
  sums_.reserve(device().context(), bytes_of_floats(right().chunks() * columns * stride))
      .bind(TallOnDevice::partial_binding);
  right().multiply_transposed(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);

  if (values_) values_->bind(values_of_rank_binding);
  if (sum_chunks_ == nullptr)
    sum_chunks_ = &device().program({"sum_chunks.comp", {{"SCALED", values_ ? 1 : 0}}});
  const GlProgram& program = *sum_chunks_;
  program.use();
  program.set("chunks", right().chunks());
  program.set("rank", rank());
  program.set("columns", columns);
  program.set("stride", stride);
  program.dispatch(columns * stride / numbers_of_sum_group);
}

}  // namespace radiosity
