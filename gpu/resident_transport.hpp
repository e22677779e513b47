#pragma once

#include "gpu/device_field.hpp"
#include "gpu/device_operator.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace radiosity {

/// The transport of light of one frame, which never leaves the device: from the emission E of the patches to
/// the irradiance H = F B, in red, green and blue, in float32. An operator T takes a stated number of
/// products, B = E + T E + ... (Neumann's series from the start in every frame, so that a frame does not
/// depend on those before it); one that answers by itself takes a single one. An operator of one channel
/// serves all three.
class ResidentTransport {
 public:
  static constexpr Index colours = 3;

  /// `transport` is on the device and outlives this. Throws UsageError for operators that are not, or in part
  /// only (closures are computed on the CPU), and for less than one product; Error where fields of n patches
  /// do not fit into a storage block.
  ResidentTransport(std::shared_ptr<GlDevice> device, const LinearOperator& transport, int products);

  Index patches() const { return n_; }
  /// n x 3, W/m^2; written before run().
  DeviceField& emission() { return *emission_; }
  const DeviceField& emission() const { return *emission_; }
  /// n x 3, W/m^2: what run() writes.
  const DeviceField& irradiance() const { return *irradiance_; }
  /// Products that run() takes.
  int products() const { return products_; }

  /// Nothing is allocated after the first time, and nothing waited for. The context is current; the emission
  /// was written before a memory barrier, and another comes before the irradiance is read.
  void run() const;

 private:
  struct Part {
    const DeviceMatrix* matrix;
    Index first_slot;  ///< of the columns of X and Y that are its
    Index slots;
  };
  void step(const GlProgram& program) const;
  void multiply() const;
  void upload_diagonals(const ResidentProduct& product);
  void upload_places(const std::vector<Index>& order);

  std::shared_ptr<GlDevice> device_;
  Index n_ = 0;
  int products_ = 1;
  std::vector<Part> parts_;
  Index slots_ = 0;                   ///< the column of X and Y of each colour, 2 bits each
  const GlProgram* first_ = nullptr;  ///< the device's
  const GlProgram* later_ = nullptr;
  std::optional<DeviceField> emission_, irradiance_, x_, y_;
  std::optional<DeviceField> diagonals_;  ///< n x 9: before, after and reflectance of three colours
  std::unique_ptr<GlBuffer> places_;
};

}  // namespace radiosity
