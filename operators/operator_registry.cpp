#include "operators/operator_registry.hpp"

#include "foundation/error.hpp"
#include "operators/closed_operator.hpp"
#include "operators/global_operator.hpp"

#include <fmt/ranges.h>

#include <utility>

namespace radiosity {
namespace {

/// Throws UsageError unless there is either a symmetric kernel or a full matrix, of the mesh's size.
void check_form_factors(const FormFactors& form_factors, bool needed) {
  if (!form_factors.mesh)
    fail<UsageError>("the form factors have no mesh: an operator needs its areas and reflectances");
  if (!needed && !form_factors.kernel && !form_factors.unsymmetric) return;
  if ((form_factors.kernel == nullptr) == (form_factors.unsymmetric == nullptr))
    fail<UsageError>("form factors have either a symmetric kernel or a full matrix; these have {}",
                     form_factors.kernel ? "both" : "neither");
  const Index n = form_factors.kernel ? form_factors.kernel->size() : form_factors.unsymmetric->rows();
  const PatchMesh& mesh = *form_factors.mesh;
  if (n != mesh.patch_count() || n != mesh.area.size() || n != mesh.reflectance.rows())
    fail<UsageError>("form factors of size {} do not fit a mesh of {} patches", n, mesh.patch_count());
}

}  // namespace

OperatorRegistry::OperatorRegistry(std::vector<OperatorEntry> entries) {
  for (OperatorEntry& entry : entries) add(std::move(entry));
}

void OperatorRegistry::add(OperatorEntry entry) {
  for (const OperatorEntry& other : entries_)
    if (other.name == entry.name) fail<UsageError>("there is already an operator named '{}'", entry.name);
  entries_.push_back(std::move(entry));
}

const OperatorEntry& OperatorRegistry::entry(const Spec& spec) const {
  std::vector<std::string> names;
  names.reserve(entries_.size());
  for (const OperatorEntry& entry : entries_) {
    if (entry.name == spec.name()) return entry;
    names.push_back(entry.name);
  }
  fail<UsageError>("there is no operator '{}' (in '{}'); known are {}", spec.name(), spec.text(),
                   fmt::join(names, ", "));
}

bool OperatorRegistry::needs_form_factors(const std::string& spec_text) const {
  Spec spec = Spec::parse(spec_text);
  return !entry(spec).direct || spec.text("factors", "") != "direct";
}

std::unique_ptr<LinearOperator> OperatorRegistry::make(const std::string& spec_text,
                                                       const FormFactors& form_factors) const {
  Spec spec = Spec::parse(spec_text);
  const OperatorEntry& found = entry(spec);
  check_form_factors(form_factors, needs_form_factors(spec_text));
  const ClosureChoice closure = ClosureChoice::take(spec, found.closure);
  const bool global = !found.makes_global && spec.flag("global");
  auto made = found.make(spec, form_factors);
  spec.finish();
  made = close_operator(std::move(made), closure, form_factors);
  return global ? std::make_unique<GlobalOperator>(std::move(made)) : std::move(made);
}

}  // namespace radiosity
