#pragma once

#include "operators/linear_operator.hpp"

#include <vector>

namespace radiosity {

/// Channels of equal reflectance, which share whatever is made for it.
class DistinctReflectances {
 public:
  /// `reflectance`: n x channels.
  explicit DistinctReflectances(const Eigen::MatrixXd& reflectance);

  /// How many different columns there are.
  Index count() const { return static_cast<Index>(representatives_.size()); }
  /// Which of them a channel has.
  Index of_channel(Index channel) const { return of_channel_[static_cast<std::size_t>(channel)]; }
  /// The first channel that has column `distinct`.
  Index representative(Index distinct) const { return representatives_[static_cast<std::size_t>(distinct)]; }

  /// The products of fields with a matrix for each reflectance: multiply(distinct, X_d, Y_d) is called with
  /// the columns X_d of X that have that reflectance, to write Y_d of `rows` rows. Returns the Y_d in X's
  /// order.
  template <typename Multiply>
  Field multiply_each(const ConstFieldRef& X, Index rows, const Multiply& multiply) const {
    Field products(rows, X.cols());
    for (Index distinct = 0; distinct < count(); ++distinct) {
      const std::vector<Index> columns = columns_of(distinct, X.cols());
      const Field fields = X(Eigen::all, columns);
      Field images(rows, fields.cols());
      multiply(distinct, fields, images);
      products(Eigen::all, columns) = images;
    }
    return products;
  }

 private:
  /// The columns of an n x `columns` field that have it, rising.
  std::vector<Index> columns_of(Index distinct, Index columns) const;

  std::vector<Index> of_channel_;
  std::vector<Index> representatives_;
};

}  // namespace radiosity
