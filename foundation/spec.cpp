#include "foundation/spec.hpp"

#include "foundation/error.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace radiosity {
namespace {

/// The whole text as a number, or nothing.
template <typename Number>
bool read_number(const std::string& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

Spec Spec::parse(const std::string& text) {
  Spec spec;
  spec.text_ = text;
  const std::size_t colon = text.find(':');
  spec.name_ = text.substr(0, colon);
  if (spec.name_.empty()) fail<UsageError>("'{}' names nothing: write name or name:key=value,flag", text);
  if (colon == std::string::npos) return spec;

  std::size_t begin = colon + 1;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    Entry entry;
    entry.key = part.substr(0, equals);
    entry.has_value = equals != std::string::npos;
    if (entry.has_value) {
      entry.value = part.substr(equals + 1);
      entry.value_begin = begin + equals + 1;
    }
    if (entry.key.empty()) fail<UsageError>("'{}': a key is empty; write name:key=value,flag", text);
    if (entry.has_value && entry.value.empty())
      fail<UsageError>("'{}': key '{}' has no value", text, entry.key);
    for (const Entry& other : spec.entries_)
      if (other.key == entry.key) fail<UsageError>("'{}': key '{}' is given twice", text, entry.key);
    spec.entries_.push_back(std::move(entry));
    begin = end + 1;
  }
  return spec;
}

Spec::Entry* Spec::take(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  for (Entry& entry : entries_)
    if (entry.key == key) {
      entry.taken = true;
      return &entry;
    }
  return nullptr;
}

double Spec::number(const std::string& key, double fallback, double low, double high) {
  const Entry* entry = take(key);
  if (entry == nullptr) return fallback;
  double value = 0;
  if (!read_number(entry->value, value) || !(value >= low && value <= high))
    fail<UsageError>("'{}': {}={} is not a number in [{}, {}]", text_, key, entry->value, low, high);
  return value;
}

std::int64_t Spec::integer(const std::string& key, std::int64_t fallback, std::int64_t low,
                           std::int64_t high) {
  const Entry* entry = take(key);
  if (entry == nullptr) return fallback;
  std::int64_t value = 0;
  if (!read_number(entry->value, value) || value < low || value > high)
    fail<UsageError>("'{}': {}={} is not a whole number in [{}, {}]", text_, key, entry->value, low, high);
  return value;
}

std::string Spec::text(const std::string& key, const std::string& fallback) {
  const Entry* entry = take(key);
  if (entry == nullptr) return fallback;
  if (!entry->has_value) fail<UsageError>("'{}': key '{}' needs a value: {}=...", text_, key, key);
  return entry->value;
}

std::string Spec::rest(const std::string& key) {
  const Entry* entry = take(key);
  if (entry == nullptr) return {};
  if (!entry->has_value) fail<UsageError>("'{}': key '{}' needs a value: {}=...", text_, key, key);
  const std::size_t begin = entry->value_begin;
  for (Entry& other : entries_) other.taken = other.taken || &other > entry;
  return text_.substr(begin);
}

std::string Spec::choice(const std::string& key, const std::string& fallback,
                         const std::vector<std::string>& choices) {
  std::vector<std::string> given;
  if (const Entry* entry = take(key)) given.push_back(entry->value);
  for (Entry& entry : entries_)
    if (!entry.has_value && entry.key != key &&
        std::find(choices.begin(), choices.end(), entry.key) != choices.end()) {
      entry.taken = true;
      given.push_back(entry.key);
    }
  known_.insert(known_.end(), choices.begin(), choices.end());
  if (given.size() > 1)
    fail<UsageError>("'{}': {} is given more than once ({}); choose one", text_, key, fmt::join(given, ", "));
  if (given.empty()) return fallback;
  if (std::find(choices.begin(), choices.end(), given[0]) == choices.end())
    fail<UsageError>("'{}': {}={} is not one of {}", text_, key, given[0], fmt::join(choices, ", "));
  return given[0];
}

bool Spec::flag(const std::string& key, bool fallback) {
  const Entry* entry = take(key);
  if (entry == nullptr) return fallback;
  if (!entry->has_value || entry->value == "1") return true;
  if (entry->value == "0") return false;
  fail<UsageError>("'{}': {}={} is neither 0 nor 1", text_, key, entry->value);
}

void Spec::finish() const {
  for (const Entry& entry : entries_) {
    if (entry.taken) continue;
    if (known_.empty())
      fail<UsageError>("'{}': '{}' takes no keys, but '{}' is given", text_, name_, entry.key);
    fail<UsageError>("'{}': key '{}' is not known; '{}' knows {}", text_, entry.key, name_,
                     fmt::join(known_, ", "));
  }
}

std::string with_keys(const std::string& spec, const std::string& keys) {
  return spec + (spec.find(':') == std::string::npos ? ":" : ",") + keys;
}

}  // namespace radiosity
