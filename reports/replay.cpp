#include "reports/replay.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "candidates/readable.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/pages/page.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json with_cast(json examination, const std::optional<CastExamination>& cast) {
  if (cast) {
    examination["cast"] = to_json(*cast);
    examination["configuration"] = to_json(cast->configuration, cast->sweep);
  }
  return examination;
}

}  // namespace

std::string replay_json(const Examination& examination,
                        const std::optional<CastExamination>& cast) {
  return with_cast(to_json(examination), cast).dump() + '\n';
}

double nearest_to_middle(const oracle::Enclosure& e) {
  const mpq_class middle = (e.lo + e.hi) / 2;
  const double inner = middle.get_d();  // towards zero
  const double outer = std::nextafter(inner, middle < 0 ? -INFINITY : INFINITY);
  return abs(middle - inner) <= abs(middle - outer) ? inner : outer;
}

json with_candidates(json data, const std::map<std::string, std::string>& runs) {
  data["program"] = program_name({});
  data["marks"] = json::object();
  for (const auto& [name, how] : runs) {
    const Mark mark = mark_of(name);
    data["marks"][name] = {mark.colour, mark.symbol};
    if (how != "native") data["runs"][name] = how;
    // Needs an option before it is known.
    const std::string program = program_name({name});
    if (data["program"] != program) data["programs"][name] = program;
  }
  return data;
}

std::string replay_page(const Examination& examination, const std::string& description,
                        const std::optional<CastExamination>& cast) {
  json data = with_cast(to_json(examination), cast);
  data["hexadecimal"] = to_hex_json(examination.configuration);
  data["exact"] = to_exact_json(examination.configuration);
  data["description"] = description;
  data["faces"] = faces_json(examination.configuration.b);
  std::map<std::string, std::string> runs;
  for (const ScoredAnswer& answer : examination.answers) {
    runs[answer.candidate] = runs_as(answer.candidate);
  }
  return render_page(Page::replay, with_candidates(std::move(data), runs));
}

namespace {

std::string option_text(const Added& added) {
  return ' ' + added.option + ' ' + shell_quoted(added.value);
}

/// " --candidates a,b" if one of them is asked only when it is named; otherwise the default ones
/// are asked. " --all-candidates" for all that there are: a page has hundreds of these commands.
std::string choice_of(const std::vector<std::string>& candidates) {
  const std::vector<const Candidate*> usual = default_candidates();
  const bool is_special =
      std::any_of(candidates.begin(), candidates.end(), [&](const std::string& name) {
        const Candidate* const known = known_candidate(name);
        return known && std::find(usual.begin(), usual.end(), known) == usual.end();
      });
  if (!is_special) return "";
  if (std::ranges::equal(candidates, all_candidates(), {}, {}, &Candidate::name)) {
    return " --all-candidates";
  }
  std::string names;
  for (const std::string& name : candidates)
    names += (names.empty() ? "" : ",") + shell_quoted(name);
  return " --candidates " + names;
}

}  // namespace

Examination examine(const Subject& subject, std::span<CandidateProcess* const> candidates,
                    const Bar& bar, double width) {
  std::vector<std::string> names;
  for (const CandidateProcess* c : candidates) names.push_back(c->candidate().name);
  Examination result{subject.id.empty() ? subject.name : subject.id,
                     subject.configuration,
                     {},
                     {},
                     replay_command(subject, names)};
  const auto take = [&](const ScoredConfiguration& scored) {
    result.truth = scored.truth;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      result.answers.push_back(
          {candidates[k]->candidate().name, scored.answers[k], scored.scores[k]});
    }
  };
  score_configurations({&subject.configuration, 1}, candidates, bar, width, take);
  return result;
}

namespace {

/// As bash and zsh read what is not seen: $'left\xe2\x80\xaethgir'.
std::string dollar_quoted(const std::string& text) {
  std::string result = "$'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_seen = byte >= 0x20 && byte < 0x7f;
    result += is_seen ? (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c)
                      : fmt::format("\\x{:02x}", byte);
  }
  return result + "'";
}

const char* started_as() { return is_in_clone() ? "./touchstone" : "touchstone"; }

}  // namespace

std::string shell_quoted(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+@", c); };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  if (escaped(text, Printed::one_line) != text) return dollar_quoted(text);
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string program_name() {
  std::string name = started_as();
  for (const Added& added : added_candidates()) name += option_text(added);
  return name;
}

std::string program_name(const std::vector<std::string>& candidates) {
  std::vector<std::string> options;
  for (const std::string& name : candidates) {
    const Candidate* const known = known_candidate(name);
    if (!known || !known->added) continue;
    const std::string option = option_text(*known->added);
    if (std::find(options.begin(), options.end(), option) == options.end()) {
      options.push_back(option);
    }
  }
  return std::accumulate(options.begin(), options.end(), std::string(started_as()));
}

namespace {

std::string piped(const json& line, const std::vector<std::string>& candidates) {
  return "echo '" + line.dump() + "' | " + program_name(candidates) + " replay -";
}

}  // namespace

std::string replay_command(const std::string& name, const std::vector<std::string>& candidates) {
  return program_name(candidates) + " replay " + shell_quoted(name) + choice_of(candidates);
}

std::string replay_command(const Subject& subject, const std::vector<std::string>& candidates) {
  if (subject.name == standard_input_name) {
    return piped(to_hex_json(subject.configuration, subject.sweep), candidates) +
           choice_of(candidates);
  }
  return replay_command(subject.name, candidates) +
         (subject.id.empty() ? "" : " --id " + shell_quoted(subject.id));
}

std::string piped_to_replay(const Configuration& configuration, const std::optional<Vec3>& sweep,
                            const std::vector<std::string>& candidates) {
  return piped(to_hex_json(configuration, sweep ? std::optional(Sweep(*sweep)) : std::nullopt),
               candidates);
}

std::string replay_command(const Configuration& configuration,
                           const std::vector<std::string>& candidates) {
  return piped_to_replay(configuration, {}, candidates) + choice_of(candidates);
}

}  // namespace touchstone
