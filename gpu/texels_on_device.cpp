#include "gpu/texels_on_device.hpp"

#include <epoxy/gl.h>

namespace radiosity {

TexelsOnDevice::TexelsOnDevice(const std::shared_ptr<GlDevice>& device, Index rows, Index columns,
                               const KeptApart& kept_apart, RowStrategy strategy)
    : DeviceMatrix(device, rows, columns), scale_(kept_apart.scale), strategy_(strategy) {
  for (const CsrMatrix<float>& matrix : kept_apart.channels)
    kept_apart_.push_back(std::make_unique<CsrOnDevice<float>>(device, matrix, strategy));
}

ByteCount TexelsOnDevice::bytes() const {
  ByteCount bytes{{{"texels", texel_bytes()}, {"exact", 0}, {"indices", index_bytes()}}};
  for (const auto& matrix : kept_apart_) {
    const ByteCount own = matrix->bytes();
    for (std::size_t part = 0; part < own.parts.size(); ++part)
      bytes.parts[part + 1].second += own.parts[part].second;
  }
  return bytes;
}

void TexelsOnDevice::dispatch(Index columns) const {
  dispatch_texels(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  for (Index channel = 0; channel < channels(); ++channel) {
    const CsrOnDevice<float>& matrix = *kept_apart_[static_cast<std::size_t>(channel)];
    if (has_texels(channel))
      matrix.dispatch_sum(channel, channels(), columns);
    else
      matrix.dispatch_product(channel, channels(), columns);
  }
}

}  // namespace radiosity
