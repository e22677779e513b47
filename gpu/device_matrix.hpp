#pragma once

#include "gpu/gl_device.hpp"
#include "operators/linear_operator.hpp"

#include <atomic>
#include <functional>
#include <memory>

namespace radiosity {

/// A rows x cols matrix in the memory of a device, in float32 arithmetic or, where the matrix is of double
/// precision, in that. Products may be asked for on any thread; they wait for each other.
class DeviceMatrix {
 public:
  virtual ~DeviceMatrix() = default;

  Index rows() const { return rows_; }
  Index cols() const { return cols_; }

  /// Y = M X for c > 0 columns, as products of SymmetricTiles<float> have it (kernels/products.hpp) but for
  /// the order of sums and the scaling of X, which is one a column. Y is written, never read.
  virtual void multiply(const ConstFieldRef& X, FieldRef Y) const;

  /// What it takes of the device's memory, by part.
  virtual ByteCount bytes() const = 0;

  /// Of how many matrices it is made: column j of a field is multiplied with matrix j mod channels().
  virtual Index channels() const { return 1; }

  /// Whether products take and give fields in double precision: not those that are on the device already.
  virtual bool in_double() const { return false; }

  /// M is this times the stored numbers.
  virtual double scale() const = 0;
  /// Y = M X / scale() for fields that are on the device, laid out as FieldBuffers has them, and other
  /// shaders may read Y. The context is current.
  void multiply_on_device(const GlBuffer& X, const GlBuffer& Y, Index columns) const;
  /// The same for X and Y that are bound already; a memory barrier comes before Y is read.
  void multiply_bound(Index columns) const { dispatch(columns); }

  /// Time of the device in products so far: without sending and receiving fields.
  double device_seconds() const { return device_seconds_; }
  /// For what else is computed with it there, step by step.
  void count_device_seconds(double seconds) const { device_seconds_ = device_seconds_ + seconds; }

  GlDevice& device() const { return *device_; }

 protected:
  DeviceMatrix(std::shared_ptr<GlDevice> device, Index rows, Index cols)
      : device_(std::move(device)), rows_(rows), cols_(cols) {}
  DeviceMatrix(const DeviceMatrix&) = delete;
  DeviceMatrix& operator=(const DeviceMatrix&) = delete;

  /// For parts that are matrices themselves.
  const std::shared_ptr<GlDevice>& shared_device() const { return device_; }

  /// Y = scale times what `dispatch_columns` makes of X, both bound as FieldBuffers says; timed.
  void run(const ConstFieldRef& X, FieldRef Y, double scale,
           const std::function<void(Index columns)>& dispatch_columns) const;

  /// Has the device compute Y of `columns` columns from X, both bound as FieldBuffers says.
  virtual void dispatch(Index columns) const = 0;

 private:
  template <typename Number>
  void run_in(const ConstFieldRef& X, FieldRef Y, double scale,
              const std::function<void(Index columns)>& dispatch_columns) const;

  std::shared_ptr<GlDevice> device_;
  Index rows_;
  Index cols_;
  mutable std::atomic<double> device_seconds_{0};
};

}  // namespace radiosity
