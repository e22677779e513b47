#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/rooms.hpp"

#include <memory>
#include <optional>
#include <string>

namespace radiosity {

/// Closure of an operator: restores row sums of the true kernel K, or its action on a few vectors, in an
/// approximation K~ of it (methods.md, "Layers").
///   rows       D K~, D = true / own row sums: right rows, not symmetric.
///   symmetric  D K~ D with right rows; where that does not exist, rows are only scaled down, and remark()
///              says so.
///   blocks     K~ + X P' + P X' - P (P'X) P', X = (K - K~) P, P = indicators of rooms times A^{1/2}: right
///   on
///              every room's uniform light, exists always, may have small negative entries.
///   automatic  none where the true kernel's rows are met to 1e-6, else blocks over rooms: it never adds to
///   the error
///              in the area norm, and was the better one in every scene and at every reflectance tried
///              (`radiosity compare SCENE --operators topk:closure=symmetric topk:closure=blocks`).
enum class OperatorClosure { none, rows, symmetric, blocks, automatic };

/// The side interface of an operator that multiplies as another one does and is called otherwise
/// (closure=none). Reflectances are its own.
class StandsForKernel {
 public:
  virtual ~StandsForKernel() = default;
  virtual const KernelOperator& kernel_stood_for() const = 0;
};

/// What a spec says about the closure: `closure=KIND` and, for blocks, `blocks=rooms|groups|N`.
struct ClosureChoice {
  OperatorClosure kind = OperatorClosure::none;
  std::string blocks = "rooms";  ///< rooms, groups, or a number of sets
  std::string text;  ///< the keys as a spec has them: "closure=blocks,blocks=24"; empty for none by default

  /// Takes its keys from `spec`; throws UsageError for values that it does not know.
  static ClosureChoice take(Spec& spec, const std::string& fallback = "none");
};

/// The operator with its closure; it keeps `approximation`, and needs the true kernel only while it is made.
/// Throws UsageError if the approximation is not a symmetric kernel (rows excepted) or F has none.
std::unique_ptr<LinearOperator> close_operator(std::unique_ptr<LinearOperator> approximation,
                                               const ClosureChoice& choice, const FormFactors& form_factors);

}  // namespace radiosity
