#include "kernels/instruction_set.hpp"

#include "foundation/error.hpp"

#include <cstdlib>
#include <string>

#if defined(RADIOSITY_X86_KERNELS)
#include <cpuid.h>
#endif

namespace radiosity {
namespace {

#if defined(RADIOSITY_X86_KERNELS)
// F16C; not every compiler's __builtin_cpu_supports knows it.
bool converts_halves() {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __get_cpuid(1, &eax, &ebx, &ecx, &edx) != 0 && (ecx & bit_F16C) != 0;
}
#endif

InstructionSet best_of_processor() {
#if defined(RADIOSITY_X86_KERNELS)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && converts_halves())
    return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

}  // namespace

std::string_view name(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::baseline:
      break;
  }
  return "baseline";
}

InstructionSet best_instruction_set() {
  const InstructionSet best = best_of_processor();
  const char* wanted = std::getenv("RADIOSITY_INSTRUCTIONS");
  if (wanted == nullptr || *wanted == '\0') return best;
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    if (name(set) == wanted) return set < best ? set : best;
  fail<UsageError>("RADIOSITY_INSTRUCTIONS is '{}': use baseline, avx2 or avx512", wanted);
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets;
  const InstructionSet best = best_of_processor();
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    if (set <= best) sets.push_back(set);
  return sets;
}

}  // namespace radiosity
