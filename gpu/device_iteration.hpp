#pragma once

#include "gpu/device_field.hpp"
#include "gpu/device_transport.hpp"

#include <memory>
#include <optional>

namespace radiosity {

/// Solves (I - T) D = R on a device, step by step and all columns together, in float32. R goes there once and
/// D comes back when it is asked for; in between only the norms of residuals do, once for several steps.
class DeviceIteration {
 public:
  virtual ~DeviceIteration() = default;

  /// Sends R, n x c: D = 0. Throws Error where fields of that size do not fit into the device.
  void start(const ConstFieldRef& right_hand_side);
  /// So many steps, each a product; the area norm of each column's residual then, as the device has it.
  Eigen::RowVectorXd advance(int steps);
  /// D so far, n x c.
  Field solution() const;

  /// Products that start() takes.
  virtual int starting_products() const = 0;

 protected:
  /// `strategy`: whether sums meet in shared memory; empty for the device's own.
  DeviceIteration(DeviceTransport transport, const Eigen::VectorXd& root_area,
                  std::optional<RowStrategy> strategy);
  DeviceIteration(const DeviceIteration&) = delete;
  DeviceIteration& operator=(const DeviceIteration&) = delete;

  /// W, n x channels: residuals as the device has them, times it, have the area norm in units of root_area().
  virtual Eigen::ArrayXXd weight() const = 0;
  /// Makes room for fields of so many columns.
  virtual void reserve(Index columns) = 0;
  /// Begins with R, its columns scaled to be near 1.
  virtual void begin(const Field& R) = 0;
  virtual void step() = 0;
  /// D for that R.
  virtual Field result(const Field& R) const = 0;

  /// A^{1/2} in a unit, a power of two, that brings the largest near 1.
  const Eigen::VectorXd& root_area() const { return root_area_; }
  Index channels() const { return transport_.left.cols(); }
  GlDevice& device() const { return transport_.matrix->device(); }
  DeviceField new_field(Index columns) const;
  /// A shader that includes fields.glsl and makes so many sums.
  const GlProgram& fields_program(const char* file, int sums) const;
  /// By the rows of the matrix from by patch, and back.
  Field sorted(const Field& field) const;
  Field by_patch(const Field& sorted) const;

  /// y <- M x, without M's scale.
  void multiply(const DeviceField& x, const DeviceField& y) const;
  /// The shader that includes fields.glsl, for every number of fields; what else it reads is bound.
  void run_on_fields(const GlProgram& program) const;
  /// column_scalars.comp.
  void reduce(const GlProgram& program, bool starting) const;
  void bind_scalars(unsigned binding) const { scalars_->bind(binding); }

 private:
  void reserve_all(Index columns);
  void send_diagonals();
  Eigen::RowVectorXd residual_norms() const;
  /// Sums of a column of a field: one a work group, or one a number.
  Index sums_of_column() const;

  DeviceTransport transport_;
  bool shared_sums_;
  double root_area_unit_;
  Eigen::VectorXd root_area_;
  Index columns_ = 0;
  Eigen::RowVectorXd column_scale_;
  Field right_hand_side_;  ///< columns near 1
  std::optional<DeviceField> diagonals_;
  std::optional<GlBuffer> sums_;     ///< of all work groups
  std::optional<GlBuffer> scalars_;  ///< four a column (column_scalars.comp)
};

}  // namespace radiosity
