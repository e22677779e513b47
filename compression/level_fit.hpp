#pragma once

#include <Eigen/Core>

#include <array>

namespace radiosity {

/// One number of each of 4 x 4 texels, by rows.
using Texels = Eigen::Array<float, 16, 1>;

/// The whole number nearest to one that is not negative, halves up; std::lround would take longer than all of
/// the rest.
inline int nearest_whole(float number) {
  const float half_up = number + 0.5F;
  return static_cast<int>(half_up);
}

/// Sixteen numbers as points between two ends, with the same shares for every channel:
///
///   x_t ~ (1 - share_t) first + share_t second.
///
/// Solves the normal equations of the weighted squared error, whose matrix the shares and weights make alone.
class LevelFit {
 public:
  /// weighted_share: weight_t share_t, with weights >= 0 of a positive sum and shares in [0, 1].
  LevelFit(float total_weight, const Texels& weighted_share, const Texels& share);

  /// Two whole numbers in [0, largest] which, times `step`, are nearly the best ends that such numbers can
  /// be: the first is next to the real solution, the second the best for the first. Where the shares leave
  /// them open (all are equal, for example) the first is next to the mean of the codes.
  /// total_code: sum of weight_t code_t.
  std::array<int, 2> ends(const Texels& code, float total_code, float step, int largest) const;

 private:
  Texels weighted_share_;
  float total_weight_;
  float first_first_, first_second_, second_second_;
  float inverse_determinant_ = 0;  ///< 0: singular
  float inverse_second_ = 0;       ///< 0: nothing depends on the second end
};

}  // namespace radiosity
