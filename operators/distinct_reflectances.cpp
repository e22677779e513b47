#include "operators/distinct_reflectances.hpp"

#include <algorithm>

namespace radiosity {

DistinctReflectances::DistinctReflectances(const Eigen::MatrixXd& reflectance) {
  of_channel_.reserve(static_cast<std::size_t>(reflectance.cols()));
  for (Index channel = 0; channel < reflectance.cols(); ++channel) {
    const auto known = std::find_if(representatives_.begin(), representatives_.end(), [&](Index other) {
      return reflectance.col(other) == reflectance.col(channel);
    });
    of_channel_.push_back(known - representatives_.begin());
    if (known == representatives_.end()) representatives_.push_back(channel);
  }
}

std::vector<Index> DistinctReflectances::columns_of(Index distinct, Index columns) const {
  std::vector<Index> found;
  found.reserve(static_cast<std::size_t>(columns));
  for (Index j = 0; j < columns; ++j)
    if (of_channel_[static_cast<std::size_t>(j) % of_channel_.size()] == distinct) found.push_back(j);
  return found;
}

}  // namespace radiosity
