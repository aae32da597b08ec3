/* A plug-in that does not survive being loaded; for a test. */
#include <stdlib.h>

#include "candidates/candidate.h"

__attribute__((constructor)) static void die(void) { abort(); }

const ts_plugin* touchstone_plugin(void) { return 0; }
