#include "reports/figures/figures.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

#include "candidates/candidates.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/own_folder_test.hpp"
#include "reference/invalid_input.hpp"
#include "reports/make_report.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string text_of(const std::filesystem::path& file) { return read_file(file, "file"); }

TEST(Figures, EachComesAsPictureTwiceAndAsData) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
  Campaign c{.pairs = {Pair::plane, Pair::box},
             .classes = {"general-shallow", "touching"},
             .candidates = find_candidates({"reference", "bullet", "prism:8"}),
             .count = 3};
  Report report = make_report(c, "x");
  // A plug-in may be called anything.
  const std::string odd_name = "a\"b,`touch run`'{c}\\";
  for (CandidateDescription& each : report.candidates) {
    if (each.name == "prism:8") each.name = odd_name;
  }
  for (auto* rows : {&report.summary, &report.results}) {
    for (ResultRow& row : *rows) {
      if (row.candidate == "prism:8") row.candidate = odd_name;
    }
  }
  const OwnFolder own;
  const std::filesystem::path folder =
      own.with("touchstone figures's test/errors-of-an-earlier-run.svg", "x").parent_path();
  write_figures(report, folder);
  EXPECT_FALSE(std::filesystem::exists(folder / "errors-of-an-earlier-run.svg"));
  for (const char* name : {"speed-accuracy", "speed-accuracy-cylinder-box", "errors-all",
                           "errors-cylinder-plane", "classes-cylinder-box"}) {
    EXPECT_THAT(text_of(folder / (std::string(name) + ".svg")), HasSubstr("</svg>")) << name;
    EXPECT_THAT(text_of(folder / (std::string(name) + ".png")), StartsWith("\x89PNG")) << name;
    // Every mark has its name in the figure, which may stand alone.
    const std::string svg = text_of(folder / (std::string(name) + ".svg"));
    const std::string csv = text_of(folder / (std::string(name) + ".csv"));
    for (const auto& [in_csv, in_svg] : {std::pair{"reference,", ">reference<"},
                                         {"bullet,", ">bullet<"},
                                         {"{c}\\\",", ">a\"b,`touch run`'{c}\\<"}}) {
      if (csv.find(in_csv) == std::string::npos) continue;  // no contact in this figure
      EXPECT_THAT(svg, HasSubstr(in_svg)) << name;
    }
    EXPECT_THAT(svg, testing::Not(HasSubstr("e-0"))) << name;
    EXPECT_THAT(text_of(folder / (std::string(name) + ".csv")), HasSubstr("reference,")) << name;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "errors-cylinder-box-degenerate.svg"));
  EXPECT_THAT(text_of(folder / "classes-cylinder-box.csv"),
              testing::AllOf(HasSubstr("general+shallow,"), testing::Not(HasSubstr("touching,"))));
  EXPECT_THAT(text_of(folder / "errors-all.csv"), HasSubstr("\"a\"\"b,`touch run`'{c}\\\""));
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  EXPECT_FALSE(std::filesystem::exists(folder / "figures.gnuplot"));
}

TEST(Figures, MarkWhoHasNoRoutineForSomePairs) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
  Campaign c;
  c.pairs = {Pair::plane, Pair::sphere};
  c.classes = {"general-shallow"};
  c.candidates = find_candidates({"reference", "libccd-gjk"});  // without planes
  c.count = 2;
  const OwnFolder own;
  const std::filesystem::path& folder = own.path;
  write_figures(make_report(c, "x"), folder);
  for (const char* const name : {"speed-accuracy", "speed-accuracy-all", "errors-all"}) {
    const std::string svg = text_of(folder / (std::string(name) + ".svg"));
    EXPECT_THAT(svg, HasSubstr(">libccd-gjk (1 of 2 pairs)<")) << name;
    EXPECT_THAT(svg, HasSubstr(">reference<")) << name;
  }
  EXPECT_THAT(text_of(folder / "errors-cylinder-sphere.svg"), HasSubstr(">libccd-gjk<"));
}

TEST(Figures, ShowTheReleasesOfAnEngine) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot here";
  Report report;
  report.history = History{"mine", {}};
  for (const auto& [name, right] : {std::pair("mine@1.9", 3U), {"mine@1.10", 4U}}) {
    report.candidates.push_back({name, name, "1", "", ""});
    for (const char* pair : {"all", "cylinder-box"}) {
      ResultRow row{pair, "everyday", name, {}, QueryTime{{1500, 1400, 1600}}, {}, {}, {}};
      row.statistics.count = 4;
      row.statistics.outcomes[static_cast<std::size_t>(Outcome::agree)] = right;
      row.statistics.outcomes[static_cast<std::size_t>(Outcome::missed)] = 4 - right;
      report.summary.push_back(row);
    }
  }
  const OwnFolder own;
  const std::filesystem::path& folder = own.path;
  write_figures(report, folder);
  EXPECT_EQ(text_of(folder / "history.csv"),
            "release,pair,agreement,nanoseconds\n1.9,all,0.75,1500\n1.9,cylinder-box,0.75,1500\n"
            "1.10,all,1,1500\n1.10,cylinder-box,1,1500\n");
  const std::string svg = text_of(folder / "history.svg");
  for (const char* text : {">mine, median µs of a query<", ">1.10<", ">all pairs<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

// A figure may stand alone: its key tells the candidates apart by colour, symbol and dash.
TEST(Figures, EveryCandidateHasAStyleOfItsOwn) {
  std::vector<std::string> names;
  for (const Candidate* c : all_candidates()) names.push_back(c->name);
  for (const char* const family : {"prism", "spheres"}) {
    for (const int n : {4, 8, 16, 32, 64}) names.push_back(fmt::format("{}:{}", family, n));
  }
  for (const char* const own : {"my-engine", "his-engine", "her-engine", "b", "h", "n"}) {
    names.emplace_back(own);  // by their names' letters some have the same symbol
  }
  std::map<std::string, std::string> seen;
  for (const auto& [name, style] : figure_styles(names)) {
    EXPECT_TRUE(seen.emplace(style, name).second) << name << " looks like " << seen[style];
    // Where there are no lines, and where nothing but lines is seen.
    EXPECT_TRUE(seen.emplace(style.substr(0, style.find(" dash")), name).second) << name;
    EXPECT_TRUE(seen.emplace(style.substr(style.find("linecolor")), name).second) << name;
  }
  EXPECT_EQ(figure_styles(names).at("bullet"), figure_styles({"bullet"}).at("bullet"));
}

TEST(Figures, RefuseAFolderThatIsAFile) {
  const OwnFolder own;
  EXPECT_THROW(check_figures(own.with("file", "x")), InvalidInput);
}

}  // namespace
}  // namespace touchstone
