#include "gpu/shader_sources.hpp"

#include "foundation/error.hpp"

namespace radiosity {
namespace {

std::string_view file_text(std::string_view name) {
  for (const ShaderFile& file : shader_files())
    if (file.name == name) return file.text;
  fail<UsageError>("there is no shader '{}'", name);
}

/// Includes are on lines of their own and include nothing themselves.
std::string with_includes(std::string_view text) {
  constexpr std::string_view directive = "#include \"";
  std::string whole;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (line.starts_with(directive)) {
      line.remove_prefix(directive.size());
      line = file_text(line.substr(0, line.find('"')));
    }
    whole += line;
  }
  return whole;
}

}  // namespace

std::string shader_text(const ShaderVariant& variant) {
  std::string text = "#version 430 core\n";
  for (const auto& [name, value] : variant.defines) text += fmt::format("#define {} {}\n", name, value);
  return text + with_includes(file_text(variant.file));
}

}  // namespace radiosity
