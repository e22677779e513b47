#pragma once

#include <string>
#include <string_view>

namespace radiosity {

/// Text made safe for XML and HTML, in content and in quoted attributes. Control characters other than tab
/// and newline, which neither language can hold, become spaces.
std::string escape_markup(std::string_view text);

}  // namespace radiosity
