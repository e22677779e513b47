#pragma once

#include "kernels/colour_texture.hpp"
#include "operators/linear_operator.hpp"

#include <array>
#include <vector>

namespace radiosity {

/// What the codes of a block may become in a texture unit, as parts of 255: off by
///
///   2/255 + 0.03 |first - second|
///
/// at most. The extension (EXT_texture_compression_s3tc) gives formulas and no tolerance. Units widen the two
/// codes to 8 bits (0.7/255) and may cut what lies between them (1/255), which is 2/255, and some weigh the
/// two with other numbers than thirds, which Direct3D allows the same units up to 0.03 of their distance
/// (Direct3D 11.3 functional specification, 19.5.2, which has 1/255 for the rest and asks that what is
/// exactly 0 stays 0).
constexpr double sampled_code_difference(double first, double second) {
  const double distance = first > second ? first - second : second - first;
  return 2.0 / 255 + 0.03 * distance;
}

/// Bounds of what that does to the texels of a texture, entry by entry: |sampled - texel| without scales.
class SampledTexelBounds {
 public:
  explicit SampledTexelBounds(const ColourTexture& texture);

  double operator()(Index row, Index column, int channel) const;

 private:
  static constexpr std::size_t codes = 64;
  double bound(double first, double second, int index) const;

  const ColourTexture& texture_;
  std::array<std::vector<double>, 3> of_colour_;  ///< (64 first + second) * 4 + index
};

/// Sums of D = R |M_sampled - M| C^-1 >= 0, for matrices M whose rows and columns have an order of their own
/// (order[p] at place p), n x channels in the order of the patches.
struct SamplingDifference {
  Eigen::MatrixXd rows;     ///< sum_j D_ij
  Eigen::MatrixXd columns;  ///< sum_i A_i D_ij / A_j
};
SamplingDifference sampling_difference(const ColourTexture& texture, const std::vector<Index>& order,
                                       const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& area);

/// The certificate of an operator A, `original`, with that added to it. Schur's test bounds the difference
/// d = ||D|| in the area norm (operators/colour_certificate.hpp), and ||T|| >= ||A|| / (1 + e), where e is
/// the error of A relative to ||T||: e + d (1 + e) / ||A||, ||A|| from below by its value for a uniform
/// field.
Certificate sampled_certificate(const LinearOperator& original, const SamplingDifference& difference,
                                const Eigen::VectorXd& area);

}  // namespace radiosity
