#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace radiosity {

/// Walks through the lines of a text file and its words, for error messages "file:line: ...".
class TextLines {
 public:
  TextLines(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  /// Steps to the next line that is neither blank nor a comment (#); false at the end.
  bool next();

  const std::vector<std::string_view>& words() const { return words_; }
  std::size_t number() const { return number_; }

  /// The text after the first word, without surrounding blanks.
  std::string_view remainder() const { return remainder_; }

  /// Throws Error unless word `k` is a finite number.
  double finite_number(std::size_t k) const;

  /// Throws Error "file:line: text".
  [[noreturn]] void fail_here(std::string_view text) const;

 private:
  std::string file_;
  std::string_view rest_;
  std::string_view remainder_;
  std::vector<std::string_view> words_;
  std::size_t number_ = 0;
};

/// A number written in decimal or as nan or inf, correctly rounded; nothing if it is not one or too large for
/// a double.
std::optional<double> parse_number(std::string_view word);

/// The whole content of a file. Throws Error if it cannot be read or is empty.
std::string read_text(const std::string& file);

}  // namespace radiosity
