/* Casts of a candidate: what a plug-in may export beside `touchstone_plugin` (candidate.h). */
#ifndef TOUCHSTONE_CAST_H
#define TOUCHSTONE_CAST_H

#include "candidate.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ts_cast_status {
  TS_CAST_TOUCH, /* `fraction` and `normal` are set; the fraction is 0 from the start */
  TS_CAST_NEVER,
  TS_CAST_UNSUPPORTED /* this candidate has no casts, or none for this pair */
} ts_cast_status;

typedef struct ts_cast {
  ts_cast_status status;
  double fraction;  /* of the sweep */
  double normal[3]; /* unit, from B to A, world frame, at the touch; zero: the engine says none */
} ts_cast;

/* When does A touch B first while it moves by `sweep` (metres, world frame)? Of the plug-in's
 * candidate of this index. Called once in a process of its own, in which the plug-in has just been
 * loaded and is not forked. */
TOUCHSTONE_EXPORT void touchstone_cast(int candidate, const ts_shape* a, const ts_shape* b,
                                       const ts_pose* pose_a, const ts_pose* pose_b,
                                       const double sweep[3], ts_cast* answer);

#ifdef __cplusplus
}
#endif

#endif
