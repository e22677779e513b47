#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <memory>
#include <string>
#include <type_traits>

namespace radiosity {

/// How a spec names the type that entries are stored in.
template <typename Scalar>
std::string storage_name() {
  if (std::is_same_v<Scalar, double>) return "f64";
  if (std::is_same_v<Scalar, float>) return "f32";
  return "f16";
}

/// The canonical spec of an operator whose default storage is f64: "dense", "dense:f32".
template <typename Scalar>
std::string storage_spec(const std::string& operator_name) {
  return std::is_same_v<Scalar, double> ? operator_name : operator_name + ":" + storage_name<Scalar>();
}

/// Bytes of R and A^{1/2}.
inline std::size_t diagonal_bytes(Index n, Index channels) {
  return static_cast<std::size_t>(n * (channels + 1)) * sizeof(double);
}

/// KernelOf<Scalar> for symmetric form factors, MatrixOf<Scalar> for unsymmetric ones.
template <template <typename> class KernelOf, template <typename> class MatrixOf, typename Scalar>
std::unique_ptr<LinearOperator> make_stored(const FormFactors& form_factors) {
  if (form_factors.symmetric()) return std::make_unique<KernelOf<Scalar>>(form_factors);
  return std::make_unique<MatrixOf<Scalar>>(form_factors);
}

}  // namespace radiosity
