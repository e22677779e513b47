#pragma once

#include "factorizations/matrix_products.hpp"
#include "form_factors/form_factors.hpp"

namespace radiosity {

/// Which matrix a factorization approximates best.
enum class FactorizationNorm {
  plain,  ///< F
  area    ///< the symmetric kernel K = A^{1/2} F A^{-1/2}
};

/// Products with F or with K, in double. They share the form factors. K needs symmetric form factors.
MatrixProducts form_factor_products(const FormFactors& form_factors, FactorizationNorm norm);

}  // namespace radiosity
