#include "form_factors/exchange_loops.hpp"

#define RADIOSITY_LOOPS exchange_loops_baseline
#include "form_factors/exchange_loops.inc"
