#include "experiments/dxt_radiosity/colour_matrices.hpp"

#include "compression/largest_of_rows.hpp"
#include "operators/colour_operator.hpp"

#include <algorithm>
#include <cstddef>

namespace radiosity {

std::vector<ColourMatrix> colour_form_factors(const FormFactors& form_factors) {
  const Eigen::MatrixXd F = form_factors.matrix();
  const Eigen::MatrixXd colours = sender_colours(form_factors.mesh->reflectance);
  std::vector<ColourMatrix> matrices;
  for (Index channel = 0; channel < colours.cols(); ++channel)
    matrices.emplace_back((F * colours.col(channel).asDiagonal()).cast<float>());
  return matrices;
}

EntryErrors entry_errors(const std::vector<ColourMatrix>& matrices, const CompressedColours& compressed) {
  EntryErrors errors;
  const Index n = compressed.size();
  for (std::size_t channel = 0; channel < matrices.size(); ++channel) {
    const Eigen::MatrixXd decoded = compressed.materialize(static_cast<Index>(channel));
    const Eigen::MatrixXd difference = (decoded - matrices[channel].cast<double>()).cwiseAbs();
    if (n > 0) errors.largest = std::max(errors.largest, difference.maxCoeff());
    errors.total += difference.sum();
  }
  const auto entries = static_cast<double>(n * n) * static_cast<double>(matrices.size());
  errors.average = entries > 0 ? errors.total / entries : 0;
  return errors;
}

double largest_compressed_entry(const std::vector<ColourMatrix>& matrices, double exact) {
  double largest = 0;
  for (const ColourMatrix& matrix : matrices)
    largest = std::max(largest, largest_of_rest(matrix, largest_of_rows(matrix, exact)));
  return largest;
}

double bytes_per_entry(const CompressedColours& compressed) {
  std::size_t bytes = 0;
  for (const auto& [name, part] : compressed.byte_parts()) bytes += part;
  return static_cast<double>(bytes) / static_cast<double>(compressed.size() * compressed.size());
}

}  // namespace radiosity
