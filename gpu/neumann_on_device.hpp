#pragma once

#include "gpu/device_iteration.hpp"

#include <optional>

namespace radiosity {

/// The Neumann series on a device: D <- R + T D, one bounce a step, and the norm of the last change of D,
/// which is the residual of the D before it.
class NeumannOnDevice final : public DeviceIteration {
 public:
  NeumannOnDevice(const DeviceTransport& transport, const Eigen::VectorXd& root_area,
                  std::optional<RowStrategy> strategy = {});

  int starting_products() const override { return 0; }

 private:
  struct Fields {
    DeviceField x, y, emission, radiosity;
  };
  Eigen::ArrayXXd weight() const override;
  void reserve(Index columns) override;
  void begin(const Field& R) override;
  void step() override;
  Field result(const Field& R) const override;
  void bounce() const;

  const GlProgram* step_;  ///< the device's, as all of them
  const GlProgram* norms_;
  std::optional<Fields> fields_;
};

}  // namespace radiosity
