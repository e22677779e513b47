#include "compression/colour_codes.hpp"

#include "compression/log_map.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace radiosity {
namespace {

constexpr std::size_t rows_of_a_task = 16;

/// Calls visit(column, number) for the entries of a row that are not in the exact part.
template <typename Visit>
void visit_rest(const ColourMatrix& matrix, const CsrMatrix<float>& exact, Index row, const Visit& visit) {
  auto next = static_cast<std::size_t>(exact.row_begin[static_cast<std::size_t>(row)]);
  const auto end = static_cast<std::size_t>(exact.row_begin[static_cast<std::size_t>(row) + 1]);
  for (Index column = 0; column < matrix.cols(); ++column) {
    if (next < end && exact.column[next] == column)
      ++next;
    else
      visit(column, matrix(row, column));
  }
}

}  // namespace

double largest_of_rest(const ColourMatrix& matrix, const CsrMatrix<float>& exact) {
  Eigen::VectorXf largest = Eigen::VectorXf::Zero(matrix.rows());
  parallel_for(
      static_cast<std::size_t>(matrix.rows()),
      [&](std::size_t i) {
        const auto row = static_cast<Index>(i);
        visit_rest(matrix, exact, row,
                   [&](Index, float number) { largest[row] = std::max(largest[row], number); });
      },
      rows_of_a_task);
  return matrix.rows() == 0 ? 0 : static_cast<double>(largest.maxCoeff());
}

double spanned_range(const ColourMatrix& matrix, const CsrMatrix<float>& exact, double share) {
  const double largest = largest_of_rest(matrix, exact);
  LogSums sums(largest);
  std::vector<LogSums> of_row(static_cast<std::size_t>(matrix.rows()), sums);
  parallel_for(
      of_row.size(),
      [&](std::size_t i) {
        visit_rest(matrix, exact, static_cast<Index>(i),
                   [&](Index, float number) { of_row[i].add(static_cast<double>(number)); });
      },
      rows_of_a_task);
  for (const LogSums& row : of_row) sums.add(row);
  return sums.range(share);
}

CodedChannel code_channel(const ColourMatrix& matrix, CsrMatrix<float> exact, const CodeOfPart& code,
                          bool fill) {
  CodedChannel channel;
  channel.largest = largest_of_rest(matrix, exact);
  channel.code = CodeMatrix::Zero(matrix.rows(), matrix.cols());
  channel.exact = std::move(exact);
  if (channel.largest == 0 && !fill) return channel;
  const double unit = channel.largest > 0 ? 1 / channel.largest : 0;
  const auto coded = [&](float number) {
    return static_cast<std::uint8_t>(std::lround(code(std::min(unit * static_cast<double>(number), 1.0))));
  };
  parallel_for(
      static_cast<std::size_t>(matrix.rows()),
      [&](std::size_t i) {
        const auto row = static_cast<Index>(i);
        if (fill)
          for (Index column = 0; column < matrix.cols(); ++column)
            channel.code(row, column) = coded(matrix(row, column));
        else
          visit_rest(matrix, channel.exact, row,
                     [&](Index column, float number) { channel.code(row, column) = coded(number); });
      },
      rows_of_a_task);
  return channel;
}

}  // namespace radiosity
