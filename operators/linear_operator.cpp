#include "operators/linear_operator.hpp"

#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/field_checks.hpp"

namespace radiosity {

std::size_t ByteCount::total() const {
  std::size_t sum = 0;
  for (const auto& part : parts) sum += part.second;
  return sum;
}

void LinearOperator::apply(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  apply_checked(alpha, X, beta, Y, [&] { apply_impl(alpha, X, beta, Y); });
}

void LinearOperator::apply_checked(double alpha, const ConstFieldRef& X, double beta, FieldRef Y,
                                   const std::function<void()>& compute) const {
  check_fields(describe(), size(), channels(), X, Y);
  if (X.cols() == 0 || size() == 0) return;
  if (alpha == 0) {
    scale_field(beta, Y);
    return;
  }
  const Stopwatch watch;
  compute();
  count_products(X.cols(), watch.seconds());
}

void LinearOperator::count_products(Index columns, double seconds) const {
  products_ += static_cast<std::uint64_t>(columns / channels());
  nanoseconds_ += static_cast<std::uint64_t>(1e9 * seconds);
}

}  // namespace radiosity
