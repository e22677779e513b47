#pragma once

#include "kernels/products.hpp"

#include <Eigen/Core>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {

/// n x c numbers: n patches, one column a channel or light.
using Field = Eigen::MatrixXd;

/// What must be resident to apply an operator, by part ("entries", "indices", "scales", ...).
struct ByteCount {
  std::vector<std::pair<std::string, std::size_t>> parts;
  std::size_t total() const;
};

/// What is known of an operator A beside its products, and how. A value that is not known is empty.
struct Certificate {
  std::optional<double> spectral_radius_bound;  ///< rho(A) <= this
  std::optional<double> operator_error;         ///< ||A - T|| in the area norm, relative to ||T||
  std::string method;                           ///< "proved", "sampled, 99 %", "not known"
};

/// Where an operator computes that is not on the CPU, and how it fares there.
struct DeviceUse {
  std::string name;           ///< as --device has it: "gl"
  std::string renderer;       ///< as the driver names it
  bool software = false;      ///< the driver computes on the CPU after all
  double difference_max = 0;  ///< of a product from that of the CPU with the same stored numbers: the largest
                              ///< |difference| of a component, relative to the largest component
  double upload_seconds = 0;  ///< copying the operator to the device, once
  double device_seconds = 0;  ///< of the device in products and steps of solvers so far, without fields on
                              ///< their way
};

/// A linear map from a field on the patches to a field on the patches: T = R F, an approximation of it, a sum
/// of its powers, or (I - T)^-1, on whatever device. Fields are double whatever the storage is. With several
/// channels, column j of a field belongs to channel j mod channels() (lights one after the other). `apply`
/// checks, counts and times; implementations override `apply_impl`.
class LinearOperator {
 public:
  struct Usage {
    std::uint64_t products = 0;  ///< columns multiplied so far, divided by channels()
    double seconds = 0;          ///< wall time inside apply so far
  };

  virtual ~LinearOperator() = default;

  /// n, the number of patches.
  virtual Index size() const = 0;

  /// Columns that belong together: 3 for RGB, 1 for a grey scene.
  virtual Index channels() const = 0;

  /// Y = alpha A X + beta Y. X and Y are n x c with c a multiple of channels(); beta = 0 never reads Y, alpha
  /// = 0 never reads X. Throws UsageError for wrong shapes and where X and Y share memory.
  void apply(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const;

  /// Y = A X.
  void apply(const ConstFieldRef& X, FieldRef Y) const { apply(1, X, 0, Y); }

  virtual ByteCount bytes() const = 0;

  /// Name and parameters, the text that the registry parses: "dense:f16".
  virtual std::string describe() const = 0;

  /// Whether it is a symmetric kernel between its diagonals; then it is a KernelOperator, and CG applies.
  virtual bool symmetric() const { return false; }

  /// Whether it maps E to B, as an approximation of G = (I - T)^-1 or of a sum of bounces does, and not to T
  /// E: it needs no solver and takes none.
  virtual bool global() const { return false; }

  virtual Certificate certificate() const { return {}; }

  /// Unit roundoff of the arithmetic of its products: what repeats of it differ by if sums are done in
  /// another order, relative to |A| |X|. 2^-24 where entries multiply in float32. No solver gets a residual
  /// below it.
  virtual double product_roundoff() const { return 0x1p-53; }

  /// What who reads its results should know ("no symmetric scaling exists; ..."); empty if there is nothing.
  virtual std::string remark() const { return {}; }

  /// Empty for operators that compute on the CPU.
  virtual std::optional<DeviceUse> device_use() const { return {}; }

  Usage usage() const { return {products_.load(), 1e-9 * static_cast<double>(nanoseconds_.load())}; }

 protected:
  LinearOperator() = default;
  LinearOperator(const LinearOperator&) = delete;
  LinearOperator& operator=(const LinearOperator&) = delete;

  /// The same as apply with shapes checked; c > 0 and alpha != 0.
  virtual void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const = 0;

  /// What apply does around apply_impl, for the transpose: checks and times, and leaves `compute` to give Y
  /// for c > 0 and alpha != 0.
  void apply_checked(double alpha, const ConstFieldRef& X, double beta, FieldRef Y,
                     const std::function<void()>& compute) const;

  /// For products that do not go through apply (kernel products).
  void count_products(Index columns, double seconds) const;

 private:
  mutable std::atomic<std::uint64_t> products_{0};
  mutable std::atomic<std::uint64_t> nanoseconds_{0};
};

/// The side interface of operators that also know A': Y = alpha A' X + beta Y with apply's rules.
class TransposedApply {
 public:
  virtual ~TransposedApply() = default;
  virtual void apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const = 0;
};

}  // namespace radiosity
