#include "form_factors/vector_loops.hpp"

#define RADIOSITY_LOOPS vector_loops_avx2
#include "form_factors/vector_loops.inc"
