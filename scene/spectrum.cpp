#include "scene/spectrum.hpp"

#include <Eigen/LU>

#include <cmath>

namespace radiosity {
namespace {

/// A Gaussian lobe with a width of its own on either side.
double lobe(double wavelength, double peak, double inverse_width_below, double inverse_width_above) {
  const double t = (wavelength - peak) * (wavelength < peak ? inverse_width_below : inverse_width_above);
  return std::exp(-0.5 * t * t);
}

/// Wyman, Sloan, Shirley 2013, listing 1.
Eigen::Array3d matching_functions(double nm) {
  return {0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
              0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
          0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
          1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

/// Linear sRGB to XYZ, IEC 61966-2-1; its row sums are the white point D65.
Eigen::Matrix3d xyz_of_srgb() {
  Eigen::Matrix3d matrix;
  matrix << 0.4124, 0.3576, 0.1805,  //
      0.2126, 0.7152, 0.0722,        //
      0.0193, 0.1192, 0.9505;
  return matrix;
}

}  // namespace

Color linear_srgb(const MeasuredSpectrum& spectrum) {
  Eigen::Array3d sum = Eigen::Array3d::Zero(), flat = Eigen::Array3d::Zero();
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double end_weight = i == 0 || i + 1 == spectrum.size() ? 0.5 : 1.0;
    const Eigen::Array3d weight = end_weight * matching_functions(400 + 4 * static_cast<double>(i));
    sum += weight * spectrum[i];
    flat += weight;
  }
  const Eigen::Matrix3d matrix = xyz_of_srgb();
  const Eigen::Vector3d xyz = (sum / flat) * matrix.rowwise().sum().array();
  return (matrix.inverse() * xyz).array();
}

Color luminance_weights() {
  return xyz_of_srgb().row(1).transpose().array();
}

}  // namespace radiosity
