#pragma once

#include "form_factors/form_factors.hpp"

namespace radiosity {

/// Fills in row_sum_min, row_sum_max, row_sum_rms and reciprocity_max from the form factors as they are.
void measure_row_sums(FormFactors& form_factors);

}  // namespace radiosity
