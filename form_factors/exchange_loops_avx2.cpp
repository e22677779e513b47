#include "form_factors/exchange_loops.hpp"

#define RADIOSITY_LOOPS exchange_loops_avx2
#include "form_factors/exchange_loops.inc"
