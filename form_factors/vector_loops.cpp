#include "form_factors/vector_loops.hpp"

namespace radiosity {

extern const VectorLoops vector_loops_baseline;
#ifdef __x86_64__
extern const VectorLoops vector_loops_avx2;
extern const VectorLoops vector_loops_avx512;
#endif

VectorLoops vector_loops(InstructionSet instructions) {
#ifdef __x86_64__
  if (instructions == InstructionSet::avx512) return vector_loops_avx512;
  if (instructions == InstructionSet::avx2) return vector_loops_avx2;
#else
  static_cast<void>(instructions);
#endif
  return vector_loops_baseline;
}

}  // namespace radiosity
