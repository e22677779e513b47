#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

#include <optional>

namespace radiosity {

/// B = E + T B in double precision with the given F to a residual of 1e-12: by cg where F is symmetric, else
/// (or where cg refuses, as with row sums above 1) by gmres, else by lu. Empty if none of them gets there.
std::optional<Field> reference_solution(const FormFactors& form_factors, const Field& emission);

/// Relative errors ||X - reference||_A / ||reference||_A of each light, its channels taken together. 0 where
/// both are 0; a field that should be 0 and is not has no relative error and is left out.
std::vector<double> relative_errors(const PatchMesh& mesh, const Field& X, const Field& reference);

}  // namespace radiosity
