#include "gpu/sparse_v_on_device.hpp"

#include "gpu/segments_on_device.hpp"

namespace radiosity {

template <typename Scalar>
SparseVOnDevice::SparseVOnDevice(const std::shared_ptr<GlDevice>& device_of_factors,
                                 const TallMatrix<Scalar>& U, const Segments& V, RowStrategy strategy)
    : SparseVOnDevice(device_of_factors, U, V, order_on_device(device_of_factors, V), strategy) {}

template <typename Scalar>
SparseVOnDevice::SparseVOnDevice(const std::shared_ptr<GlDevice>& device_of_factors,
                                 const TallMatrix<Scalar>& U, const Segments& V,
                                 const std::shared_ptr<const GlBuffer>& order, RowStrategy strategy)
    : FactorsOnDevice(device_of_factors, "U",
                      std::make_shared<TallOnDevice>(device_of_factors, U, strategy, order),
                      std::make_shared<SegmentsOnDevice>(device_of_factors, V, order, strategy,
                                                         sizeof(Scalar) == sizeof(double))) {}

template SparseVOnDevice::SparseVOnDevice(const std::shared_ptr<GlDevice>&, const TallMatrix<double>&,
                                          const Segments&, RowStrategy);
template SparseVOnDevice::SparseVOnDevice(const std::shared_ptr<GlDevice>&, const TallMatrix<float>&,
                                          const Segments&, RowStrategy);

}  // namespace radiosity
