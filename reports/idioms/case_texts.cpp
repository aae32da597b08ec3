#include "reports/idioms/case_texts.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <vector>

#include "properties/named.hpp"
#include "properties/pose_class.hpp"
#include "reports/idioms/axes.hpp"
#include "reports/replay.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {

// Made by the build from the files tests.*.in of candidates/reproducers.
extern const std::string_view tests_mjcf_template, tests_rs_template;

const Language model_language = {"mjcf", "", tests_mjcf_template, NumberStyle::decimal};
const Language rust = {"rust", "//", tests_rs_template, NumberStyle::decimal};

namespace {

/// "RimFace" of "rim-face".
std::string camel_case(std::string_view name) {
  std::string result;
  for (const std::string_view word : split(name, '-')) {
    result += static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    result += word.substr(1);
  }
  return result;
}

/// A text as a comment, in lines of 100 columns.
std::string comment(std::string_view remark, std::string_view text) {
  constexpr std::size_t width = 100;
  std::string result, line(remark);
  for (const std::string_view word : split(text, ' ')) {
    if (line.size() + 1 + word.size() > width) {
      result += line + '\n';
      line = remark;
    }
    line += ' ' + std::string(word);
  }
  return result + line;
}

/// What the engine does in a case, as the end of a sentence.
std::string_view deed(const std::string& verdict) {
  static const std::map<std::string, std::string_view, std::less<>> deeds = {
      {"missed", "finds no contact"},
      {"phantom", "finds a contact where there is none"},
      {"shallow", "finds too small a depth"},
      {"overdeep", "finds too large a depth"},
      {"wrong-normal", "answers a direction along which the bodies overlap more"},
      {"not-finite", "answers what is no number"},
      {"off-body", "answers a point that is on neither body"},
      {"no-points", "answers no point"},
      {"failed", "fails"}};
  return deeds.at(verdict);
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    result += c == '"' ? "&quot;" : c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return result;
}

/// The vector without components that are rounding errors, of a zero's sign.
Vec3 without_noise(const Vec3& v, double zero) {
  return v.unaryExpr([zero](double x) { return std::abs(x) < negligible_component ? zero : x; });
}

/// All optimal normals, their components with spaces.
std::string normals_in_words(const oracle::Truth& truth) {
  std::vector<double> numbers;
  for (const oracle::OptimalNormal& optimal : truth.normals) {
    const Vec3 n = without_noise(optimal.n, 0.0);
    numbers.insert(numbers.end(), n.begin(), n.end());
  }
  return fmt::format("{}", fmt::join(numbers, " "));
}

}  // namespace

std::string with_underscores(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

std::string with_points(std::string_view numbers) {
  std::string result;
  for (const std::string_view number : split(numbers, ' ')) {
    const std::string_view digits = number.substr(0, number.find(','));
    const bool is_whole = digits.find_first_not_of("-0123456789") == digits.npos && !digits.empty();
    result += (result.empty() ? "" : " ") + std::string(digits) + (is_whole ? ".0" : "") +
              std::string(number.substr(digits.size()));
  }
  return result;
}

Texts names_in_javascript() {
  Texts texts;
  for (const std::string body : {"a", "b"}) {
    const std::string Body = body == "a" ? "A" : "B", turn = "...orientation" + Body;
    for (const char* name : {"_along_x", "_along_y"}) texts[body + name] = turn;
    texts["xyzw_" + body] = turn;
    texts["orientation_" + body] = fmt::format("orientation{0}[3], {1}.slice(0, 3)", Body, turn);
    for (const char* name : {"position", "orientation"}) {
      texts[fmt::format("{}_{}_xml", name, body)] = fmt::format("${{{}{}.join(' ')}}", name, Body);
    }
    texts["radius_" + body] = "${radius" + Body + "}";
    texts["half_length_" + body] = "${halfLength" + Body + "}";
    texts["convex_radius_" + body] = "convexRadius" + Body;
  }
  texts.merge(Texts{{"half_b_xml", "${halfB.join(' ')}"},
                    {"plane_point", "...pointB"},
                    {"plane_point_xml", "${pointB.join(' ')}"},
                    {"plane_along_x", "...turnB"},
                    {"plane_along_z_xml", "${turnB.join(' ')}"},
                    {"threshold", "${threshold}"}});
  return texts;
}

Texts case_texts(const IdiomCase& c, const std::string& engine, const Language& language,
                 Habit habit) {
  const PoseClass& of = c.identity.pose_class;
  Texts texts = question_texts(renamed(c.configuration, habit.axis), NumberStyle::decimal);
  if (&language == &rust) {
    for (auto& [name, text] : texts) text = with_points(text);
  }
  std::string sentences = of.arrangement->description;
  if (c.verdict != "right") sentences += fmt::format(" {} {}.", engine, deed(c.verdict));
  sentences += fmt::format(" (Rounded from {}.)", to_string(c.identity));
  const bool is_python = &language == &python;  // whose tests have docstrings
  const bool is_model = &language == &model_language;
  texts["sentences"] = is_model ? xml_escaped(sentences)
                                : comment(is_python ? "       " : language.remark, sentences);
  texts["name"] = fmt::format("{}/{}", pair_name(of.pair), of.arrangement->name);
  texts["true_normals"] = normals_in_words(c.truth);
  texts["title_as_name"] = with_underscores(of.arrangement->name);
  std::string& vertices = texts["vertices_list"] = texts["vertices_b"];
  std::replace(vertices.begin(), vertices.end(), '{', '[');
  std::replace(vertices.begin(), vertices.end(), '}', ']');
  texts["title"] = of.arrangement->name;
  texts["test_name"] = camel_case(of.arrangement->name);
  for (const std::string body : {"a", "b"}) {
    texts["turn_" + body] = texts[(habit.real_part_first ? "orientation_" : "xyzw_") + body];
  }
  texts["true_distance"] = fmt::format("{}", nearest_to_middle(c.truth.signed_distance));
  if (&language == &rust) texts["true_distance"] = with_points(texts["true_distance"]);
  texts["tolerance"] = fmt::format("{:.2g}", c.tolerance);
  texts["float_tolerance"] = fmt::format("{:.2g}", c.float_tolerance);
  texts["verdict"] = c.verdict;
  return texts;
}

Texts jolt_texts(const IdiomCase& c, const Bar& bar) {
  Texts texts = truth_texts(c.configuration, c.truth, bar, NumberStyle::hexadecimal);
  const Vec3 axis = -without_noise(renamed(c.truth.normals.front().n, 'y'), -0.0);
  texts["true_axis_float"] =
      fmt::format("{:#.9g}f, {:#.9g}f, {:#.9g}f", axis.x(), axis.y(), axis.z());
  texts["allowed_float"] = fmt::format("{:#.2g}f", c.float_tolerance);
  texts["allowed_words"] += ", and what rounding to float does";
  const bool fails = c.verdict != "right" && c.verdict != "off-body";  // it looks at no points
  texts["decorator"] = fails ? " * doctest::should_fail()" : "";
  return texts;
}

std::string_view tag_of_distance(const IdiomCase& c) {
  const double distance = c.truth.signed_distance.midpoint();
  return distance > c.tolerance ? "apart" : distance < -c.tolerance ? "overlapping" : "touching";
}

}  // namespace touchstone
