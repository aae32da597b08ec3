/* Plug-ins that cannot be used, for tests: OLD is of interface version 2, DEADLY ends the
 * process that loads it, OUTSIDE has a name that leads out of a folder, TWINS one name twice. */
#include <stdlib.h>

#include "candidates/candidate.h"

#ifdef OLD
const ts_plugin* touchstone_plugin(void) {
  static const ts_plugin plugin = {2, 0, 0, 0, 0};
  return &plugin;
}
#endif

#if defined(OUTSIDE) || defined(TWINS)
#ifdef OUTSIDE
#define FIRST "../outside"
#else
#define FIRST "twin"
#endif

static int supports(void* context, ts_shape_kind other) {
  (void)context;
  (void)other;
  return 0;
}
static ts_prepared* prepare(void* context, const ts_shape* a, const ts_shape* b, double threshold,
                            double parameter) {
  (void)context;
  (void)a;
  (void)b;
  (void)threshold;
  (void)parameter;
  return 0;
}
static void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b,
                  const double* previous_normal, ts_answer* answer) {
  (void)prepared;
  (void)a;
  (void)b;
  (void)previous_normal;
  (void)answer;
}
static void release(ts_prepared* prepared) { (void)prepared; }

const ts_plugin* touchstone_plugin(void) {
  static const ts_candidate candidates[] = {
      {FIRST, "1", "none", 0, 0, supports, prepare, query, release, 0, 0},
      {"twin", "1", "none", 0, 0, supports, prepare, query, release, 0, 0}};
  static const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 2, candidates, 0, 0};
  return &plugin;
}
#endif

#ifdef DEADLY
__attribute__((constructor)) static void die(void) { abort(); }

const ts_plugin* touchstone_plugin(void) { return 0; }
#endif
