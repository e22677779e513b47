#pragma once

#include "form_factors/form_factors.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace radiosity {

/// How form factors are computed, or where they are kept.
struct FormFactorChoice {
  FormFactorOptions options;
  std::filesystem::path kernel_file;  ///< read instead of computed; empty: computed
  std::filesystem::path save_file;    ///< written once they are there; empty: not kept
};

void add_form_factor_options(CLI::App& command, FormFactorChoice& choice);

/// Computes the form factors of the mesh, or reads them, and keeps them if asked to. Throws Error, with the
/// memory needed, where they do not fit into this machine.
FormFactors obtain_form_factors(const std::shared_ptr<const PatchMesh>& mesh, const FormFactorChoice& choice,
                                Monitor& monitor);

}  // namespace radiosity
