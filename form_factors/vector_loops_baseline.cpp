#include "form_factors/vector_loops.hpp"

#define RADIOSITY_LOOPS vector_loops_baseline
#include "form_factors/vector_loops.inc"
