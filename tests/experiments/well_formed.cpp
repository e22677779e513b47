#include "well_formed.hpp"

#include <regex>
#include <vector>

namespace radiosity::test {

std::string xml_problem(const std::string& text) {
  static const std::regex tag(R"(^<(/?)([A-Za-z][\w:-]*)((?:\s+[\w:-]+="[^"<]*")*)\s*(/?)>)");
  static const std::regex entity(R"(^&(amp|lt|gt|quot|#\d+);)");
  std::vector<std::string> open;
  int roots = 0;
  std::size_t at = text.rfind("<?xml", 0) == 0 ? text.find("?>") + 2 : 0;
  while (at < text.size()) {
    const std::string rest = text.substr(at, 2000);
    std::smatch match;
    if (text[at] == '<') {
      if (!std::regex_search(rest, match, tag)) return "no tag at: " + rest.substr(0, 60);
      if (match[1].length() > 0) {
        if (open.empty() || open.back() != match[2]) return "unexpected </" + match[2].str() + ">";
        open.pop_back();
      } else {
        if (open.empty() && ++roots > 1) return "a second root: " + match[2].str();
        if (match[4].length() == 0) open.push_back(match[2]);
      }
      at += static_cast<std::size_t>(match.length());
    } else if (text[at] == '&') {
      if (!std::regex_search(rest, match, entity)) return "no entity at: " + rest.substr(0, 20);
      at += static_cast<std::size_t>(match.length());
    } else {
      if (open.empty() && std::isspace(static_cast<unsigned char>(text[at])) == 0)
        return "text outside the root";
      ++at;
    }
  }
  return open.empty() && roots == 1 ? "" : "elements left open";
}

}  // namespace radiosity::test
