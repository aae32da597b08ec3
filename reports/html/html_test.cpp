#include "reports/html/html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Html, CarriesTheReportUnchanged) {
  const json report = {{"schema", 1}, {"x", 0.1}, {"text", "é ≤ /* report.js */ $& \\u003c"}};
  EXPECT_EQ(data_of(render_html(report)), report);
}

TEST(Html, HostileStringsStayData) {
  for (const char* text : {"</script><script>alert(1)</script>", "<!--<script>", "]]>"}) {
    const json report = {{"command", text}};
    const std::string page = render_html(report);
    EXPECT_EQ(data_of(page), report);
    EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  }
}

TEST(Html, LoadsNothingFromElsewhere) {
  std::string page = render_html(json::object());
  // The one address is the SVG namespace, a name that is never fetched.
  const std::string svg = "'http://www.w3.org/2000/svg'";
  page.erase(page.find(svg), svg.size());
  for (const char* way : {"http:", "https:", "src=", "@import", "url(", "fetch("}) {
    EXPECT_THAT(page, Not(HasSubstr(way)));
  }
}

TEST(Html, HasNoPlaceholderLeft) {
  for (const char* placeholder : {"/* report.", "/* elements."}) {
    EXPECT_THAT(render_html(json::object()), Not(HasSubstr(placeholder)));
  }
}

}  // namespace
}  // namespace touchstone
