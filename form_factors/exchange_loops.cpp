#include "form_factors/exchange_loops.hpp"

namespace radiosity {

extern const ExchangeLoops exchange_loops_baseline;
#ifdef __x86_64__
extern const ExchangeLoops exchange_loops_avx2;
extern const ExchangeLoops exchange_loops_avx512;
#endif

ExchangeLoops exchange_loops(InstructionSet instructions) {
#ifdef __x86_64__
  if (instructions == InstructionSet::avx512) return exchange_loops_avx512;
  if (instructions == InstructionSet::avx2) return exchange_loops_avx2;
#else
  static_cast<void>(instructions);
#endif
  return exchange_loops_baseline;
}

}  // namespace radiosity
