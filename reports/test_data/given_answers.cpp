#include "reports/test_data/given_answers.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "properties/files/answer_json.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// About a third of a gigabyte in memory.
constexpr std::uint64_t max_answers = 1000000;

constexpr std::size_t max_shown_id = 100;

std::string shown_id(const std::string& id) { return '"' + printable(id, max_shown_id) + '"'; }

/// What is wrong in a line, with its number.
InvalidInput in_line(std::uint64_t number, const InvalidInput& e) {
  return {fmt::format("line {}: {}", number, e.field()), e.value(), e.remedy()};
}

}  // namespace

ConfigurationFile::ConfigurationFile(std::istream& in) {
  JsonLines lines(in);
  while (lines.next()) {
    try {
      const json line = lines.parse();
      require_object(line, "line");
      const std::string id = id_of(line);
      GivenConfiguration given =
          configuration_from_json(line.contains("configuration") ? line["configuration"] : line);
      if (!entries_.try_emplace(id, Entry{entries_.size(), std::move(given)}).second) {
        throw InvalidInput("id", shown_id(id), "must differ from those of the lines before");
      }
    } catch (const InvalidInput& e) {
      throw in_line(lines.number(), e);
    }
  }
}

const ConfigurationFile::Entry* ConfigurationFile::find(const std::string& id) const {
  const auto entry = entries_.find(id);
  return entry == entries_.end() ? nullptr : &entry->second;
}

namespace {

void require_name(const std::string& name, const char* field) {
  const auto plain = [](unsigned char c) { return std::isgraph(c) && c != ':' && c != ','; };
  if (name.empty() || name.size() > max_shown_id || !std::ranges::all_of(name, plain)) {
    throw InvalidInput(field, shown_id(name),
                       fmt::format("must be at most {} characters of printable ASCII without "
                                   "colon, comma and space",
                                   max_shown_id));
  }
}

/// Of a person's file whose body a is our body B: normals, and what is said of each body.
void reverse(GivenAnswer& answer) {
  answer.normal = -answer.normal;
  if (answer.roundings) std::swap((*answer.roundings)[0], (*answer.roundings)[1]);
  for (ts_point& p : answer.points) {
    for (double& x : p.normal) x = -x;
  }
}

GivenAnswer answer_of(const json& line, const std::string& id) {
  refuse_others(line, {"id", "status", "signed_distance", "normal", "points", "roundings"}, "");
  const ts_answer a = answer_from_json(line, "");
  for (int i = 0; i < a.point_count; ++i) {
    refuse_others(line["points"][static_cast<std::size_t>(i)], {"position", "depth", "normal"},
                  fmt::format("points[{}]", i));
  }
  GivenAnswer answer{
      id, 0, {}, a.status, a.signed_distance, Vec3(a.normal), {a.points, a.points + a.point_count},
      {}};
  if (line.contains("roundings")) answer.roundings = numbers<2>(line["roundings"], "roundings");
  return answer;
}

/// Takes the lines of a file of answers one by one.
class AnswerReader {
 public:
  explicit AnswerReader(const Wanted& wanted) : file_(wanted.file) {
    for (const Identity& identity : wanted.identities) missing_.insert(to_string(identity));
    is_closed_ = !missing_.empty();
    if (!file_) return;
    for (const auto& [id, entry] : file_->entries()) missing_.insert(id);
  }

  void take(const json& line, std::uint64_t number) {
    const std::string id = id_of(line);
    GivenAnswer answer = answer_of(line, id);
    const PoseClass cell = place(answer);
    const std::string name =
        answer.configuration ? id : to_string(Identity{cell, *seed_, answer.index});
    if (const auto [first, is_new] = lines_.try_emplace(name, number); !is_new) {
      throw InvalidInput("id", shown_id(id),
                         fmt::format("must be answered once; line {} did", first->second));
    }
    if (lines_.size() > max_answers) {
      throw InvalidInput("id", shown_id(id),
                         fmt::format("must be among the first {}", max_answers));
    }
    missing_.erase(name);
    const auto key = std::pair(cell.pair, cell.name());
    auto& of_cell = cells_.try_emplace(key, GivenAnswers::OfCell{cell, {}}).first->second;
    of_cell.answers.push_back(std::move(answer));
  }

  std::uint64_t count() const { return lines_.size(); }
  std::uint64_t seed() const { return seed_.value_or(1); }
  const std::set<std::string>& missing() const { return missing_; }

  /// In report order: classes of a default report in its order, others by name, what came in a
  /// file.
  std::vector<GivenAnswers::OfCell> cells() {
    std::vector<GivenAnswers::OfCell> result;
    const auto add = [&](auto found) {
      auto& answers = found->second.answers;
      std::sort(answers.begin(), answers.end(),
                [](const GivenAnswer& a, const GivenAnswer& b) { return a.index < b.index; });
      result.push_back(std::move(found->second));
      return cells_.erase(found);
    };
    for (const Pair pair : all_pairs) {
      for (const std::string& name : pose_classes(pair)) {
        if (const auto found = cells_.find({pair, name}); found != cells_.end()) add(found);
      }
      auto given = cells_.extract({pair, given_class(pair).name()});
      for (auto at = cells_.begin(); at != cells_.end() && at->first.first == pair;) at = add(at);
      if (given) add(cells_.insert(std::move(given)).position);
    }
    return result;
  }

 private:
  /// Sets the answer's index and configuration; returns its cell.
  PoseClass place(GivenAnswer& answer) {
    if (const auto* entry = file_ ? file_->find(answer.id) : nullptr) {
      answer.index = entry->number;
      answer.configuration = entry->given.configuration;
      if (entry->given.swapped) reverse(answer);
      return given_class(pair_of(*answer.configuration));
    }
    const Identity identity = identity_of(answer.id);
    if (!seed_) seed_ = identity.seed;
    if (identity.seed != *seed_) {
      throw InvalidInput(
          "id", shown_id(answer.id),
          fmt::format("must have the seed {}, as the first: a report has one", *seed_));
    }
    answer.index = identity.index;
    return identity.pose_class;
  }

  Identity identity_of(const std::string& id) const {
    try {
      Identity identity = parse_identity(id);
      if (!is_closed_ || lines_.contains(to_string(identity)) ||
          missing_.contains(to_string(identity))) {
        return identity;
      }
    } catch (const InvalidInput& e) {
      throw InvalidInput("id", shown_id(id),
                         file_ ? "must be an id of the configurations' file, or an identity"
                               : fmt::format("{}; or name what ids of your own mean by "
                                             "--configurations",
                                             e.field() == "identity" ? e.remedy() : e.what()));
    }
    throw InvalidInput("id", shown_id(id), "must be of the configurations that were asked for");
  }

  const ConfigurationFile* file_;
  bool is_closed_ = false;         ///< only identities that are wanted are known
  std::set<std::string> missing_;  ///< ids that are wanted and not answered yet
  std::optional<std::uint64_t> seed_;
  std::map<std::string, std::uint64_t> lines_;  ///< of what is answered, by name
  std::map<std::pair<Pair, std::string>, GivenAnswers::OfCell> cells_;  ///< by pair and class
};

Candidate described(const GivenDescription& description, const json& header) {
  refuse_others(header, {"candidate", "version", "settings"}, "");
  const auto text = [&](const std::optional<std::string>& option, const char* name) {
    if (option) return *option;
    return header.contains(name) ? string(header[name], name) : std::string();
  };
  const bool is_named = description.name || header.contains("candidate");
  if (!is_named) {
    throw InvalidInput("--name", "missing",
                       "must say whose answers these are, or a first line "
                       "{\"candidate\": …, \"version\": …, \"settings\": …}");
  }
  Candidate result;
  result.name = text(description.name, "candidate");
  require_name(result.name, description.name ? "--name" : "candidate");
  result.family = result.name;
  result.version = text(description.version, "version");
  result.settings = text(description.settings, "settings");
  return result;
}

AnswerError error_of(std::uint64_t line, const InvalidInput& e) {
  return {line, e.field(), error_text(e)};
}

}  // namespace

ReadAnswers read_answers(std::istream& in, const GivenDescription& description,
                         const Wanted& wanted) {
  ReadAnswers result;
  AnswerReader reader(wanted);
  json header = json::object();
  JsonLines lines(in);
  for (bool is_first = true; lines.next(); is_first = false) {
    try {
      const json line = lines.parse();
      require_object(line, "line");
      if (is_first && !line.contains("id")) {
        header = line;
      } else {
        reader.take(line, lines.number());
      }
    } catch (const InvalidInput& e) {
      // It may be the line that says whose answers these are.
      if (is_first && !description.name) throw in_line(lines.number(), e);
      result.errors.push_back(error_of(lines.number(), e));
    }
  }
  try {
    result.answers.candidate = described(description, header);
  } catch (const InvalidInput& e) {
    throw e.field().starts_with("-") ? e : in_line(1, e);
  }
  if (const auto& missing = reader.missing(); !missing.empty()) {
    const std::string value = fmt::format(
        "missing for {}, as {}", counted(missing.size(), "configuration"), *missing.begin());
    result.errors.push_back(error_of(
        0, {"answer", value, "must be given; its status may be \"failed\" or \"unsupported\""}));
  }
  result.count = reader.count();
  result.seed = reader.seed();
  result.answers.cells = reader.cells();
  return result;
}

}  // namespace touchstone
