#include "reports/html/html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/html/marks.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// What stands in the page's data element, parsed again.
json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t start = page.find(open) + open.size();
  return json::parse(page.substr(start, page.find("</script>", start) - start));
}

/// A packed value as the page's script unpacks it.
json unpacked(const json& cell, const json& schema, const json& strings) {
  if (schema.is_string()) return strings[cell.get<std::size_t>()];
  if (schema.is_null() || cell.is_null()) return cell;
  json result = json::object();
  std::size_t i = 0;
  for (const auto& [key, of_member] : schema.items()) {
    result[key] = unpacked(cell[i++], of_member, strings);
  }
  return result;
}

TEST(Html, CarriesTheReport) {
  const json report = {{"schema", 1}, {"x", 0.1}, {"text", "é ≤ /* report.js */ $& \\u003c"}};
  json data = data_of(render_html(report));
  for (const char* added : {"strings", "marks"}) {
    EXPECT_TRUE(data[added].empty());
    data.erase(added);
  }
  EXPECT_EQ(data, report);
}

TEST(Html, PacksRowsWithoutLoss) {
  const json row = {{"pair", "cylinder-box"},
                    {"outcomes", {{"agree", 3}}},
                    {"severity", {{"max", 1.234e-300}, {"median", 0.0}}},
                    {"coverage", nullptr}};
  json other = row;
  other["outcomes"] = {{"agree", 1}, {"missed", 2}};
  other["severity"] = nullptr;
  other["coverage"] = {{"mean", 0.5}};
  other["pair"] = "cylinder-plane";
  for (const json& rows : {json{row, other}, json{row}, json{other, other, row}, json::array()}) {
    const json data = data_of(render_html({{"results", rows}}));
    ASSERT_EQ(data["results"]["rows"].size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(unpacked(data["results"]["rows"][i], data["results"]["schema"], data["strings"]),
                rows[i]);
    }
  }
}

TEST(Html, RoundsRowsToFourDigits) {
  const json data = data_of(render_html({{"summary", {{{"median", 1.0 / 3}}}}}));
  EXPECT_EQ(data["summary"]["rows"], json({{0.3333}}));
}

TEST(Marks, AreAnEnginesColourAndASettingsSymbol) {
  EXPECT_EQ(mark_of("bullet-float").colour, mark_of("bullet").colour);
  EXPECT_NE(mark_of("bullet-float").symbol, mark_of("bullet").symbol);
  EXPECT_NE(mark_of("ode").colour, mark_of("bullet").colour);
  EXPECT_EQ(mark_of("prism:8").symbol, mark_of("prism:64").symbol);
  EXPECT_EQ(mark_of("my-engine").colour, 7u);
  EXPECT_LT(mark_of("").symbol, 6u);
}

TEST(Html, HostileStringsStayData) {
  for (const char* text : {"</script><script>alert(1)</script>", "<!--<script>", "]]>"}) {
    const json report = {{"command", text}};
    const std::string page = render_html(report);
    EXPECT_EQ(data_of(page)["command"], text);
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  }
}

TEST(Html, LoadsNothingFromElsewhere) {
  std::string page = render_html(json::object());
  // The browser is told to refuse all requests, also those that Vega could make.
  EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; "));
  const std::size_t vega = page.find("const vega = ");
  page.erase(page.rfind("<script>", vega),
             page.find("</script>", vega) - page.rfind("<script>", vega));
  // The one address is the SVG namespace, a name that is never fetched.
  const std::string svg = "'http://www.w3.org/2000/svg'";
  page.erase(page.find(svg), svg.size());
  for (const char* way : {"http:", "https:", "src=", "@import", "url(", "fetch("}) {
    EXPECT_EQ(page.find(way), std::string::npos) << way;
  }
}

TEST(Html, HasNoPlaceholderLeft) {
  for (const char* name : {"title", "pages", "heading", "main", "library", "scripts", "data"}) {
    EXPECT_EQ(render_html(json::object()).find("/* " + std::string(name)), std::string::npos);
  }
}

}  // namespace
}  // namespace touchstone
