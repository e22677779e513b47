#pragma once

#include <string_view>
#include <vector>

namespace radiosity {

/// Which vector instructions a kernel may use, in rising order.
enum class InstructionSet { baseline, avx2, avx512 };

/// The best that this processor and this build have. The environment variable RADIOSITY_INSTRUCTIONS
/// (baseline, avx2 or avx512) lowers it, for tests and comparisons.
InstructionSet best_instruction_set();

/// All that can run here, in rising order.
std::vector<InstructionSet> available_instruction_sets();

std::string_view name(InstructionSet set);

}  // namespace radiosity
