#pragma once

#include <string>
#include <string_view>

namespace radiosity {

/// What can be checked of a file before a library reads it: that the counts it announces fit its size, so
/// that a damaged count neither exhausts the memory nor reads beyond the end, and that its text holds no NaN.
/// All throw Error.
void check_stl(const std::string& file, std::string_view content);
void check_glb(const std::string& file, std::string_view content);

}  // namespace radiosity
