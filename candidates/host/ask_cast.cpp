#include "candidates/host/ask_cast.hpp"

#include <algorithm>
#include <cstring>
#include <dlfcn.h>
#include <iterator>
#include <map>

#include "candidates/cast.h"
#include "candidates/host/contained.hpp"

namespace touchstone {
namespace {

constexpr double cast_seconds = 5;

using CastFunction = decltype(&touchstone_cast);

/// Null if the plug-in exports none; called in a process of its own.
CastFunction cast_function(const std::string& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  return library ? reinterpret_cast<CastFunction>(dlsym(library, "touchstone_cast")) : nullptr;
}

/// Whether a plug-in exports casts, found once.
bool has_casts(const std::string& file) {
  static std::map<std::string, bool> known;
  const auto found = known.find(file);
  if (found != known.end()) return found->second;
  const Contained answer =
      run_contained([&] { return std::string(cast_function(file) ? "yes" : "no"); }, cast_seconds);
  return known[file] = answer.text == "yes";
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

/// The answers' bytes, one after the other.
std::string answers_of(const Candidate::Plugin& plugin, std::span<const CastQuestion> questions) {
  const CastFunction cast = cast_function(plugin.file.string());
  std::string bytes;
  for (const auto& [c, sweep] : questions) {
    const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
    const ts_pose pose_a = to_ts_pose(c.pose_a), pose_b = to_ts_pose(c.pose_b);
    ts_cast answer{};
    cast(plugin.index, &a, &b, &pose_a, &pose_b, sweep.data(), &answer);
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
  const Candidate::Plugin* const plugin = candidate.plugin();
  if (questions.empty() || !plugin || !has_casts(plugin->file.string())) return answers;
  const Contained contained =
      run_contained([&] { return answers_of(*plugin, questions); }, cast_seconds);
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
