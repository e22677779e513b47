#include "apps/output_check.hpp"

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

#include <string_view>

namespace radiosity {

void require_writable(const std::filesystem::path& file) {
  if (file.empty()) return;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    fail("cannot write '{}': it is a folder; give a file name", file.string());
  const OutputFile probe(file);  // removed again, since it is never committed
}

void require_writable(const std::filesystem::path& file, const char* extension) {
  if (file.empty()) return;
  if (file.extension() != extension)
    fail<UsageError>("cannot write '{}': its name must end in {}", file.string(), extension);
  require_writable(file);
}

}  // namespace radiosity
