#include "candidates/host/ask_cast.hpp"

#include <cmath>
#include <cstring>
#include <dlfcn.h>
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

Cast to_cast(const ts_cast& answer) {
  const Vec3 normal(answer.normal);
  if (answer.status == TS_CAST_NEVER) return {CastStatus::never, 1, normal};
  const CastStatus status = answer.fraction == 0 ? CastStatus::from_start : CastStatus::touch;
  return {status, answer.fraction, normal};
}

}  // namespace

std::optional<CastAnswer> ask_cast(const Candidate& candidate, const Configuration& c,
                                   const Vec3& sweep) {
  if (candidate.name == "reference") return CastAnswer{cast(c, sweep)};
  const Candidate::Plugin* const plugin = candidate.plugin();
  if (!plugin || !has_casts(plugin->file.string())) return std::nullopt;
  const auto task = [&] {
    const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
    const ts_pose pose_a = to_ts_pose(c.pose_a), pose_b = to_ts_pose(c.pose_b);
    ts_cast answer{};
    cast_function(plugin->file.string())(plugin->index, &a, &b, &pose_a, &pose_b, sweep.data(),
                                         &answer);
    return std::string(reinterpret_cast<const char*>(&answer), sizeof answer);
  };
  const Contained contained = run_contained(task, cast_seconds);
  if (contained.end != Contained::End::returned) return CastAnswer{{}, contained.text};
  ts_cast answer{};
  if (contained.text.size() != sizeof answer) return CastAnswer{{}, "answered something else"};
  std::memcpy(&answer, contained.text.data(), sizeof answer);
  if (answer.status == TS_CAST_UNSUPPORTED) return std::nullopt;
  const bool is_sane =
      answer.fraction >= 0 && answer.fraction <= 1 && Vec3(answer.normal).allFinite();
  if (answer.status == TS_CAST_TOUCH && !is_sane) return CastAnswer{{}, "not finite"};
  return CastAnswer{to_cast(answer)};
}

}  // namespace touchstone
