#include "compression/level_fit.hpp"

#include <algorithm>

namespace radiosity {
namespace {

/// Below this share of the product of its diagonal the determinant of the normal equations is rounding.
constexpr float singular_share = 1e-5F;

/// Into [0, most] without branches, unlike std::clamp; NaN becomes 0.
float bounded(float number, float most) {
  return std::min(std::max(0.0F, number), most);
}

}  // namespace

LevelFit::LevelFit(float total_weight, const Texels& weighted_share, const Texels& share)
    : weighted_share_(weighted_share), total_weight_(total_weight) {
  const float shares = weighted_share.sum();
  second_second_ = (weighted_share * share).sum();
  first_second_ = shares - second_second_;
  first_first_ = total_weight - shares - first_second_;
  const float determinant = first_first_ * second_second_ - first_second_ * first_second_;
  if (determinant > singular_share * first_first_ * second_second_) inverse_determinant_ = 1 / determinant;
  if (second_second_ > 0) inverse_second_ = 1 / second_second_;
}

std::array<int, 2> LevelFit::ends(const Texels& code, float total_code, float step, int largest) const {
  const float in_steps = 1 / step;
  const float second_code = (weighted_share_ * code).sum() * in_steps;
  const float first_code = total_code * in_steps - second_code;
  const float solution =
      inverse_determinant_ > 0
          ? (first_code * second_second_ - second_code * first_second_) * inverse_determinant_
          : total_code * in_steps / total_weight_;

  const auto most = static_cast<float>(largest);
  const auto second_for = [&](float first) {
    const float second = (second_code - first_second_ * first) * inverse_second_;
    return inverse_second_ > 0 ? nearest_whole(bounded(second, most)) : static_cast<int>(first);
  };
  // The squared error but for a constant.
  const auto error = [&](float a, int second) {
    const auto b = static_cast<float>(second);
    return a * (first_first_ * a + 2 * (first_second_ * b - first_code)) +
           b * (second_second_ * b - 2 * second_code);
  };
  const int below = static_cast<int>(bounded(solution, most - 1));
  const auto lower = static_cast<float>(below);
  const int with_lower = second_for(lower), with_upper = second_for(lower + 1);
  const bool upper = error(lower + 1, with_upper) < error(lower, with_lower);
  return {upper ? below + 1 : below, upper ? with_upper : with_lower};
}

}  // namespace radiosity
