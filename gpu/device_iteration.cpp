#include "gpu/device_iteration.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

constexpr unsigned diagonals_binding = 0;
constexpr unsigned reduced_scalars_binding = 1;
constexpr unsigned group_sums_binding = 7;
constexpr Index numbers_of_group = FieldBuffers::padding;
constexpr std::size_t most_sums = 2;  ///< that a shader makes for each number
constexpr std::size_t scalars_of_column = 4;

double power_of_two_near(const Eigen::Ref<const Eigen::VectorXd>& numbers) {
  return storage_scale<float>(numbers.size() == 0 ? 0 : numbers.cwiseAbs().maxCoeff());
}

}  // namespace

DeviceIteration::DeviceIteration(DeviceTransport transport, const Eigen::VectorXd& root_area,
                                 std::optional<RowStrategy> strategy)
    : transport_(std::move(transport)),
      shared_sums_(strategy.value_or(device().preferred_strategy()) == RowStrategy::group),
      root_area_unit_(power_of_two_near(root_area)),
      root_area_(root_area / root_area_unit_) {}

void DeviceIteration::start(const ConstFieldRef& right_hand_side) {
  const CurrentContext current(*device().context());
  column_scale_.resize(right_hand_side.cols());
  for (Index j = 0; j < right_hand_side.cols(); ++j)
    column_scale_[j] = power_of_two_near(right_hand_side.col(j));
  right_hand_side_ = right_hand_side * column_scale_.cwiseInverse().asDiagonal();
  reserve_all(right_hand_side.cols());
  begin(right_hand_side_);
  device().context()->check("beginning to solve");
}

void DeviceIteration::reserve_all(Index columns) {
  if (columns == columns_) return;
  columns_ = columns;
  const auto& context = device().context();
  if (!diagonals_) send_diagonals();
  const auto sums = static_cast<std::size_t>(columns * sums_of_column());
  sums_.reset();
  sums_.emplace(context, std::max<std::size_t>(sums, 1) * most_sums * sizeof(float));
  scalars_.reset();
  scalars_.emplace(context, static_cast<std::size_t>(columns) * scalars_of_column * sizeof(float));
  scalars_->clear();
  reserve(columns);
}

/// Scales are powers of two: what is divided here is multiplied there, and nothing is lost.
void DeviceIteration::send_diagonals() {
  const double right_unit = power_of_two_near(transport_.right.reshaped());
  Field all(transport_.left.rows(), 3 * channels());
  all << transport_.left * (transport_.matrix->scale() * right_unit), transport_.right / right_unit, weight();
  diagonals_.emplace(device().context(), all.rows(), all.cols());
  diagonals_->write(sorted(all));
}

Eigen::RowVectorXd DeviceIteration::advance(int steps) {
  const CurrentContext current(*device().context());
  {
    const GlTimer::Measurement measurement(device().timer());
    for (int taken = 0; taken < steps; ++taken) step();
  }
  Eigen::RowVectorXd norms = residual_norms();
  transport_.matrix->count_device_seconds(device().timer().seconds());
  device().context()->check("steps of a solver");
  return norms;
}

Eigen::RowVectorXd DeviceIteration::residual_norms() const {
  std::vector<float> numbers(static_cast<std::size_t>(columns_) * scalars_of_column);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  scalars_->read(numbers.size() * sizeof(float), numbers.data());
  Eigen::RowVectorXd norms(columns_);
  for (Index j = 0; j < columns_; ++j)
    norms[j] = root_area_unit_ * column_scale_[j] *
               std::sqrt(static_cast<double>(
                   numbers[static_cast<std::size_t>(j) * scalars_of_column + (scalars_of_column - 1)]));
  return norms;
}

Field DeviceIteration::solution() const {
  const CurrentContext current(*device().context());
  return result(right_hand_side_) * column_scale_.asDiagonal();
}

DeviceField DeviceIteration::new_field(Index columns) const {
  return {device().context(), transport_.left.rows(), columns};
}

const GlProgram& DeviceIteration::fields_program(const char* file, int sums) const {
  return device().program({file, {{"SUMS", sums}, {"SHARED", shared_sums_ ? 1 : 0}}});
}

Index DeviceIteration::sums_of_column() const {
  return shared_sums_ ? diagonals_->stride() / numbers_of_group : diagonals_->stride();
}

Field DeviceIteration::sorted(const Field& field) const {
  return transport_.order.empty() ? field : Field(field(transport_.order, Eigen::all));
}

Field DeviceIteration::by_patch(const Field& sorted) const {
  if (transport_.order.empty()) return sorted;
  Field field(sorted.rows(), sorted.cols());
  field(transport_.order, Eigen::all) = sorted;
  return field;
}

void DeviceIteration::multiply(const DeviceField& x, const DeviceField& y) const {
  transport_.matrix->multiply_on_device(x.buffer(), y.buffer(), columns_);
}

void DeviceIteration::run_on_fields(const GlProgram& program) const {
  diagonals_->buffer().bind(diagonals_binding);
  sums_->bind(group_sums_binding);
  program.use();
  program.set("stride", diagonals_->stride());
  program.set("columns", columns_);
  program.set("channels", channels());
  program.dispatch(columns_ * diagonals_->stride() / numbers_of_group);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void DeviceIteration::reduce(const GlProgram& program, bool starting) const {
  scalars_->bind(reduced_scalars_binding);
  sums_->bind(group_sums_binding);
  program.use();
  program.set("groups_of_column", sums_of_column());
  program.set("columns", columns_);
  program.set("starting", starting ? 1 : 0);
  program.dispatch(columns_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace radiosity
