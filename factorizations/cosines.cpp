#include "factorizations/cosines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How many numbers differ by more than rounding.
Index count_different(VectorXd numbers) {
  constexpr double rounding = 1e-6;
  std::sort(numbers.begin(), numbers.end());
  Index count = 1;
  for (Index i = 1; i < numbers.size(); ++i)
    if (numbers[i] - numbers[i - 1] > rounding) ++count;
  return count;
}

using Frequency = std::array<Index, 2>;

/// As many pairs of frequencies as there are items: all of the grid that the items form, or else the lowest.
std::vector<Frequency> frequencies_of(const PlacedSet& set) {
  const Index items = set.places.cols();
  Index across = count_different(set.places.row(0)), up = count_different(set.places.row(1));
  if (across * up != items) {
    const double root = std::sqrt(static_cast<double>(items) * set.aspect);
    across = std::isfinite(root) ? std::clamp<Index>(std::lround(root), 1, items) : items;
    up = (items + across - 1) / across;
  }
  std::vector<Frequency> all;
  all.reserve(static_cast<std::size_t>(across * up));
  for (Index q = 0; q < up; ++q)
    for (Index p = 0; p < across; ++p) all.push_back({p, q});
  const auto square = [&](const Frequency& f) {
    return std::pow(static_cast<double>(f[0]) / set.aspect, 2) + std::pow(static_cast<double>(f[1]), 2);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Frequency& a, const Frequency& b) { return square(a) < square(b); });
  all.resize(static_cast<std::size_t>(items));
  return all;
}

class CosineSets {
 public:
  CosineSets(std::vector<PlacedSet> sets, const VectorXd& root_weight)
      : root_weight_(root_weight), sets_(std::move(sets)) {
    starts_.push_back(0);
    for (const PlacedSet& set : sets_) {
      frequencies_.push_back(frequencies_of(set));
      starts_.push_back(starts_.back() + static_cast<Index>(set.items.size()));
    }
  }

  Index count() const { return starts_.back(); }

  MatrixXd coefficients(const MatrixXd& X) const {
    MatrixXd result(count(), X.cols());
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const MatrixXd own = X(sets_[s].items, Eigen::all);
      for (Index k = starts_[s]; k < starts_[s + 1]; ++k)
        result.row(k) = values(s, k - starts_[s]).transpose() * own;
    }
    return result;
  }

  MatrixXd columns(const std::vector<Index>& which) const {
    MatrixXd result = MatrixXd::Zero(root_weight_.size(), static_cast<Index>(which.size()));
    for (Index j = 0; j < result.cols(); ++j) {
      const Index k = which[static_cast<std::size_t>(j)];
      const auto s =
          static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), k) - starts_.begin() - 1);
      result(sets_[s].items, j) = values(s, k - starts_[s]);
    }
    return result;
  }

 private:
  /// Function k of a set on its items; 0 where all its zeros fall on them.
  VectorXd values(std::size_t set, Index k) const {
    constexpr double nothing = 1e-10;
    const PlacedSet& own = sets_[set];
    const Frequency& f = frequencies_[set][static_cast<std::size_t>(k)];
    const VectorXd weight = root_weight_(own.items);
    const auto along = [&](int axis) -> Eigen::ArrayXd {
      return (std::numbers::pi * static_cast<double>(f[static_cast<std::size_t>(axis)]) *
              own.places.row(axis).transpose().array())
          .cos();
    };
    const VectorXd values = (weight.array() * along(0) * along(1)).matrix();
    const double length = values.norm();
    return length > nothing * weight.norm() ? VectorXd(values / length) : VectorXd::Zero(values.size());
  }

  VectorXd root_weight_;
  std::vector<PlacedSet> sets_;
  std::vector<std::vector<Frequency>> frequencies_;
  std::vector<Index> starts_;  ///< of the functions of each set, and their number
};

}  // namespace

FunctionFamily cosines(std::vector<PlacedSet> sets, const VectorXd& root_weight) {
  const auto all = std::make_shared<const CosineSets>(std::move(sets), root_weight);
  return {root_weight.size(), all->count(), [all](const MatrixXd& X) { return all->coefficients(X); },
          [all](const std::vector<Index>& which) { return all->columns(which); }};
}

}  // namespace radiosity
