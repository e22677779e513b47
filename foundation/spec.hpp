#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {

/// A parsed spec string, "name" or "name:key=value,flag,...". A factory takes the keys it knows; a key that
/// nobody has taken is an error that lists those that were asked for.
class Spec {
 public:
  /// Throws UsageError for an empty name, an empty key and a key given twice.
  static Spec parse(const std::string& text);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }

  /// The value of `key`, or `fallback`. Throws UsageError with the spec, the key and the range if it is not a
  /// number in [low, high].
  double number(const std::string& key, double fallback, double low, double high);
  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  std::string text(const std::string& key, const std::string& fallback);

  /// The value of `key` with everything that follows it, commas included: a spec inside a spec, as in
  /// "cg:preconditioner=quantized:bits=4,exact=0.01". Empty if the key is not there.
  std::string rest(const std::string& key);

  /// One of `choices`, given as key=choice or as a bare flag; throws UsageError that lists them.
  std::string choice(const std::string& key, const std::string& fallback,
                     const std::vector<std::string>& choices);

  /// A flag is given as "flag", "flag=1" or "flag=0".
  bool flag(const std::string& key, bool fallback = false);

  /// Throws UsageError for keys that nobody asked for, listing those that were.
  void finish() const;

 private:
  struct Entry {
    std::string key;
    std::string value;
    std::size_t value_begin = 0;  ///< in text_
    bool has_value = false;
    bool taken = false;
  };
  Entry* take(const std::string& key);

  std::string text_;
  std::string name_;
  std::vector<Entry> entries_;
  std::vector<std::string> known_;
};

/// The spec with further keys: "csr" and "dense:f16" with "closure=rows" are "csr:closure=rows" and
/// "dense:f16,closure=rows".
std::string with_keys(const std::string& spec, const std::string& keys);

}  // namespace radiosity
