#pragma once

#include "gpu/device_iteration.hpp"
#include "operators/kernel_operator.hpp"

#include <optional>

namespace radiosity {

/// Conjugate gradients on a device, in the form of ConjugateGradients (solvers/conjugate_gradients.hpp): (I -
/// S) w = R^{1/2} K e with e = A^{1/2} times the right-hand side, which is then A^{-1/2} (e + R^{1/2} w).
/// Step lengths are computed there too.
class ConjugateGradientsOnDevice final : public DeviceIteration {
 public:
  /// `on_device` has K and the order of its rows, `original` its diagonals.
  ConjugateGradientsOnDevice(const DeviceTransport& on_device, const KernelOperator& original,
                             std::optional<RowStrategy> strategy = {});

  int starting_products() const override { return 1; }

 private:
  struct Fields {
    DeviceField x, y, direction, image, solution, residual;
  };
  Eigen::ArrayXXd weight() const override { return root_reflectance_; }
  void reserve(Index columns) override;
  void begin(const Field& R) override;
  void step() override { iterate(false); }
  Field result(const Field& R) const override;
  /// A step; `starting`: x is e, and the residual becomes the image of it, R^{1/2} K e.
  void iterate(bool starting) const;

  Eigen::ArrayXXd root_reflectance_;
  const GlProgram* image_;  ///< the device's, as all of them
  const GlProgram* step_length_;
  const GlProgram* update_;
  const GlProgram* conjugation_;
  const GlProgram* direction_;
  std::optional<Fields> fields_;
};

}  // namespace radiosity
