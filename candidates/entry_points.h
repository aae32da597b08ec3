/* The candidates built into the program: each file's one entry point. */
#ifndef TOUCHSTONE_ENTRY_POINTS_H
#define TOUCHSTONE_ENTRY_POINTS_H

#include "candidates/candidate.h"

#ifdef __cplusplus
extern "C" {
#endif

const ts_candidate* touchstone_reference(void);
const ts_candidate* touchstone_bullet(void);
const ts_candidate* touchstone_ode(void);

#ifdef __cplusplus
}
#endif

#endif
