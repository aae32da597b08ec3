// Every reader of what people write meets damaged input: true input, changed by Mutation. It must
// end in an answer or in InvalidInput, and in nothing else: no other exception, no crash, no hang,
// no NaN. What a reader accepts goes on to whatever is done with it next.
//
// TOUCHSTONE_COUNT sets how many inputs all readers are given together; by default, for CI, 4000.
// An input is named by reader and number; a crash or hang prints it before the program ends.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/own_folder_test.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/laws/failure_file.hpp"
#include "reference/contact_of.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaigns/made_up_test.hpp"
#include "reports/compare.hpp"
#include "reports/make_report.hpp"
#include "reports/report_json.hpp"
#include "reports/solve.hpp"
#include "reports/terminal.hpp"
#include "reports/test_data/given_answers.hpp"
#include "simulation/scenes/robot_file.hpp"
#include "simulation/scenes/scene_file.hpp"
#include "simulation/world.hpp"
#include "verification/damaged_input/mutation.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::uint64_t whole_count() {
  const char* text = std::getenv("TOUCHSTONE_COUNT");
  return text ? std::strtoull(text, nullptr, 10) : 4000;
}

std::vector<std::string> files_of(const std::filesystem::path& folder, const char* ending) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ending) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) texts.push_back(read_file(file, "file"));
  return texts;
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream in(read_file(file, "file"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What is being read, for the last words of a process that crashes or hangs. On standard output:
// standard error may be captured.
std::string current_name, current_text;

void tell_and_end(int signal) {
  for (const std::string* text : {&current_name, &current_text}) {
    if (write(STDOUT_FILENO, text->data(), text->size()) < 0) break;
    if (write(STDOUT_FILENO, "\n", 1) < 0) break;
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// More than any of the inputs takes, sanitizers included, seconds.
constexpr unsigned longest_read = 60;

/// Gives a reader its share (in percent) of the inputs; `read` is told the number of the input too.
template <class Read>
void expect_answer_or_refusal(const char* reader, double share,
                              const std::vector<std::string>& true_inputs, const Read& read) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS, SIGALRM}) {
    std::signal(signal, tell_and_end);
  }
  ASSERT_FALSE(true_inputs.empty());
  for (const std::string& text : true_inputs) {
    current_text = text;
    EXPECT_NO_THROW(read(text, 0)) << reader << " refuses true input: " << printable(text, 2000);
  }
  const auto count = std::max<std::uint64_t>(
      8, static_cast<std::uint64_t>(static_cast<double>(whole_count()) * share / 100));
  std::uint64_t refused = 0, failed = 0;
  for (std::uint64_t i = 1; i <= count && failed < 10; ++i) {
    Mutation mutation(i);
    current_text = mutation.of(true_inputs[i % true_inputs.size()]);
    current_name = std::string(reader) + ' ' + std::to_string(i);
    alarm(longest_read);
    try {
      read(current_text, i);
    } catch (const InvalidInput& e) {
      ++refused;
      constexpr std::size_t longest_message = 12000;
      EXPECT_LE(error_text(e).size(), longest_message) << current_name;
    } catch (const std::exception& e) {
      ++failed;
      ADD_FAILURE() << current_name << ": " << e.what() << "\n" << printable(current_text, 3000);
    }
    alarm(0);
  }
  std::printf("%-16s %8llu inputs, %8llu refused\n", reader, static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(refused));
  EXPECT_GT(refused, 0U) << "nothing is damaged";
  EXPECT_LT(refused, count) << "nothing is accepted";
}

/// Throws where a number is none: JSON has null for it, and text its name.
void require_numbers(const json& value) {
  if (value.is_number_float() && std::isnan(value.get<double>())) throw std::runtime_error("NaN");
  if (!value.is_structured()) return;
  for (const json& element : value) require_numbers(element);
}

/// A name that holds it is shown as it was given.
bool shows_nan(const std::string& shown, const std::string& given) {
  return shown.find("nan") != std::string::npos && given.find("nan") == std::string::npos;
}

std::vector<std::string> configuration_lines() {
  std::vector<std::string> lines;
  for (const Pair pair : all_pairs) {
    for (const auto& name : pose_classes(pair)) {
      const Configuration c = make_configuration({pair, name, 1, 0});
      lines.push_back((lines.size() % 2 == 0 ? to_json(c) : to_hex_json(c)).dump());
    }
  }
  for (const char* way : {R"("axis":"y")", R"("axis":[1e-300,"0x1p-3",-2])",
                          R"("rotation":[[0.6,-0.8,0],[0.8,0.6,0],[0,0,1]])"}) {
    lines.push_back(
        R"({"id":null,"a":{"shape":"cylinder","radius":1,"half_length":2,"rounding":0.5},"pose_a":{)" +
        std::string(way) + R"(},"b":{"shape":"sphere","radius":1}})");
  }
  lines.push_back(R"({"a":{"shape":"sphere","radius":1},"sweep":[1,"0x1p-3",-2],)"
                  R"("b":{"shape":"cylinder","radius":1,"half_length":2}})");
  lines.push_back(R"({"a":{"shape":"cylinder","radius":1,"half_length":2},"sweep":[1,2,3],)"
                  R"("spin":[1e-300,0,-0.5],"b":{"shape":"sphere","radius":1}})");
  return lines;
}

TEST(HostileInput, LinesOfSolve) {
  expect_answer_or_refusal(
      "solve", 34, configuration_lines(), [](const std::string& text, std::uint64_t) {
        const auto given = cast_from_json(parse_json(text, "line"));
        if (text.find('\0') != text.npos) throw std::runtime_error("a NUL is accepted");
        const json all = to_hex_json(given.configuration, given.sweep);
        for (const json& written : {to_json(given.configuration, given.sweep), all}) {
          const auto again = cast_from_json(parse_json(written.dump(), "it"));
          if (to_hex_json(again.configuration, again.sweep) != all) {
            throw std::runtime_error("what is written is read as something else");
          }
        }
      });
}

TEST(HostileInput, WholeFilesOfSolve) {
  // Of the pairs whose truth takes a few microseconds.
  std::string file;
  for (const Pair pair : {Pair::sphere, Pair::plane}) {
    for (const char* name : {"general-deep", "general-shallow", "touching"}) {
      file += to_json(make_configuration({pair, name, 1, 0})).dump() + '\n';
    }
    file += json{{"weight", 3},
                 {"configuration", to_json(make_configuration({pair, "touching", 1, 1}))}}
                .dump() +
            '\n';
  }
  expect_answer_or_refusal("solve, whole", 3, {file}, [](const std::string& text, std::uint64_t) {
    std::istringstream in(text), lines(text);
    std::stringstream out;
    const bool good = solve(in, out, {{}, 1e-9, Bar(), false, {}});
    std::size_t expected = 0, answered = 0;
    for (std::string line; std::getline(lines, line);) {
      expected += line.find_first_not_of(" \t\r") != std::string::npos ? 1 : 0;
    }
    for (std::string line; std::getline(out, line); ++answered) require_numbers(json::parse(line));
    if (answered != expected) throw std::runtime_error("not one answer a line");
    if (!good) throw InvalidInput("line", "bad", "was answered with an error");
  });
}

TEST(HostileInput, FilesOfAnswers) {
  const std::string file =
      R"({"candidate":"gpu","version":"2","settings":"float"})"
      "\n"
      R"({"id":"cylinder-sphere/touching/1/0","status":"contact","signed_distance":-0.1,)"
      R"("normal":[0,0,1],"points":[{"position":[0,"nan",null],"normal":[0,0,1],"depth":0.1}]})"
      "\n"
      R"({"id":"cylinder-plane/general-deep/1/3","status":"none"})"
      "\n"
      R"({"id":"cylinder-plane/touching/1/1","status":"failed"})"
      "\n";
  expect_answer_or_refusal("answers", 6, {file}, [](const std::string& text, std::uint64_t) {
    std::istringstream in(text);
    const ReadAnswers read_ones = read_answers(in, {}, {});
    std::uint64_t count = 0;
    for (const auto& of_cell : read_ones.answers.cells) count += of_cell.answers.size();
    if (count != read_ones.count) throw std::runtime_error("not one answer a good line");
    if (!read_ones.errors.empty()) throw InvalidInput("line", "bad", "was told");
  });
}

TEST(HostileInput, ConfigurationFiles) {
  std::vector<std::string> files = lines_of(TOUCHSTONE_KNOWN_FAILURES);
  const auto lines = configuration_lines();
  files.push_back(lines[0] + '\n');
  files.push_back("\n" + lines[2]);
  expect_answer_or_refusal("given file", 10, files, [](const std::string& text, std::uint64_t) {
    configuration_from_text(text, "file");
  });
}

TEST(HostileInput, Identities) {
  const std::vector<std::string> names = {"cylinder-box/near-parallel-1e-6/42/137",
                                          "cylinder-plane/standing/1/0",
                                          "cylinder-box/side-on-face/1/0@1e-8/1/4",
                                          "cylinder-sphere/cap/1/2@1e-8/1/4@1e-16/5/6",
                                          "map/standing/1e-12/-3/16",
                                          "sequence/roll-over-edge/113/400"};
  expect_answer_or_refusal("identity", 12, names, [](const std::string& text, std::uint64_t) {
    if (text == "-") return;  // standard input
    to_json(given_configuration(text).configuration);
  });
}

TEST(HostileInput, SavedFailures) {
  expect_answer_or_refusal("failure file", 8, lines_of(TOUCHSTONE_KNOWN_FAILURES),
                           [](const std::string& text, std::uint64_t) {
                             to_json(failure_from_json(parse_json(text, "file")));
                           });
}

/// Our own contacts in this process.
class DirectModel : public ContactModel {
 public:
  void begin() override {}
  std::vector<Answer> answers(std::span<const PairQuestion> questions) override {
    std::vector<Answer> result;
    for (const PairQuestion& q : questions) {
      const Contact c = contact(q.configuration, simulation_threshold);
      Answer& answer = result.emplace_back();
      answer.status = c.points().empty() ? TS_NONE : TS_CONTACT;
      answer.signed_distance = c.signed_distance;
      for (int k = 0; k < 3; ++k) answer.normal[k] = c.normal[k];
      for (const ContactPoint& p : c.points()) {
        ts_point& point = answer.points[answer.point_count++];
        point.depth = p.depth;
        for (int k = 0; k < 3; ++k)
          point.position[k] = p.position[k], point.normal[k] = c.normal[k];
      }
    }
    return result;
  }
};

/// A few steps: ODE ends the process where it is given what it cannot take.
void step_through(const SceneFile& file) {
  DirectModel model;
  World world(file.scene, model);
  for (int i = 0; i < 3; ++i) {
    world.step();
    if (std::isnan(world.kinetic_energy()) && world.sound()) throw std::runtime_error("NaN");
  }
}

/// Every member that a scene can have, in few numbers.
const char* const dense_scene = R"({"duration":1,"step":0.01,"gravity":[0,0,-10],
  "surface_layer":0.001,"materials":{"steel":{"density":7800,"friction":0.4,"restitution":0.1}},
  "bodies":[
    {"name":"ground","shape":{"shape":"plane","normal":[0,0,1],"displacement":0},"fixed":true},
    {"name":"can","shape":{"shape":"cylinder","radius":1,"half_length":1},"material":"steel",
     "pose":{"position":[0,0,1],"orientation":[1,0,0,0]},"velocity":[1,0,0],
     "angular_velocity":[0,0,1]},
    {"name":"box","shape":{"shape":"box","half_extents":[1,1,1]},"pose":{"position":[0,3,1]},
     "angular_velocity":[1,0,0]}],
  "needs":[{"need":"stands","body":"can","degrees":1,"from":0,"until":1}],
  "camera":{"position":[9,9,9],"look_at":[0,0,0]}})";

TEST(HostileInput, Scenes) {
  std::vector<std::string> scenes = files_of(TOUCHSTONE_SCENES, ".json");
  scenes.insert(scenes.end(), scenes.size(), dense_scene);  // half of all
  expect_answer_or_refusal("scene", 16, scenes, [](const std::string& text, std::uint64_t) {
    const SceneFile file = scene_from_text(text, "scene.json");
    for (const auto& need : file.needs) need->text(file.scene);
    if (!file.camera.position.allFinite()) throw std::runtime_error("a camera nowhere");
    step_through(file);
  });
}

TEST(HostileInput, Reports) {
  Campaign c;
  c.pairs = {Pair::plane};
  c.classes = {"lying", "standing"};
  c.candidates = find_candidates({"reference", "capsule"});
  c.count = 2;
  const Report report = make_report(c, "x");
  CompareLimits limits;
  limits.baseline = "capsule";
  expect_answer_or_refusal("report.json", 3, {to_json(report).dump(1)},
                           [&](const std::string& text, std::uint64_t) {
                             const Report read = report_from_text(text, "file");
                             for (const Comparison& comparison :
                                  {compare(report, read, limits), compare(read, report, limits)}) {
                               require_numbers(json::parse(comparison_json(comparison)));
                               if (shows_nan(comparison_text(comparison), text)) {
                                 throw std::runtime_error("nan is printed");
                               }
                             }
                           });
}

std::string shard_text(const Shard& shard) {
  const json plan = made_up_plan(600);
  return to_text(made_up_part(plan, shard, Shard{}.units(plan_from_json(plan).cut)));
}

TEST(HostileInput, ShardFiles) {
  const std::vector<std::string> texts = {shard_text({1, 1}), shard_text({2, 2})};
  // Of three in four the first line is changed, and the checksum then right: else nothing but that
  // is read.
  const auto changed = [&](std::uint64_t number) {
    const std::string& whole = texts[number % texts.size()];
    const std::size_t line_end = whole.find('\n'), checksum_at = whole.size() - 9;
    const std::string body = Mutation(number).of(whole.substr(0, line_end)) +
                             whole.substr(line_end, checksum_at - line_end);
    return body + checksum(body) + '\n';
  };
  expect_answer_or_refusal("shard file", 6, texts,
                           [&](const std::string& text, std::uint64_t number) {
                             current_text = number % 4 == 0 ? text : changed(number);
                             Merge merge;
                             merge.add(shard_from_text(current_text, "file"), "file");
                             const ShardState merged = merge.whole(true);
                             require_numbers(json::parse(campaign_json(merged)));
                             if (shows_nan(terminal_table(campaign_result(merged)), current_text)) {
                               throw std::runtime_error("nan");
                             }
                           });
}

TEST(HostileInput, NumbersOfOptions) {
  const std::vector<std::string> texts = {"1000",     "1e6",   "0.25", "-1.5e-3",
                                          "0x1.8p-1", "1e-30", "18"};
  const NumberRange range{-1e30, 1e30};
  expect_answer_or_refusal("option", 6, texts, [&](const std::string& text, std::uint64_t number) {
    if (number % 3 == 1) {
      read_count("--count", text, {0, 1000000000});
      return;
    }
    if (number % 3 == 2) {
      parse_shard(text);
      return;
    }
    const double value = read_number("--width", text, range);
    if (!(std::abs(value) <= 1e30)) throw std::runtime_error("out of range");
    if (value != std::strtod(text.c_str(), nullptr)) throw std::runtime_error("another number");
  });
}

/// A robot is read, and its scene simulated for a few steps. Nothing is printed, whatever a library
/// has to say.
void simulate_robot(const std::filesystem::path& file) {
  testing::internal::CaptureStderr();
  std::exception_ptr refused;
  try {
    const std::filesystem::path models = std::filesystem::path(TOUCHSTONE_SCENES) / "models";
    step_through(robot_scene(read_robot(file, {models}), {}));
  } catch (...) {
    refused = std::current_exception();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  if (refused) std::rethrow_exception(refused);
}

void expect_answer_or_refusal_of_robots(const char* name, double share, const char* ending) {
  const OwnFolder folder;
  expect_answer_or_refusal(name, share, files_of(TOUCHSTONE_SCENES, ending),
                           [&](const std::string& text, std::uint64_t) {
                             simulate_robot(folder.with(std::string("robot") + ending, text));
                           });
}

TEST(HostileInput, Urdf) { expect_answer_or_refusal_of_robots("URDF", 1.8, ".urdf"); }
TEST(HostileInput, Sdf) { expect_answer_or_refusal_of_robots("SDF", 0.2, ".sdf"); }
TEST(HostileInput, Mjcf) { expect_answer_or_refusal_of_robots("MJCF", 0.5, ".xml"); }

TEST(HostileInput, Meshes) {
  const std::filesystem::path models = std::filesystem::path(TOUCHSTONE_SCENES) / "models";
  const OwnFolder folder;
  for (const auto& [ending, package] :
       {std::pair{".stl", "arm_description"}, {".dae", "arm_description"}, {".obj", "cart"}}) {
    expect_answer_or_refusal(
        ending, 0.4, files_of(models / package / "meshes", ending),
        [&](const std::string& text, std::uint64_t) {
          const std::string mesh = folder.with(std::string("mesh") + ending, text).string();
          simulate_robot(folder.with("robot.urdf",
                                     "<robot name='r'><link name='l'><collision><geometry><mesh "
                                     "filename='" +
                                         mesh + "'/></geometry></collision></link></robot>"));
        });
  }
}

}  // namespace
}  // namespace touchstone
