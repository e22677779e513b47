#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace radiosity {

/// A paragraph of plain text.
struct ReportText {
  std::string text;
};

/// A table: its first columns are text, the others are numbers, aligned right.
struct ReportTable {
  std::string caption;
  std::string command;               ///< what makes it: "radiosity compare cornell-box ..."
  std::vector<std::string> columns;  ///< with their units
  std::vector<std::vector<std::string>> rows;
  std::size_t text_columns = 1;
};

/// A picture: SVG text, or the bytes of a PNG file.
struct ReportFigure {
  std::string caption;
  std::string command;
  std::variant<std::string, std::vector<std::uint8_t>> image;
};

using ReportBlock = std::variant<ReportText, ReportTable, ReportFigure>;

struct ReportSection {
  std::string title;
  std::vector<ReportBlock> blocks;
};

/// The report of a run of experiments.
struct Report {
  std::string title;
  std::string machine;  ///< one line: processor, threads, bandwidth
  std::string date;     ///< one line
  std::vector<ReportSection> sections;
};

/// A figure from a PNG file. Throws Error if it cannot be read or is no PNG.
ReportFigure png_figure(const std::filesystem::path& file, const std::string& caption,
                        const std::string& command);

/// The report as one HTML page that needs nothing else: styles and SVG inline, PNG as data. Reads well on a
/// phone, on paper and on a dark screen. Throws Error for a table whose rows are not as long as its heading.
std::string to_html(const Report& report);

/// The texts and tables of a section for a terminal, columns aligned; figures are left out. Ends with a
/// newline.
std::string to_text(const ReportSection& section);

/// Writes to_html as a file that appears whole or not at all.
void write_report(const std::filesystem::path& file, const Report& report);

}  // namespace radiosity
