#pragma once

#include "gpu/device_matrix.hpp"
#include "gpu/device_transport.hpp"
#include "gpu/resident_product.hpp"
#include "operators/distinct_reflectances.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/matrix_operator.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {

/// What an operator on the device keeps of the one on the CPU that it was copied from.
struct DeviceOrigin {
  std::string spec;  ///< what describe() gives
  std::string remark;
  Certificate certificate;
  DeviceUse use;
  /// What a component of a product with a field in [0, 1] may differ by from the CPU's because the device
  /// decodes otherwise, besides rounding: n x channels; empty: 0.
  Eigen::MatrixXd decoding_difference;
};

/// What operators that compute with copies of matrices on the device have.
class OnDevice {
 public:
  virtual ~OnDevice() = default;
  /// Found when it is compared with the CPU's (DeviceUse::difference_max).
  void set_difference(double difference_max) { origin_.use.difference_max = difference_max; }
  /// Fields have to come to the CPU then.
  bool in_double() const { return matrix().in_double(); }
  const Eigen::MatrixXd& decoding_difference() const { return origin_.decoding_difference; }
  /// Its parts, for whoever multiplies fields that are on the device already; they live as long as it does.
  /// Nothing where fields have to come to the CPU.
  virtual std::optional<ResidentProduct> resident_product() const = 0;

 protected:
  using Matrices = std::vector<std::unique_ptr<DeviceMatrix>>;

  static Matrices only(std::unique_ptr<DeviceMatrix> matrix);

  OnDevice(Matrices matrices, DeviceOrigin origin)
      : matrices_(std::move(matrices)), origin_(std::move(origin)) {}

  const DeviceMatrix& matrix(Index index = 0) const { return *matrices_[static_cast<std::size_t>(index)]; }
  const DeviceOrigin& origin() const { return origin_; }
  DeviceUse use() const;
  /// Every matrix with the channels of its reflectance, where there is one for each.
  std::vector<ResidentProduct::Part> parts_of(const DistinctReflectances& reflectances, Index channels) const;
  ByteCount bytes_with_diagonals(Index n, Index channels) const;

 private:
  Matrices matrices_;
  DeviceOrigin origin_;
};

/// Those parts of an operator that is on a device, or of the kernel there that it stands for (closure=none),
/// with the reflectances of now; nothing for others.
std::optional<ResidentProduct> resident_product(const LinearOperator& transport);

/// The same for solvers that stay on the device; nothing for operators that are not T or take more than one
/// matrix.
std::optional<DeviceTransport> transport_on_device(const LinearOperator& transport);

/// What is the same in all of them, on top of Base, a kind of LinearOperator: they tell of themselves what
/// their origin does, but for what they take of the device's memory.
template <typename Base>
class DeviceOperator : public Base, public OnDevice {
 public:
  ByteCount bytes() const final { return bytes_with_diagonals(this->size(), this->channels()); }
  std::string describe() const final { return origin().spec; }
  std::string remark() const final { return origin().remark; }
  double product_roundoff() const final { return matrix().in_double() ? 0x1p-53 : 0x1p-24; }
  Certificate certificate() const final { return origin().certificate; }
  std::optional<DeviceUse> device_use() const final { return use(); }

 protected:
  /// The rest makes Base.
  template <typename... Arguments>
  DeviceOperator(Matrices matrices, DeviceOrigin origin, Arguments&&... arguments)
      : Base(std::forward<Arguments>(arguments)...), OnDevice(std::move(matrices), std::move(origin)) {}
};

/// R A^{-1/2} K A^{1/2} with K on the device, its diagonals on the CPU in double precision.
class DeviceKernelOperator : public DeviceOperator<KernelOperator> {
 public:
  /// `matrix` is K; areas and reflectances are those of `original`. order[p]: the patch at place p of K;
  /// empty: patches in their own order.
  DeviceKernelOperator(const KernelOperator& original, std::unique_ptr<DeviceMatrix> matrix,
                       DeviceOrigin origin, std::vector<Index> order = {});

  std::optional<ResidentProduct> resident_product() const override;

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  std::vector<Index> order_;
};

/// R F with F on the device.
class DeviceMatrixOperator : public DeviceOperator<LinearOperator> {
 public:
  /// `matrix` is F; reflectances are those of `original`.
  DeviceMatrixOperator(const MatrixOperator& original, std::unique_ptr<DeviceMatrix> matrix,
                       DeviceOrigin origin);

  const Eigen::MatrixXd& reflectance() const { return reflectance_; }
  Index size() const override { return reflectance_.rows(); }
  Index channels() const override { return reflectance_.cols(); }
  std::optional<ResidentProduct> resident_product() const override;

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override;

 private:
  Eigen::MatrixXd reflectance_;
};

}  // namespace radiosity
