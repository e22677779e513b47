#include "experiments/base64.hpp"
#include "experiments/report.hpp"
#include "foundation/error.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>

namespace radiosity {
namespace {

Report small_report() {
  ReportTable table{
      "Errors", "radiosity compare cube --operators dense", {"operator", "error"}, {{"dense <f64>", "0"}}};
  ReportFigure figure{"A plot", "radiosity bench", std::string("<svg></svg>")};
  return {"Results & more",
          "a processor",
          "2000-01-01",
          {{"First", {ReportText{"Prose."}, table}}, {"Second", {figure}}}};
}

TEST(Report, HoldsEverything) {
  const std::string html = to_html(small_report());
  for (const char* part :
       {"Results &amp; more", "a processor", "2000-01-01", "<p>Prose.</p>", "<th>error</th>",
        "<td class=\"text\">dense &lt;f64&gt;</td>", "radiosity compare cube", "<svg></svg>",
        "href=\"#section-2\"", "id=\"section-2\"", "name=\"viewport\"", "@media print"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(Report, NeedsNothingElse) {
  const std::string html = to_html(small_report());
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
}

TEST(Report, TagsNest) {
  const std::string html = to_html(small_report());
  const std::regex tag(
      R"(<(/?)(section|div|table|caption|thead|tbody|tr|td|th|figure|figcaption|p|nav|body|html)\b[^>]*>)");
  std::vector<std::string> open;
  for (std::sregex_iterator at(html.begin(), html.end(), tag), end; at != end; ++at) {
    if ((*at)[1].length() == 0) {
      open.push_back((*at)[2]);
      continue;
    }
    ASSERT_FALSE(open.empty());
    ASSERT_EQ(open.back(), (*at)[2].str());
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

TEST(Report, RefusesRaggedTables) {
  Report report = small_report();
  std::get<ReportTable>(report.sections[0].blocks[1]).rows.push_back({"csr"});
  EXPECT_THROW(to_html(report), Error);
}

TEST(Report, PicturesTravelInside) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "picture.png";
  const std::string bytes = "\x89PNG\r\n\x1a\nrest";
  std::ofstream(file, std::ios::binary) << bytes;
  const ReportFigure figure = png_figure(file, "picture", "command");
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(figure.image).size(), bytes.size());
  Report report = small_report();
  report.sections[1].blocks.emplace_back(figure);
  EXPECT_NE(to_html(report).find("src=\"data:image/png;base64,iVBORw0KGgpyZXN0\""), std::string::npos);
  std::ofstream(file, std::ios::binary) << "GIF89a..";
  EXPECT_THROW(png_figure(file, "", ""), Error);
  std::filesystem::remove(file);
  EXPECT_THROW(png_figure(file, "", ""), Error);
}

TEST(Report, WritesAFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "report.html";
  write_report(file, small_report());
  EXPECT_EQ(std::filesystem::file_size(file), to_html(small_report()).size());
  std::filesystem::remove(file);
  EXPECT_THROW(write_report(file / "nowhere" / "report.html", small_report()), Error);
}

TEST(Base64, EncodesTheStandardsExamples) {
  const auto encode = [](const std::string& text) {
    return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encode("\xff\xff\xff"), "////");
}

}  // namespace
}  // namespace radiosity
