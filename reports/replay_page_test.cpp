#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "reports/replay.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string page_of(const Identity& identity) {
  const Subject s = subject(identity);
  return replay_page(examine(s, {}, Bar{}), s.description);
}

json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t start = page.find(open) + open.size();
  return json::parse(page.substr(start, page.find("</script>", start) - start));
}

std::vector<Identity> one_of_each_class() {
  std::vector<Identity> result;
  for (const Pair pair : all_pairs) {
    for (const auto& pose_class : pose_classes(pair)) result.push_back({pair, pose_class, 3, 1});
  }
  return result;
}

TEST(ReplayPage, HoldsEveryNumberThreeTimes) {
  for (const Identity& identity : one_of_each_class()) {
    const Configuration c = make_configuration(identity);
    const json data = data_of(page_of(identity));
    EXPECT_EQ(data["id"], to_string(identity));
    EXPECT_EQ(data["configuration"], to_json(c));
    EXPECT_EQ(data["hexadecimal"], to_hex_json(c));
    EXPECT_EQ(data["exact"], to_exact_json(c));
    EXPECT_FALSE(data["truth"]["normals"].empty());
  }
}

TEST(ReplayPage, LoadsNothingFromElsewhere) {
  for (const Pair pair : all_pairs) {
    std::string page = page_of({pair, pose_classes(pair).front(), 1, 0});
    // The one address is the SVG namespace, a name that is never fetched.
    const std::string svg = "'http://www.w3.org/2000/svg'";
    page.erase(page.find(svg), svg.size());
    for (const char* way : {"http:", "https:", "src=", "@import", "url(", "fetch(", "href="}) {
      EXPECT_THAT(page, Not(HasSubstr(way)));
    }
  }
}

TEST(ReplayPage, HasNoPlaceholderLeft) {
  const std::string page = page_of({Pair::box, "rim-face", 1, 2});
  for (const char* name : {"title", "pages", "heading", "main", "vega", "scripts", "data"}) {
    EXPECT_THAT(page, Not(HasSubstr("/* " + std::string(name))));
  }
}

TEST(ReplayPage, HostileReasonsStayData) {
  Examination hostile = examine(subject({Pair::box, "rim-face", 1, 2}), {}, Bar{});
  const std::string reason = "</script><script>alert(1)</script>";
  hostile.answers.push_back({"x", {{}, reason, {}}, {}});
  const std::string page = replay_page(hostile, "");
  EXPECT_EQ(data_of(page)["answers"]["x"]["reason"], reason);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
}

/// What Chromium makes of the page, as HTML; empty if it could not be run.
std::string drawn(const std::filesystem::path& file) {
  const std::string command = "chromium --headless --no-sandbox --disable-gpu --dump-dom file://" +
                              file.string() + " 2>/dev/null";
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> part;
  while (pipe && std::fgets(part.data(), part.size(), pipe)) text += part.data();
  if (pipe) pclose(pipe);
  return text;
}

TEST(ReplayPage, DrawsBothBodiesInABrowser) {
  if (std::system("command -v chromium >/dev/null") != 0) GTEST_SKIP() << "no chromium here";
  const auto file = std::filesystem::temp_directory_path() / "touchstone_replay_page_test.html";
  for (const Pair pair : all_pairs) {
    write_file(file, page_of({pair, pose_classes(pair).front(), 1, 0}), "file");
    const std::string page = drawn(file);
    // The slice has an outline of each body; the last table is filled after everything was drawn.
    EXPECT_THAT(page, HasSubstr("<path class=\"a\" d=\"M")) << pair_name(pair);
    EXPECT_THAT(page, HasSubstr("<path class=\"b\" d=\"M")) << pair_name(pair);
    EXPECT_THAT(page, HasSubstr("pose_a.position[2]")) << pair_name(pair);
    EXPECT_THAT(page, Not(HasSubstr("NaN"))) << pair_name(pair);
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace touchstone
