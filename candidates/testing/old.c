/* A plug-in of an earlier interface version; for a test. */
#include "candidates/candidate.h"

const ts_plugin* touchstone_plugin(void) {
  static const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION - 1, 0, 0};
  return &plugin;
}
