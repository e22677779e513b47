#pragma once

#include "gpu/csr_on_device.hpp"
#include "gpu/device_matrix.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace radiosity {

/// What is kept apart of compressed matrices, to be added to their texels: one sparse matrix a channel, as
/// parts of `scale`, a power of two.
struct KeptApart {
  double scale = 1;
  std::vector<CsrMatrix<float>> channels;
};

/// Compressed matrices on the device, one a channel: texels, which kinds of this decode in shaders of their
/// own, and what is kept apart.
class TexelsOnDevice : public DeviceMatrix {
 public:
  ByteCount bytes() const final;
  double scale() const final { return scale_; }
  Index channels() const final { return static_cast<Index>(kept_apart_.size()); }

 protected:
  TexelsOnDevice(const std::shared_ptr<GlDevice>& device, Index rows, Index columns,
                 const KeptApart& kept_apart, RowStrategy strategy);

  RowStrategy strategy() const { return strategy_; }

  void dispatch(Index columns) const final;
  /// How many of so many columns belong to a channel.
  Index columns_of(Index channel, Index columns) const {
    return (columns - channel + channels() - 1) / channels();
  }

  /// Y, in the columns of channels that have texels, is what those, as parts of scale(), make of X.
  virtual void dispatch_texels(Index columns) const = 0;
  virtual bool has_texels(Index) const { return true; }
  virtual std::size_t texel_bytes() const = 0;
  /// Besides those of what is kept apart.
  virtual std::size_t index_bytes() const { return 0; }

 private:
  double scale_;
  RowStrategy strategy_;
  std::vector<std::unique_ptr<CsrOnDevice<float>>> kept_apart_;
};

}  // namespace radiosity
