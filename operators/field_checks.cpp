#include "operators/field_checks.hpp"

#include "foundation/error.hpp"

#include <functional>

namespace radiosity {
namespace {

/// One past the last number that a field's memory holds; null for a field without numbers.
const double* memory_end(const ConstFieldRef& field) {
  if (field.size() == 0) return field.data();
  return field.data() + (field.cols() - 1) * field.outerStride() + field.rows();
}

bool share_memory(const ConstFieldRef& X, const ConstFieldRef& Y) {
  const std::less<const double*> before;
  return X.size() > 0 && Y.size() > 0 && before(X.data(), memory_end(Y)) && before(Y.data(), memory_end(X));
}

}  // namespace

void check_fields(const std::string& operator_name, Index n, Index channels, const ConstFieldRef& X,
                  const FieldRef& Y) {
  if (X.rows() != n || Y.rows() != n)
    fail<UsageError>("operator '{}' has {} patches: X of {} rows and Y of {} rows do not fit", operator_name,
                     n, X.rows(), Y.rows());
  if (X.cols() != Y.cols())
    fail<UsageError>("operator '{}': X has {} columns and Y has {}; give both the same", operator_name,
                     X.cols(), Y.cols());
  if (X.cols() % channels != 0)
    fail<UsageError>("operator '{}' has {} channels: {} columns are not a multiple of them", operator_name,
                     channels, X.cols());
  if (share_memory(X, Y))
    fail<UsageError>("operator '{}': X and Y share memory; give Y memory of its own", operator_name);
}

void scale_field(double beta, FieldRef Y) {
  if (beta == 0)
    Y.setZero();
  else if (beta != 1)
    Y *= beta;
}

}  // namespace radiosity
