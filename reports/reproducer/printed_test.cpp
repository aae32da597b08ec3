// Every number and every sentence that a reproducer prints or begins with, against the oracle, for
// wrong answers of every engine. What it prints is a matter of the question, the answer and the
// program's own judgement; so the answers are those of the candidates, planted where a program asks
// its engine, which reproducer_test.sh runs. TOUCHSTONE_COUNT sets how many answers of each engine
// are tried.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <regex>
#include <span>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/identity.hpp"
#include "properties/moves.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "reports/replay.hpp"
#include "reports/reproducer/programs.hpp"
#include "reports/reproducer/texts.hpp"

namespace touchstone {
namespace {

/// A program is written for an engine in a language, and repeats a candidate.
struct Engine {
  std::string name, candidate, language;
};

/// One of each language, for the first set of tests, each of which has contacts of bodies that are
/// apart; then the others.
const std::vector<Engine> engines = {{"mujoco", "mujoco", "c++"},
                                     {"rapier", "rapier", "javascript"},
                                     {"mujoco3", "mujoco3", "python"},
                                     {"bullet", "bullet", "c++"},
                                     {"ode", "ode", "c++"},
                                     {"fcl", "fcl", "c++"},
                                     {"libccd", "libccd-gjk", "c++"},
                                     {"prism:16", "prism:16", "c++"},
                                     {"jolt", "jolt", "javascript"},
                                     {"jolt-world", "jolt-world", "javascript"},
                                     {"rapier-world", "rapier-world", "javascript"},
                                     {"physx", "physx", "javascript"},
                                     {"physx-world", "physx-world", "javascript"},
                                     {"havok", "havok", "javascript"},
                                     {"mujoco3", "mujoco3", "javascript"}};
constexpr std::size_t usual_engines = 3, usual_answers = 8;

/// By turns contacts are asked for where bodies touch, and up to half a metre apart.
constexpr Bar bars[] = {{1e-4, 0}, {1e-4, 0.5}};

struct Wrong {
  std::string id;
  Configuration configuration;
  Answer answer;
  Outcome outcome;
  Bar bar;
};

/// The engine's wrong answers: by turns of all pairs that its program knows, and classes, so many.
/// With a threshold only those about bodies that are apart.
std::vector<Wrong> wrong_answers(const Engine& engine, std::size_t wanted) {
  const std::string& candidate = engine.candidate;
  const auto has_program = [&](Pair pair) {
    return std::none_of(programs().begin(), programs().end(), [&](const Program& p) {
      return p.candidate == candidate && p.language.name == engine.language && !knows(p, pair);
    });
  };
  std::vector<Identity> all;
  for (std::uint64_t i = 0; i <= wanted / 10; ++i) {
    for (const Pair pair : all_pairs) {
      if (!has_program(pair)) continue;
      for (const std::string& name : pose_classes(pair)) all.push_back({pair, name, 41, i});
    }
  }
  std::vector<CandidateProcess> processes;
  for (const Bar& bar : bars) processes.emplace_back(find_candidate(candidate), bar.threshold);
  std::vector<Wrong> result;
  constexpr std::size_t stride = 397;  // prime: spreads over pairs and classes
  for (std::size_t i = 0; i < all.size() && result.size() < wanted; ++i) {
    const Identity& id = all[i * stride % all.size()];
    const Bar& bar = bars[result.size() % std::size(bars)];
    CandidateProcess& process = processes[result.size() % std::size(bars)];
    if (!process.candidate().has_routine_for(id.pose_class.pair)) continue;
    const Configuration c = make_configuration(id);
    const oracle::Truth truth = oracle::truth(c);
    const double allowed = bar.tolerance * error_size(c, bar);
    if (bar.threshold > 0 && i < all.size() / 2 && truth.signed_distance.lo < allowed) continue;
    const Answer answer = process.answer(c);
    const Outcome outcome = score(c, truth, answer, bar).outcome;
    if (agrees(outcome) || outcome == Outcome::crashed || outcome == Outcome::timed_out) {
      continue;
    }
    result.push_back({to_string(id), c, answer, outcome, bar});
  }
  return result;
}

/// Without its packages no program is asked of an engine of npm while programs are written.
class WithoutPackages {
 public:
  WithoutPackages() : folder_(std::getenv("TOUCHSTONE_NPM") ? std::getenv("TOUCHSTONE_NPM") : "") {
    setenv("TOUCHSTONE_NPM", "/nowhere", 1);
  }
  ~WithoutPackages() {
    folder_.empty() ? unsetenv("TOUCHSTONE_NPM") : setenv("TOUCHSTONE_NPM", folder_.c_str(), 1);
  }
  WithoutPackages(const WithoutPackages&) = delete;
  WithoutPackages& operator=(const WithoutPackages&) = delete;

 private:
  std::string folder_;
};

// The answer in place of the engine.

/// In hexadecimal, or as the language calls what is no number.
std::string number(double x, const std::string& language) {
  const bool is_cpp = language == "c++", is_js = language == "javascript";
  if (std::isfinite(x)) {
    return is_cpp ? fmt::format("{:a}", x) : fmt::format("{:#.17g}", x);
  }
  if (std::isnan(x)) return is_cpp ? "NAN" : is_js ? "NaN" : "math.nan";
  return (x < 0 ? "-" : "") + std::string(is_cpp ? "INFINITY" : is_js ? "Infinity" : "math.inf");
}

std::string numbers(const double (&v)[3], const std::string& language) {
  return fmt::format("{}, {}, {}", number(v[0], language), number(v[1], language),
                     number(v[2], language));
}

/// The program's part that asks, for the answer alone.
std::string asking(const Answer& a, const std::string& language) {
  const auto n = [&](double x) { return number(x, language); };
  const auto v = [&](const double(&x)[3]) { return numbers(x, language); };
  const bool is_contact = a.status == TS_CONTACT;
  std::string points;
  const char* const point = language == "c++" ? "{{{{{}}}, {{{}}}, {}}}, "
                            : language == "javascript"
                                ? "{{ position: [{}], normal: [{}], depth: {} }}, "
                                : "Point([{}], [{}], {}), ";
  for (int i = 0; is_contact && i < a.point_count; ++i) {
    const ts_point& p = a.points[i];
    points += fmt::format(fmt::runtime(point), v(p.position), v(p.normal), n(p.depth));
  }
  if (language == "c++") {
    const char* const kind = is_contact ? "contact" : a.status == TS_NONE ? "none" : "failed";
    return fmt::format("Answer ask() {{ return {{Answer::{}, {}, {{{}}}, {{{}}}}}; }}\n", kind,
                       is_contact ? n(a.signed_distance) : "0", is_contact ? v(a.normal) : "",
                       points);
  }
  if (language == "javascript") {
    if (a.status == TS_NONE) return "function ask() { return null; }\n";
    if (!is_contact) return "function ask() { throw new Error('planted'); }\n";
    return fmt::format(
        "function ask() {{ return {{ distance: {}, normal: [{}], points: [{}] }}; }}\n",
        n(a.signed_distance), v(a.normal), points);
  }
  if (a.status == TS_NONE) return "def ask():\n    return None\n\n\n";
  if (!is_contact) return "def ask():\n    raise Failure('planted')\n\n\n";
  return fmt::format("def ask():\n    return Answer({}, [{}], [{}])\n\n\n", n(a.signed_distance),
                     v(a.normal), points);
}

/// The program, with the answer in place of what asks the engine.
std::string planted(const std::string& program, const Wrong& w, const std::string& language) {
  const std::string remark = language == "python" ? "# " : "// ";
  // What of the question comes last, and how that ends.
  const auto [last, end] = language == "c++"          ? std::pair("struct Answer {", "\n};\n")
                           : language == "javascript" ? std::pair("function answerOf(", "\n}\n")
                                                      : std::pair("class Failure(", "pass\n");
  const std::size_t question = program.find(remark + "The question"),
                    ask = program.find(end, program.find(last)) + std::strlen(end),
                    judgement = program.find(remark + "From here on");
  EXPECT_LT(question, ask);
  EXPECT_LT(ask, judgement);
  EXPECT_NE(judgement, program.npos);
  return program.substr(question, ask - question) + '\n' + asking(w.answer, language) +
         program.substr(judgement);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

/// One program of all of them, which prints "=== " and a line's end before each one's text.
std::string together(const std::vector<std::string>& programs, const std::string& language) {
  std::string text, calls;
  if (language == "c++") text = "#include <cmath>\n#include <cstdio>\n#include <vector>\n";
  if (language == "python") text = "import math, sys\nfrom typing import NamedTuple\n";
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (language == "c++") {
      text += fmt::format("namespace of_{} {{\n{}}}\n", i,
                          replaced(programs[i], "int main() {", "int run() {"));
      calls += fmt::format("  std::puts(\"=== \");\n  of_{}::run();\n", i);
    } else if (language == "javascript") {
      text += "console.log('=== ');\n(() => {\n" +
              replaced(programs[i], "process.exit(wrong ? 1 : 0);", "") + "\n})();\n";
    } else {
      text += "print('=== ')\nexec(" +
              nlohmann::json(replaced(programs[i], "sys.exit(main())", "main()")).dump() +
              ", dict(globals()))\n";
    }
  }
  return language == "c++" ? text + "int main() {\n" + calls + "}\n" : text;
}

/// What each of the programs prints.
std::vector<std::string> printed_by(const std::vector<std::string>& programs,
                                    const std::string& language) {
  const OwnFolder folder;
  const char* const name = language == "c++"          ? "all.cpp"
                           : language == "javascript" ? "all.mjs"
                                                      : "all.py";
  const std::string file = folder.with(name, together(programs, language)).string();
  const std::string text = touchstone::printed_by(
      language == "c++"          ? fmt::format("g++ -w {0} -o {0}.out && {0}.out", file)
      : language == "javascript" ? "node " + file
                                 : "python3 -B " + file);
  std::vector<std::string> result;
  for (std::size_t at = text.find("=== \n"); at != text.npos;) {
    const std::size_t next = text.find("=== \n", at + 5);
    result.push_back(text.substr(at + 5, next - at - 5));
    at = next;
  }
  return result;
}

// What is printed, against the oracle.

/// One answer's numbers, as far as they are known from elsewhere.
struct Known {
  explicit Known(const Wrong& wrong)
      : w(wrong),
        c(as_asked(wrong.configuration)),
        truth(oracle::truth(c)),
        n(wrong.answer.normal) {
    // Sixteen roundings of the distance between the centres, or of the largest size.
    const double largest = std::max(
        {(c.pose_a.position() - c.pose_b.position()).norm(), larger_size(c), error_size(c, Bar{})});
    rounding = 16 * std::numeric_limits<double>::epsilon() * largest;
    of_place = std::numeric_limits<double>::epsilon() * c.pose_a.position().norm();
  }
  double distance() const { return truth.signed_distance.midpoint(); }
  bool is_nearest_to_distance(double x) const {
    const auto from = [&](double y) {
      return mpq_class(abs(truth.signed_distance.lo + truth.signed_distance.hi - 2 * mpq_class(y)));
    };
    return from(x) <= from(std::nextafter(x, -INFINITY)) &&
           from(x) <= from(std::nextafter(x, INFINITY));
  }
  Vec3 best() const { return truth.normals.front().n; }
  double gap(const Vec3& along) const { return oracle::certified_gap(c, along).midpoint(); }
  /// Of the deepest point.
  double depth() const {
    double deepest = -INFINITY;
    for (const ts_point& p : points()) deepest = std::max(deepest, p.depth);
    return deepest;
  }
  double shallowest() const {
    double result = INFINITY;
    for (const ts_point& p : points()) result = std::min(result, p.depth);
    return result;
  }
  /// How much farther a point is outside a body than its depth.
  double farthest_off() const {
    double result = -INFINITY;
    for (const ts_point& p : points()) {
      const Vec3 at(p.position);
      const double outside =
          std::max(point_distance(c.a, c.pose_a, at), point_distance(c.b, c.pose_b, at));
      result = std::max(result, outside - std::abs(p.depth));
    }
    return result;
  }
  bool is_finite() const {
    return std::isfinite(w.answer.signed_distance) && n.allFinite() &&
           std::ranges::all_of(points(), [](const ts_point& p) {
             return Vec3(p.position).allFinite() && Vec3(p.normal).allFinite() &&
                    std::isfinite(p.depth);
           });
  }
  std::span<const ts_point> points() const {
    return {w.answer.points, static_cast<std::size_t>(w.answer.point_count)};
  }
  double half_of_a() const {
    return support(c.a, Pose(Vec3::Zero(), c.pose_a.orientation()), best());
  }
  Vec3 b_to_a() const { return c.pose_a.position() - c.pose_b.position(); }

  const Wrong& w;
  Configuration c;  ///< of the numbers that the program has
  oracle::Truth truth;
  Vec3 n;
  double rounding;
  double of_place;  ///< of A, which the test moves
};

using Numbers = std::vector<double>;

/// A sentence that a program may print, and what has to hold of its numbers.
struct Sentence {
  const char* pattern;
  std::function<void(const Known& known, const Numbers& said)> check;
};

Vec3 vector_at(const Numbers& said, std::size_t from) {
  return {said[from], said[from + 1], said[from + 2]};
}

void expect_off(const Known& k, const Vec3& at, double from_a, double from_b) {
  const double rounding = k.rounding + 16 * std::numeric_limits<double>::epsilon() * at.norm();
  EXPECT_NEAR(from_a, point_distance(k.c.a, k.c.pose_a, at), rounding);
  EXPECT_NEAR(from_b, point_distance(k.c.b, k.c.pose_b, at), rounding);
}

/// The words after "WRONG: ".
std::string verdict_of(Outcome outcome) {
  if (outcome == Outcome::not_finite) return "not a finite number";
  if (outcome == Outcome::failed) return "the engine ";
  std::string name = outcome_name(outcome);
  std::replace(name.begin(), name.end(), '-', ' ');
  return name + ": ";
}

#define N "([^\\s,()]+)"
#define VECTOR "\\(" N ", " N ", " N "\\)"

/// In order; `k` is what is known, `x` what is said.
const std::vector<Sentence>& sentences() {
  static const std::vector<Sentence> all = {
      {".*: contact, signed distance " N ", normal " VECTOR,
       [](const Known& k, const Numbers& x) {
         EXPECT_EQ(k.w.answer.status, TS_CONTACT);
         for (int i = 0; i < 4; ++i) {
           const double given = i == 0 ? k.w.answer.signed_distance : k.n[i - 1];
           EXPECT_TRUE(x[i] == given || (std::isnan(x[i]) && std::isnan(given)));
         }
       }},
      {".*: no contact",
       [](const Known& k, const Numbers&) { EXPECT_EQ(k.w.answer.status, TS_NONE); }},
      {".*: failed",
       [](const Known& k, const Numbers&) { EXPECT_EQ(k.w.answer.status, TS_FAILED); }},
      {"True: the bodies overlap by " N " \\(signed distance " N "(?: = \\S+)?\\)",
       [](const Known& k, const Numbers& x) {
         EXPECT_LT(k.truth.signed_distance.hi, 0);
         EXPECT_EQ(x[0], -x[1]);
         EXPECT_TRUE(k.is_nearest_to_distance(x[1]));
       }},
      {"True: the bodies touch: they are apart by 0 \\(signed distance 0(?: = \\S+)?\\)",
       [](const Known& k, const Numbers&) { EXPECT_EQ(k.distance(), 0); }},
      {"True: the bodies are apart by " N " \\(signed distance " N "(?: = \\S+)?\\)",
       [](const Known& k, const Numbers& x) {
         EXPECT_GT(k.truth.signed_distance.hi, 0);
         EXPECT_EQ(x[0], x[1]);
         EXPECT_TRUE(k.is_nearest_to_distance(x[1]));
       }},
      {"Proof: take n = " VECTOR "\\.",
       [](const Known& k, const Numbers& x) { EXPECT_EQ(vector_at(x, 0), k.best()); }},
      {"  A's centre is beyond B's along n by  " N,
       [](const Known& k, const Numbers& x) {
         EXPECT_NE(pair_of(k.c), Pair::plane);
         EXPECT_NEAR(x[0], k.b_to_a().dot(k.best()), k.rounding);
       }},
      {"  A's centre is above B's surface by   " N,
       [](const Known& k, const Numbers& x) {
         EXPECT_EQ(pair_of(k.c), Pair::plane);
         EXPECT_NEAR(x[0], point_distance(k.c.b, k.c.pose_b, k.c.pose_a.position()), k.rounding);
       }},
      {"  Half of A's extent along n is        " N,
       [](const Known& k, const Numbers& x) { EXPECT_NEAR(x[0], k.half_of_a(), k.rounding); }},
      {"  Half of B's extent along n is        " N,
       [](const Known& k, const Numbers& x) {
         EXPECT_NEAR(x[0], k.b_to_a().dot(k.best()) - k.distance() - k.half_of_a(), k.rounding);
       }},
      {"  The first less the others? is +" N ", up to rounding",
       [](const Known& k, const Numbers& x) { EXPECT_NEAR(x[0], k.distance(), k.rounding); }},
      {"  A plane across n has A on one side and B on the other, so far apart\\.",
       [](const Known& k, const Numbers&) { EXPECT_GE(k.truth.signed_distance.hi, 0); }},
      {"  Moved by so much along n, A is clear of B: the depth is no more than that\\.",
       [](const Known& k, const Numbers&) {
         const Configuration moved = with_a_moved(k.c, -k.distance() * k.best());
         EXPECT_GE(oracle::truth(moved).signed_distance.midpoint(), -k.rounding - k.of_place);
       }},
      {"  The point " VECTOR "\n  is within A by " N " and within B by " N ":",
       [](const Known& k, const Numbers& x) {
         EXPECT_TRUE(x[3] >= 0 && x[4] >= 0);
         expect_off(k, vector_at(x, 0), -x[3], -x[4]);
       }},
      {"  the bodies overlap, and the depth is no less than " N "\\.",
       [](const Known& k, const Numbers& x) { EXPECT_LE(x[0], -k.distance() + k.rounding); }},
      {"  The depth to 30 digits is what touchstone replay --certify proves\\.",
       [](const Known&, const Numbers&) {}},
      {"Along the engine's normal the clearance is " N ", along n it is " N "\\.",
       [](const Known& k, const Numbers& x) {
         EXPECT_NE(pair_of(k.c), Pair::plane);
         EXPECT_NEAR(x[0], k.gap(k.n), 2 * k.rounding);
         EXPECT_NEAR(x[1], k.distance(), k.rounding);
       }},
      {"Along the engine's normal A's clearance from what of B is beneath it is " N ",",
       [](const Known& k, const Numbers& x) {
         EXPECT_EQ(pair_of(k.c), Pair::plane);
         EXPECT_NEAR(x[0], k.gap(k.n), 2 * k.rounding);
       }},
      {"  along n it is " N "\\.",
       [](const Known& k, const Numbers& x) { EXPECT_NEAR(x[0], k.distance(), k.rounding); }},
      {"  It costs " N " of clearance, a large body being a half-space to a small one\\.",
       [](const Known& k, const Numbers& x) {
         const Score s = score(k.c, k.truth, k.w.answer, Bar{});
         EXPECT_NEAR(x[0], *s.normal_regret * error_size(k.c, Bar{}), 2 * k.rounding);
       }},
      {"Moved by the engine's depth, whichever way, A still overlaps B by " N " or more\\.",
       [](const Known& k, const Numbers& x) {
         for (const Vec3& way : {k.n, k.best(), Vec3(-k.best()), Vec3(0, 0.6, 0.8)}) {
           if (way.isZero(0) || !way.allFinite()) continue;
           const Vec3 by = -k.w.answer.signed_distance * way.normalized();
           const auto moved = oracle::truth(with_a_moved(k.c, by)).signed_distance;
           EXPECT_LE(moved.midpoint(), -x[0] + k.rounding + k.of_place);
         }
       }},
      {"WRONG: missed: no contact where the bodies overlap",
       [](const Known& k, const Numbers&) { EXPECT_LT(k.truth.signed_distance.hi, 0); }},
      {"WRONG: phantom: a contact where the bodies are apart",
       [](const Known& k, const Numbers&) { EXPECT_GT(k.truth.signed_distance.lo, 0); }},
      {"WRONG: shallow: the signed distance is too large",
       [](const Known& k, const Numbers&) {
         EXPECT_GT(k.w.answer.signed_distance, k.truth.signed_distance.hi);
       }},
      {"WRONG: overdeep: the signed distance is too small",
       [](const Known& k, const Numbers&) {
         EXPECT_LT(k.w.answer.signed_distance, k.truth.signed_distance.lo);
       }},
      {"WRONG: wrong normal: along another one the clearance is larger",
       [](const Known& k, const Numbers&) { EXPECT_LT(k.gap(k.n), k.distance()); }},
      {"WRONG: wrong normal: not of length one",
       [](const Known& k, const Numbers&) { EXPECT_GT(std::abs(k.n.norm() - 1), 1e-7); }},
      {"WRONG: no points: there is none",
       [](const Known& k, const Numbers&) { EXPECT_EQ(k.w.answer.point_count, 0); }},
      {"WRONG: shallow points: the largest depth is too small",
       [](const Known& k, const Numbers&) { EXPECT_LT(k.depth(), -k.distance()); }},
      {"WRONG: overdeep points: the largest depth is too large",
       [](const Known& k, const Numbers&) { EXPECT_GT(k.depth(), -k.distance()); }},
      {"WRONG: phantom points: one is beyond the threshold",
       [](const Known& k, const Numbers&) { EXPECT_GT(-k.shallowest(), k.w.bar.threshold); }},
      {"WRONG: off body: a point is farther outside a body than its depth",
       [](const Known& k, const Numbers&) { EXPECT_GT(k.farthest_off(), 0); }},
      {"WRONG: not a finite number",
       [](const Known& k, const Numbers&) { EXPECT_FALSE(k.is_finite()); }},
      {"WRONG: the engine .*",
       [](const Known& k, const Numbers&) { EXPECT_EQ(k.w.answer.status, TS_FAILED); }},
  };
  return all;
}

double number_in(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// Finds the sentence that a text begins with, checks its numbers, and returns what follows.
std::string after_true_sentence(const std::string& text, const Known& known) {
  static const std::vector<std::regex> patterns = [] {
    std::vector<std::regex> result;
    for (const Sentence& s : sentences()) result.emplace_back(std::string(s.pattern) + "\n");
    return result;
  }();
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    std::smatch found;
    if (!std::regex_search(text, found, patterns[i], std::regex_constants::match_continuous)) {
      continue;
    }
    Numbers said;
    for (std::size_t k = 1; k < found.size(); ++k) said.push_back(number_in(found[k]));
    SCOPED_TRACE(found[0].str());
    sentences()[i].check(known, said);
    return found.suffix();
  }
  const std::size_t end = text.find('\n');
  ADD_FAILURE() << "no such sentence is known to be true: " << text.substr(0, end);
  return end == text.npos ? "" : text.substr(end + 1);
}

/// "-6.37e-3" as it is.
mpq_class exact(std::string decimal) {
  long exponent = 0;
  if (const auto e = decimal.find('e'); e != decimal.npos) {
    exponent = std::strtol(decimal.c_str() + e + 1, nullptr, 10);
    decimal.resize(e);
  }
  if (const auto dot = decimal.find('.'); dot != decimal.npos) {
    exponent -= static_cast<long>(decimal.size() - dot - 1);
    decimal.erase(dot, 1);
  }
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
  mpq_class result = mpz_class(decimal, 10);
  return exponent < 0 ? mpq_class(result / power) : mpq_class(result * power);
}

/// What stands above the part that asks: the truth's bounds, and what is allowed.
void expect_true_head(const std::string& program, const Known& k) {
  static const std::regex bounds(
      "True     signed distance between\n\\S+ +(\\S+) and\n\\S+ +(\\S+),\n"),
      bar("What is allowed: (\\S+) of the (smaller half extent|largest length)[^\n]*\n"
          "(?:const )?(?:double )?allowed = ([^;\n]+)");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(program, found, bounds));
  EXPECT_LE(exact(found[1]), k.truth.signed_distance.lo);
  EXPECT_GE(exact(found[2]), k.truth.signed_distance.hi);
  ASSERT_TRUE(std::regex_search(program, found, bar));
  const double share = number_in(found[1]), allowed = number_in(found[3]);
  EXPECT_EQ(allowed, k.w.bar.tolerance * error_size(k.c, k.w.bar));
  const double of_smaller = k.w.bar.tolerance * smaller_size(k.c);
  if (found[2] == "smaller half extent") {
    EXPECT_EQ(share, k.w.bar.tolerance);
    EXPECT_EQ(allowed, of_smaller);
  } else {
    EXPECT_LE(share, k.w.bar.tolerance);
    EXPECT_GT(allowed, of_smaller);
  }
}

/// The two lines of each contact point, which are taken out.
void expect_points(std::string& text, const Known& known) {
  static const std::regex pattern("Point " VECTOR "\n  of depth " N " is " N
                                  " from A's surface and " N " from B's, inside if negative\n");
  const Answer& answer = known.w.answer;
  int count = 0;
  for (std::smatch found; std::regex_search(text, found, pattern); ++count) {
    ASSERT_LT(count, answer.point_count);
    const ts_point& p = answer.points[count];
    const double given[] = {p.position[0], p.position[1], p.position[2], p.depth};
    for (int i = 0; i < 4; ++i) {
      const double said = number_in(found[i + 1]);
      EXPECT_TRUE(said == given[i] || (std::isnan(said) && std::isnan(given[i]))) << found[0];
    }
    if (Vec3(p.position).allFinite()) {
      expect_off(known, Vec3(p.position), number_in(found[5]), number_in(found[6]));
    }
    text = std::string(found.prefix()) + std::string(found.suffix());
  }
  EXPECT_EQ(count, answer.status == TS_CONTACT ? answer.point_count : 0);
}

void expect_true_of(const Engine& engine, std::size_t count) {
  const std::vector<Wrong> wrong = wrong_answers(engine, count);
  EXPECT_EQ(wrong.size(), count);
  std::vector<std::string> programs, heads;
  {
    const WithoutPackages none;
    for (const Wrong& w : wrong) {
      heads.push_back(reproducer(engine.name, engine.language, w.configuration, {}, w.id, w.bar));
      programs.push_back(planted(heads.back(), w, engine.language));
    }
  }
  const std::vector<std::string> printed = printed_by(programs, engine.language);
  ASSERT_EQ(printed.size(), wrong.size());
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    SCOPED_TRACE(
        fmt::format("{} in {}, {}\n{}", engine.name, engine.language, wrong[i].id, printed[i]));
    const Known known(wrong[i]);
    expect_true_head(heads[i], known);
    std::string text = printed[i];
    expect_points(text, known);
    const std::string verdict = text.substr(text.rfind("WRONG: "));
    EXPECT_TRUE(verdict.starts_with("WRONG: " + verdict_of(wrong[i].outcome))) << verdict;
    while (!text.empty()) text = after_true_sentence(text, known);
  }
}

bool is_here(const std::string& candidate) {
  const NpmEngine* const engine = find_npm_engine(candidate);
  if (engine) return npm_obstacle(*engine).empty();
  try {
    find_candidate(candidate);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

TEST(Reproducers, PrintNothingThatTheOracleRefutes) {
  const char* const asked = std::getenv("TOUCHSTONE_COUNT");
  const std::size_t count = asked ? std::strtoul(asked, nullptr, 10) : usual_answers;
  for (std::size_t i = 0; i < (asked ? engines.size() : usual_engines); ++i) {
    if (is_here(engines[i].candidate)) expect_true_of(engines[i], count);
  }
}

}  // namespace
}  // namespace touchstone
