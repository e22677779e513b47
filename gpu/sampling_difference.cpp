#include "gpu/sampling_difference.hpp"

#include "foundation/parallel.hpp"
#include "operators/colour_operator.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr Index rows_of_sampling_group = 64;

/// What of the bound is the rounding of exp on the device: (3 + 2 * 80) u for ranges up to 80, twice.
constexpr double rounding_of_exp = 4e-5;

}  // namespace

SampledTexelBounds::SampledTexelBounds(const ColourTexture& texture) : texture_(texture) {
  for (int colour = 0; colour < 3; ++colour) {
    std::vector<double>& bounds = of_colour_[static_cast<std::size_t>(colour)];
    bounds.resize(codes * codes * 4);
    const int largest = bc1_largest(colour);
    for (int first = 0; first <= largest; ++first)
      for (int second = 0; second <= largest; ++second)
        for (int index = 0; index < 4; ++index)
          bounds[(codes * static_cast<std::size_t>(first) + static_cast<std::size_t>(second)) * 4 +
                 static_cast<std::size_t>(index)] =
              bound(static_cast<double>(first) / largest, static_cast<double>(second) / largest, index);
  }
}

double SampledTexelBounds::bound(double first, double second, int index) const {
  const double shares[] = {1, 0, 2.0 / 3, 1.0 / 3};
  const double code = shares[index] * first + (1 - shares[index]) * second;
  if (code == 0) return 0;
  const double off = sampled_code_difference(first, second);
  if (!texture_.curve().logarithmic) return off;
  const auto number = [&](double part) {
    return part > 0 ? std::exp(texture_.curve().range * (std::min(part, 1.0) - 1)) : 0;
  };
  const double own = number(code);
  return std::max(number(code + off) - own, own - number(code - off)) + rounding_of_exp * own;
}

double SampledTexelBounds::operator()(Index row, Index column, int channel) const {
  constexpr Index side = ColourTexture::block_side;
  const Bc1Block& block = texture_.block_row(row / side)[column / side];
  const int colour = texture_.colour_channel(channel);
  const auto pair = codes * static_cast<std::size_t>(bc1_channel(block.first, colour)) +
                    static_cast<std::size_t>(bc1_channel(block.second, colour));
  const int index = bc1_index(block, static_cast<int>(row % side * side + column % side));
  return of_colour_[static_cast<std::size_t>(colour)][pair * 4 + static_cast<std::size_t>(index)];
}

SamplingDifference sampling_difference(const ColourTexture& texture, const std::vector<Index>& order,
                                       const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& area) {
  const auto n = static_cast<Index>(order.size());
  const SampledTexelBounds bounds(texture);
  const Eigen::MatrixXd inverse_colours = sender_colours(reflectance).cwiseInverse();
  SamplingDifference sums{Eigen::MatrixXd::Zero(n, texture.channels()),
                          Eigen::MatrixXd::Zero(n, texture.channels())};
  std::vector<Eigen::MatrixXd> columns(
      static_cast<std::size_t>((n + rows_of_sampling_group - 1) / rows_of_sampling_group));
  parallel_for(columns.size(), [&](std::size_t group) {
    columns[group] = Eigen::MatrixXd::Zero(n, texture.channels());
    const Index first = rows_of_sampling_group * static_cast<Index>(group);
    for (Index p = first; p < std::min(first + rows_of_sampling_group, n); ++p) {
      const Index i = order[static_cast<std::size_t>(p)];
      for (int channel = 0; channel < texture.channels(); ++channel)
        for (Index q = 0; q < n; ++q) {
          const Index j = order[static_cast<std::size_t>(q)];
          const double difference = reflectance(i, channel) * std::fabs(texture.scale(channel)) *
                                    bounds(p, q, channel) * inverse_colours(j, channel);
          sums.rows(i, channel) += difference;
          columns[group](j, channel) += area[i] / area[j] * difference;
        }
    }
  });
  for (const Eigen::MatrixXd& of_group : columns) sums.columns += of_group;
  return sums;
}

Certificate sampled_certificate(const LinearOperator& original, const SamplingDifference& difference,
                                const Eigen::VectorXd& area) {
  constexpr double slack = 1 + 1e-10;  // for rounding of the sums in double
  Certificate certificate = original.certificate();
  if (original.size() == 0) return certificate;
  if (certificate.spectral_radius_bound)
    *certificate.spectral_radius_bound += slack * difference.rows.maxCoeff();
  if (!certificate.operator_error) return certificate;
  const double error = *certificate.operator_error;
  Field uniform(original.size(), original.channels());
  original.apply(Field::Ones(original.size(), original.channels()), uniform);
  const Eigen::VectorXd root_area = area.cwiseSqrt();
  for (Index channel = 0; channel < original.channels(); ++channel) {
    const double norm = uniform.col(channel).cwiseProduct(root_area).norm() / root_area.norm();
    const double own =
        std::sqrt(difference.rows.col(channel).maxCoeff() * difference.columns.col(channel).maxCoeff());
    if (own > 0)
      certificate.operator_error =
          std::max(*certificate.operator_error, slack * (error + own * (1 + error) / norm));
  }
  return certificate;
}

}  // namespace radiosity
