#pragma once

#include <string>

namespace radiosity::test {

/// Empty if `text` is well-formed XML of one element (tags nest and match, attributes are quoted, entities
/// are known); else what is wrong. A small reader of its own, enough for what the plots write.
std::string xml_problem(const std::string& text);

}  // namespace radiosity::test
