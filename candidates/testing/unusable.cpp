// Plug-ins that cannot be used, for tests: OLD is of interface version 2, DEADLY ends the process
// that loads it, OUTSIDE has a name that leads out of a folder, TWINS one name twice.
#include <cstdlib>

#include "candidates/candidate.h"

#ifdef OLD
const ts_plugin* touchstone_plugin() {
  static const ts_plugin plugin = {2, 0, nullptr, nullptr, 0, nullptr};
  return &plugin;
}
#endif

#if defined(OUTSIDE) || defined(TWINS)
#ifdef OUTSIDE
#define FIRST "../outside"
#else
#define FIRST "twin"
#endif

const ts_plugin* touchstone_plugin() {
  constexpr auto supports = [](void*, ts_shape_kind) { return 0; };
  constexpr auto prepare = [](void*, const ts_shape*, const ts_shape*, double, double) {
    return static_cast<ts_prepared*>(nullptr);
  };
  constexpr auto query = [](ts_prepared*, const ts_pose*, const ts_pose*, const double*,
                            ts_answer*) {};
  constexpr auto release = [](ts_prepared*) {};
  static const ts_candidate candidates[] = {
      {FIRST, "1", "none", nullptr, nullptr, supports, prepare, query, release, nullptr, nullptr},
      {"twin", "1", "none", nullptr, nullptr, supports, prepare, query, release, nullptr, nullptr}};
  static const ts_plugin plugin = {
      TOUCHSTONE_INTERFACE_VERSION, 2, candidates, nullptr, 0, nullptr};
  return &plugin;
}
#endif

#ifdef DEADLY
__attribute__((constructor)) static void die() { abort(); }

const ts_plugin* touchstone_plugin() { return nullptr; }
#endif
