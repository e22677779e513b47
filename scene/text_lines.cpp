#include "scene/text_lines.hpp"

#include "foundation/error.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace radiosity {

namespace {

constexpr std::string_view kBlanks = " \t\v\f";

/// A comment starts with # at the start of a line or after a blank; elsewhere # may be part of a name.
std::string_view without_comment(std::string_view line) {
  for (std::size_t k = 0; k < line.size(); ++k)
    if (line[k] == '#' && (k == 0 || kBlanks.find(line[k - 1]) != std::string_view::npos))
      return line.substr(0, k);
  return line;
}

}  // namespace

bool TextLines::next() {
  while (!rest_.empty()) {
    ++number_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = without_comment(rest_.substr(0, end));
    rest_ = rest_.substr(end);
    rest_ = rest_.substr(rest_.substr(0, 2) == "\r\n" ? 2 : std::min<std::size_t>(1, rest_.size()));

    words_.clear();
    remainder_ = {};
    for (std::size_t start = line.find_first_not_of(kBlanks); start != std::string_view::npos;
         start = line.find_first_not_of(kBlanks, start)) {
      const std::size_t stop = std::min(line.find_first_of(kBlanks, start), line.size());
      words_.push_back(line.substr(start, stop - start));
      start = stop;
      if (words_.size() == 2)
        remainder_ = line.substr(static_cast<std::size_t>(words_[1].data() - line.data()));
    }
    remainder_ = remainder_.substr(0, remainder_.find_last_not_of(kBlanks) + 1);
    if (!words_.empty()) return true;
  }
  return false;
}

double TextLines::finite_number(std::size_t k) const {
  const std::optional<double> value = parse_number(words_[k]);
  if (!value) fail_here(fmt::format("'{}' is not a number", words_[k]));
  if (!std::isfinite(*value)) fail_here(fmt::format("'{}' is not finite", words_[k]));
  return *value;
}

void TextLines::fail_here(std::string_view text) const {
  fail("{}:{}: {}", file_, number_, text);
}

std::optional<double> parse_number(std::string_view word) {
  if (word.empty()) return std::nullopt;
  const char* start = word.data() + (word.front() == '+' ? 1 : 0);
  const char* end = word.data() + word.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(start, end, value);
  // What is too small for a double is zero; what is too large is refused.
  const bool tiny = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
  if (error == std::errc::result_out_of_range && stop == end && tiny) return 0.0;
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

std::string read_text(const std::string& file) {
  if (std::filesystem::is_directory(file)) fail("'{}' is a folder; give a file", file);
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("cannot read '{}': {}", file, std::strerror(errno));
  std::ostringstream content;
  content << in.rdbuf();
  std::string text = std::move(content).str();
  if (text.empty()) fail("'{}' is empty", file);
  return text;
}

}  // namespace radiosity
