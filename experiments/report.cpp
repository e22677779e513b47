#include "experiments/report.hpp"

#include "experiments/base64.hpp"
#include "experiments/markup.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace radiosity {
namespace {

constexpr const char* page_style = R"(
:root{--paper:#fff;--ink:#24292f;--muted:#57606a;--rule:#d8dee4;--band:#f6f8fa}
@media(prefers-color-scheme:dark){:root{--paper:#15181c;--ink:#e6e9ec;--muted:#a0a8b1;--rule:#343a41;--band:#1c2025}}
*{box-sizing:border-box}
body{margin:0 auto;padding:2rem 1rem 4rem;max-width:60rem;background:var(--paper);color:var(--ink);
font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
h1{font-size:1.9rem;line-height:1.2;margin:0 0 .4rem}h2{font-size:1.35rem;margin:3rem 0 .6rem}
p{max-width:42rem}.about,.command,figcaption{color:var(--muted);font-size:.875rem}
nav{margin:1.2rem 0;padding:.6rem 0;border-block:1px solid var(--rule)}nav a{margin-right:1.2rem}
a{color:inherit}
figure{margin:1.6rem 0}figure img,figure svg{display:block;max-width:100%;height:auto}
figure.picture{display:inline-block;vertical-align:top;width:27.5rem;max-width:100%;margin:1rem 1rem 0 0}
.wide{overflow-x:auto}.wide svg{min-width:44rem}
table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums}
figcaption{padding:.4rem 0;max-width:42rem}
th,td{padding:.35rem .8rem;text-align:right;white-space:nowrap;border-bottom:1px solid var(--rule)}
th{white-space:normal;vertical-align:bottom;border-bottom:2px solid var(--rule);font-weight:600}
th.text,td.text{text-align:left}th:first-child,td:first-child{padding-left:.2rem}
tbody tr:nth-child(even){background:var(--band)}
code{font:.8125rem ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;overflow-wrap:anywhere}
@media print{body{max-width:none;padding:0;font-size:10pt}nav{display:none}
figure,tr{break-inside:avoid}h2{break-after:avoid}.wide{overflow:visible}.wide svg{min-width:0}}
)";

std::string command_line(const std::string& command) {
  return command.empty() ? "" : "<div class=\"command\"><code>" + escape_markup(command) + "</code></div>\n";
}

std::string table_row(const std::vector<std::string>& cells, const char* tag, std::size_t text_columns) {
  std::string html = "<tr>";
  for (std::size_t k = 0; k < cells.size(); ++k)
    html += fmt::format("<{0}{1}>{2}</{0}>", tag, k < text_columns ? " class=\"text\"" : "",
                        escape_markup(cells[k]));
  return html + "</tr>\n";
}

std::string to_html(const ReportText& block) {
  return "<p>" + escape_markup(block.text) + "</p>\n";
}

std::string to_html(const ReportTable& table) {
  std::string html =
      "<figure>\n<figcaption>" + escape_markup(table.caption) + "</figcaption>\n<div class=\"wide\">\n";
  html += "<table>\n<thead>" + table_row(table.columns, "th", table.text_columns) + "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size())
      fail("the table '{}' has {} columns, but a row with {} cells", table.caption, table.columns.size(),
           row.size());
    html += table_row(row, "td", table.text_columns);
  }
  return html + "</tbody>\n</table>\n</div>\n" + command_line(table.command) + "</figure>\n";
}

std::string to_html(const ReportFigure& figure) {
  const auto* svg = std::get_if<std::string>(&figure.image);
  const std::string caption = escape_markup(figure.caption);
  const std::string image = svg ? "<div class=\"wide\">\n" + *svg + "</div>\n"
                                : fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n", caption,
                                              base64(std::get<std::vector<std::uint8_t>>(figure.image)));
  return (svg ? "<figure>\n" : "<figure class=\"picture\">\n") + image + "<figcaption>" + caption +
         "</figcaption>\n" + command_line(figure.command) + "</figure>\n";
}

}  // namespace

ReportFigure png_figure(const std::filesystem::path& file, const std::string& caption,
                        const std::string& command) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  constexpr std::array<std::uint8_t, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (bytes.size() < signature.size() || !std::equal(signature.begin(), signature.end(), bytes.begin()))
    fail("cannot put '{}' into the report: it is missing or no PNG", file.string());
  return {caption, command, std::move(bytes)};
}

std::string to_html(const Report& report) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  html += "<meta name=\"color-scheme\" content=\"light dark\">\n";
  html += "<title>" + escape_markup(report.title) + "</title>\n<style>" + page_style +
          "</style>\n</head>\n<body>\n";
  html += "<h1>" + escape_markup(report.title) + "</h1>\n";
  html += "<div class=\"about\">" + escape_markup(report.machine) + "<br>" + escape_markup(report.date) +
          "</div>\n";
  if (report.sections.size() > 1) {
    html += "<nav>";
    for (std::size_t s = 0; s < report.sections.size(); ++s)
      html += fmt::format("<a href=\"#section-{}\">{}</a>", s + 1, escape_markup(report.sections[s].title));
    html += "</nav>\n";
  }
  for (std::size_t s = 0; s < report.sections.size(); ++s) {
    html += fmt::format("<section id=\"section-{}\">\n<h2>{}</h2>\n", s + 1,
                        escape_markup(report.sections[s].title));
    for (const ReportBlock& block : report.sections[s].blocks)
      html += std::visit([](const auto& content) { return to_html(content); }, block);
    html += "</section>\n";
  }
  return html + "</body>\n</html>\n";
}

void write_report(const std::filesystem::path& file, const Report& report) {
  const std::string html = to_html(report);
  OutputFile output(file);
  output.stream() << html;
  output.commit();
}

}  // namespace radiosity
