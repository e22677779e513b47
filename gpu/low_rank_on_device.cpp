#include "gpu/low_rank_on_device.hpp"

#include "gpu/tall_right_factor.hpp"

namespace radiosity {

template <typename Scalar>
LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>& device_of_factors,
                                 const TallMatrix<Scalar>& U, const TallMatrix<Scalar>& V,
                                 RowStrategy strategy)
    : FactorsOnDevice(
          device_of_factors, "U", std::make_shared<TallOnDevice>(device_of_factors, U, strategy),
          std::make_shared<TallRightFactor>(
              device_of_factors, std::make_shared<TallOnDevice>(device_of_factors, V, strategy))) {}

template <typename Scalar>
LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>& device_of_factors,
                                 const TallMatrix<Scalar>& Q, const Eigen::VectorXd& values,
                                 RowStrategy strategy)
    : LowRankOnDevice(device_of_factors, std::make_shared<TallOnDevice>(device_of_factors, Q, strategy),
                      values) {}

LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>& device_of_factors,
                                 const std::shared_ptr<const TallOnDevice>& Q, const Eigen::VectorXd& values)
    : FactorsOnDevice(device_of_factors, "Q", Q,
                      std::make_shared<TallRightFactor>(device_of_factors, Q, values)) {}

template LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>&, const TallMatrix<double>&,
                                          const TallMatrix<double>&, RowStrategy);
template LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>&, const TallMatrix<float>&,
                                          const TallMatrix<float>&, RowStrategy);
template LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>&, const TallMatrix<double>&,
                                          const Eigen::VectorXd&, RowStrategy);
template LowRankOnDevice::LowRankOnDevice(const std::shared_ptr<GlDevice>&, const TallMatrix<float>&,
                                          const Eigen::VectorXd&, RowStrategy);

}  // namespace radiosity
