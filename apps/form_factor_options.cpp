#include "apps/form_factor_options.hpp"

#include "apps/memory_need.hpp"
#include "apps/number_ranges.hpp"
#include "form_factors/kernel_file.hpp"
#include "foundation/error.hpp"
#include "foundation/memory.hpp"

#include <CLI/CLI.hpp>

#include <map>
#include <new>

namespace radiosity {

void add_form_factor_options(CLI::App& command, FormFactorChoice& choice) {
  const std::map<std::string, FormFactorMethod> methods = {{"accurate", FormFactorMethod::accurate},
                                                           {"one-ray", FormFactorMethod::one_ray},
                                                           {"gather", FormFactorMethod::gather}};
  const std::map<std::string, Closure> closures = {{"none", Closure::none},
                                                   {"symmetric", Closure::symmetric}};
  command
      .add_option_function<std::string>(
          "--form-factors",
          [&choice, methods](const std::string& name) { choice.options.method = methods.at(name); },
          "how they are computed; default accurate")
      ->check(CLI::IsMember(methods).description(""))
      ->option_text("accurate|one-ray|gather");
  command
      .add_option("--form-factor-tolerance", choice.options.tolerance,
                  "estimated standard error of each form factor, also between groups; default 1e-4")
      ->check(number_between(1e-12, 0.1))
      ->option_text("T");
  command
      .add_option("--gather-rays", choice.options.gather_rays,
                  "rays from each patch for gather; default 1024")
      ->check(integer_between(16, 1 << 24))
      ->option_text("N");
  command
      .add_option_function<std::string>(
          "--closure",
          [&choice, closures](const std::string& name) { choice.options.closure = closures.at(name); },
          "whether rows are made to sum to what is exposed; default: symmetric where the scene is watertight")
      ->check(CLI::IsMember(closures).description(""))
      ->option_text("none|symmetric");
  CLI::Option* kernel =
      command.add_option("--kernel", choice.kernel_file, "read the form factors that --save kept")
          ->option_text("FILE");
  command.add_option("--save", choice.save_file, "keep the form factors for --kernel")
      ->option_text("FILE")
      ->excludes(kernel);
}

FormFactors obtain_form_factors(const std::shared_ptr<const PatchMesh>& mesh, const FormFactorChoice& choice,
                                Monitor& monitor) {
  if (!choice.kernel_file.empty()) return load_kernel(choice.kernel_file, mesh);
  const double bytes = form_factor_bytes(mesh->patch_count(), choice.options.method);
  const auto refuse = [&](const std::string& limit) {
    fail("the form factors of {} patches take up to {}, {}: use fewer patches (--patches, --edge)",
         mesh->patch_count(), byte_text(bytes), limit);
  };
  if (bytes > machine_memory())
    refuse(fmt::format("and this machine has {} of memory", byte_text(machine_memory())));
  try {
    FormFactors form_factors = compute_form_factors(mesh, choice.options, monitor);
    if (!choice.save_file.empty()) save_kernel(choice.save_file, form_factors);
    return form_factors;
  } catch (const std::bad_alloc&) {
    refuse("more than this process could get");
    throw;
  }
}

}  // namespace radiosity
