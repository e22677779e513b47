#include "factorizations/haar_wavelets.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A step function: `left` on the places [begin, middle) of the sequence, `right` on [middle, end).
struct Wavelet {
  Index begin;
  Index middle;
  Index end;
  double left;
  double right;
};

class HaarSequence {
 public:
  HaarSequence(const std::vector<std::vector<Index>>& sets, const VectorXd& root_weight)
      : root_weight_(root_weight) {
    items_.reserve(static_cast<std::size_t>(root_weight.size()));
    wavelets_.reserve(static_cast<std::size_t>(root_weight.size()));
    for (const std::vector<Index>& set : sets) {
      if (set.empty()) continue;
      const auto begin = static_cast<Index>(items_.size());
      items_.insert(items_.end(), set.begin(), set.end());
      const auto end = static_cast<Index>(items_.size());
      wavelets_.push_back({begin, end, end, 1 / std::sqrt(weight(begin, end)), 0});
      add_differences(begin, end);
    }
  }

  Index count() const { return static_cast<Index>(wavelets_.size()); }

  MatrixXd coefficients(const MatrixXd& X) const {
    const MatrixXd in_order = (root_weight_.asDiagonal() * X)(items_, Eigen::all);
    MatrixXd result(count(), X.cols());
    for (Index k = 0; k < count(); ++k) {
      const Wavelet& w = wavelets_[static_cast<std::size_t>(k)];
      result.row(k) = w.left * in_order.middleRows(w.begin, w.middle - w.begin).colwise().sum() +
                      w.right * in_order.middleRows(w.middle, w.end - w.middle).colwise().sum();
    }
    return result;
  }

  MatrixXd columns(const std::vector<Index>& which) const {
    MatrixXd result = MatrixXd::Zero(root_weight_.size(), static_cast<Index>(which.size()));
    for (Index j = 0; j < result.cols(); ++j) {
      const Wavelet& w = wavelets_[static_cast<std::size_t>(which[static_cast<std::size_t>(j)])];
      for (Index place = w.begin; place < w.end; ++place) {
        const Index item = items_[static_cast<std::size_t>(place)];
        result(item, j) = root_weight_[item] * (place < w.middle ? w.left : w.right);
      }
    }
    return result;
  }

 private:
  double weight(Index begin, Index end) const {
    double sum = 0;
    for (Index place = begin; place < end; ++place) {
      const double root = root_weight_[items_[static_cast<std::size_t>(place)]];
      sum += root * root;
    }
    return sum;
  }

  void add_differences(Index begin, Index end) {
    if (end - begin < 2) return;
    const Index middle = begin + (end - begin) / 2;
    const double left = weight(begin, middle), right = weight(middle, end);
    wavelets_.push_back({begin, middle, end, std::sqrt(right / (left * (left + right))),
                         -std::sqrt(left / (right * (left + right)))});
    add_differences(begin, middle);
    add_differences(middle, end);
  }

  VectorXd root_weight_;
  std::vector<Index> items_;
  std::vector<Wavelet> wavelets_;
};

}  // namespace

FunctionFamily haar_wavelets(const std::vector<std::vector<Index>>& sets, const VectorXd& root_weight) {
  const auto sequence = std::make_shared<const HaarSequence>(sets, root_weight);
  return {root_weight.size(), sequence->count(),
          [sequence](const MatrixXd& X) { return sequence->coefficients(X); },
          [sequence](const std::vector<Index>& which) { return sequence->columns(which); }};
}

}  // namespace radiosity
