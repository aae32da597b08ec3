/* Plug-ins that cannot be used, for tests: OLD is of interface version 2, DEADLY ends the
 * process that loads it. */
#include <stdlib.h>

#include "candidates/candidate.h"

#ifdef OLD
const ts_plugin* touchstone_plugin(void) {
  static const ts_plugin plugin = {2, 0, 0, 0, 0};
  return &plugin;
}
#endif

#ifdef DEADLY
__attribute__((constructor)) static void die(void) { abort(); }

const ts_plugin* touchstone_plugin(void) { return 0; }
#endif
