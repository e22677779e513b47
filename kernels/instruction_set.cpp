#include "kernels/instruction_set.hpp"

#include "foundation/error.hpp"

#include <cstdlib>
#include <string>

namespace radiosity {
namespace {

InstructionSet best_of_processor() {
#if defined(RADIOSITY_X86_KERNELS)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("f16c"))
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
