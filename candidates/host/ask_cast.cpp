#include "candidates/host/ask_cast.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <dlfcn.h>
#include <functional>
#include <iterator>
#include <map>
#include <memory>

#include "candidates/cast.h"
#include "candidates/host/contained.hpp"
#include "candidates/host/spoken_command.hpp"

namespace touchstone {
namespace {

/// Of processor time, for many casts; a command has to start first, which may compile itself.
double seconds_of(const Candidate& candidate) { return candidate.command() ? 30 : 5; }

using CastFunction = decltype(&touchstone_cast);

/// Null if the plug-in exports none; called in a process of its own.
CastFunction cast_function(const std::string& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  return library ? reinterpret_cast<CastFunction>(dlsym(library, "touchstone_cast")) : nullptr;
}

/// Whether it has casts, found once.
bool has_casts(const Candidate& candidate) {
  static std::map<std::string, bool> known;
  const auto found = known.find(candidate.family);
  if (found != known.end()) return found->second;
  const Contained answer = run_contained(
      [&] {
        if (const auto* plugin = candidate.plugin()) {
          return std::string(cast_function(plugin->file.string()) ? "yes" : "no");
        }
        const auto* command = candidate.command();
        if (!command) return std::string("no");
        const SpokenCommand spoken(command->line.c_str(), command->folder.c_str());
        return std::string(spoken.description().has_casts ? "yes" : "no");
      },
      seconds_of(candidate));
  return known[candidate.family] = answer.text == "yes";
}

/// None if it has no cast of this.
std::optional<CastAnswer> to_answer(const ts_cast& answer) {
  if (answer.status == TS_CAST_UNSUPPORTED) return std::nullopt;
  const Vec3 normal(answer.normal);
  if (answer.status == TS_CAST_NEVER) return CastAnswer{Cast{CastStatus::never, 1, normal}};
  const bool is_sane = answer.fraction >= 0 && answer.fraction <= 1 && normal.allFinite();
  if (!is_sane) return CastAnswer{{}, "not finite"};
  const CastStatus status = answer.fraction == 0 ? CastStatus::from_start : CastStatus::touch;
  return CastAnswer{Cast{status, answer.fraction, normal}};
}

/// What casts, in a process of its own.
using Caster = std::function<ts_cast(const ts_shape&, const ts_shape&, const messages::Poses&)>;

Caster caster_of(const Candidate& candidate) {
  if (const Candidate::Plugin* const plugin = candidate.plugin()) {
    const CastFunction cast = cast_function(plugin->file.string());
    return
        [=, index = plugin->index](const ts_shape& a, const ts_shape& b, const messages::Poses& p) {
          ts_cast answer{};
          cast(index, &a, &b, &p.a, &p.b, p.previous_normal, &answer);
          return answer;
        };
  }
  const Candidate::Command& given = *candidate.command();
  const auto command = std::make_shared<SpokenCommand>(given.line.c_str(), given.folder.c_str());
  return [=, parameter = candidate.value](const ts_shape& a, const ts_shape& b,
                                          const messages::Poses& p) {
    // No number is how a failure travels to those who judge it.
    return command->cast(a, b, parameter, p).value_or(ts_cast{TS_CAST_TOUCH, NAN, {}});
  };
}

/// The answers' bytes, one after the other.
std::string answers_of(const Candidate& candidate, std::span<const CastQuestion> questions) {
  const Caster cast = caster_of(candidate);
  std::string bytes;
  for (const auto& [c, sweep] : questions) {
    const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
    messages::Poses poses{0, to_ts_pose(c.pose_a), to_ts_pose(c.pose_b), true, {}};
    std::ranges::copy(sweep, poses.previous_normal);
    const ts_cast answer = cast(a, b, poses);
    bytes.append(reinterpret_cast<const char*>(&answer), sizeof answer);
  }
  return bytes;
}

}  // namespace

std::vector<std::optional<CastAnswer>> ask_casts(const Candidate& candidate,
                                                 std::span<const CastQuestion> questions) {
  std::vector<std::optional<CastAnswer>> answers(questions.size());
  if (candidate.name == "reference") {
    for (std::size_t i = 0; i < questions.size(); ++i) {
      answers[i] = CastAnswer{cast(questions[i].configuration, questions[i].sweep)};
    }
    return answers;
  }
  if (questions.empty() || !has_casts(candidate)) return answers;
  const Contained contained =
      run_contained([&] { return answers_of(candidate, questions); }, seconds_of(candidate));
  const bool has_all = contained.end == Contained::End::returned &&
                       contained.text.size() == questions.size() * sizeof(ts_cast);
  if (!has_all && questions.size() == 1) return {CastAnswer{{}, contained.text}};
  if (!has_all) {  // the half with the one that ended it is halved again
    const std::size_t half = questions.size() / 2;
    answers = ask_casts(candidate, questions.first(half));
    std::ranges::move(ask_casts(candidate, questions.subspan(half)), std::back_inserter(answers));
    return answers;
  }
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ts_cast answer{};
    std::memcpy(&answer, contained.text.data() + i * sizeof answer, sizeof answer);
    answers[i] = to_answer(answer);
  }
  return answers;
}

}  // namespace touchstone
