#pragma once

#include <string>

namespace CLI {
class Validator;
}  // namespace CLI

namespace radiosity {

/// Checks of option values for CLI11: NaN and infinity never pass, and the message names the range.
CLI::Validator number_above(double low);
CLI::Validator number_between(double low, double high, bool high_allowed = true);
CLI::Validator integer_between(long long low, long long high);

}  // namespace radiosity
