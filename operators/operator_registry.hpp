#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "operators/linear_operator.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

struct OperatorEntry {
  std::string name;
  std::string summary;   ///< one line for --help
  std::string defaults;  ///< keys with their defaults, as a spec: "dense:f64"
  std::function<std::unique_ptr<LinearOperator>(Spec&, const FormFactors&)> make;
  std::string closure = "none";  ///< unless the spec names another (operators/closed_operator.hpp)
  bool lossy = false;   ///< is further from T than the rounding of its storage: measured by its certificate
  bool direct = false;  ///< with factors=direct in its spec it needs the mesh of the form factors only, not F
  bool cubic = false;   ///< takes O(n^3) to build: left out of benchmarks unless it is named
  bool makes_global = false;               ///< `make` takes the key `global` itself
  std::vector<std::string> variants = {};  ///< further specs that tests and benchmarks take along
};

/// The operators a program knows, as a value: assembled from lists (cpu_operators(), a user's own) and passed
/// on.
class OperatorRegistry {
 public:
  OperatorRegistry() = default;
  explicit OperatorRegistry(std::vector<OperatorEntry> entries);

  /// Throws UsageError if the name is taken.
  void add(OperatorEntry entry);

  const std::vector<OperatorEntry>& entries() const { return entries_; }

  /// Whether what a spec names is made from F; otherwise the mesh of the form factors is enough. Throws
  /// UsageError for unknown names.
  bool needs_form_factors(const std::string& spec) const;

  /// Parses and builds. Every spec may name a closure, as in "dense:f16,closure=symmetric", and every one of
  /// low rank may ask for its global operator, as in "svd:k=64,global=1". Throws UsageError for unknown names
  /// and keys, listing the known ones.
  std::unique_ptr<LinearOperator> make(const std::string& spec, const FormFactors& form_factors) const;

 private:
  const OperatorEntry& entry(const Spec& spec) const;

  std::vector<OperatorEntry> entries_;
};

/// The operators of this library that run on the CPU.
OperatorRegistry cpu_operators();

}  // namespace radiosity
