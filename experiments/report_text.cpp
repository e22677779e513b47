#include "experiments/report.hpp"

#include <algorithm>

namespace radiosity {
namespace {

constexpr std::size_t line_width = 110;

/// Characters, not bytes: continuation bytes of UTF-8 do not count.
std::size_t text_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string wrapped(const std::string& text) {
  std::string lines;
  std::size_t width = 0;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (width > 0 && width + 1 + text_width(word) > line_width) {
      lines += '\n';
      width = 0;
    } else if (width > 0) {
      lines += ' ';
      ++width;
    }
    lines += word;
    width += text_width(word);
  }
  return lines + "\n";
}

std::string aligned(const ReportTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(text_width(column));
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size() && k < widths.size(); ++k)
      widths[k] = std::max(widths[k], text_width(row[k]));
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t k = 0; k < cells.size() && k < widths.size(); ++k) {
      const std::string padding(widths[k] - text_width(cells[k]), ' ');
      text += k == 0 ? "" : "  ";
      text += k < table.text_columns ? cells[k] + padding : padding + cells[k];
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

struct BlockText {
  std::string operator()(const ReportText& block) const { return wrapped(block.text); }
  std::string operator()(const ReportTable& block) const { return wrapped(block.caption) + aligned(block); }
  std::string operator()(const ReportFigure&) const { return {}; }
};

}  // namespace

std::string to_text(const ReportSection& section) {
  std::string text = section.title + "\n\n";
  for (const ReportBlock& block : section.blocks) {
    const std::string part = std::visit(BlockText{}, block);
    if (!part.empty()) text += part + "\n";
  }
  return text;
}

}  // namespace radiosity
