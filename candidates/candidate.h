/* A contact routine as Touchstone sees it: the one interface between the harness and every
 * candidate, in C so that any engine can implement it.
 *
 * A candidate prepares two shapes once and is then asked for many poses. Body A is the cylinder.
 * Lengths are in metres; poses map body frame to world frame; normals are unit vectors from B to A
 * in the world frame. No function may keep a pointer that it was given. One prepared pair is used
 * by one thread at a time; different pairs may be used by different threads. */
#ifndef TOUCHSTONE_CANDIDATE_H
#define TOUCHSTONE_CANDIDATE_H

#ifdef __cplusplus
extern "C" {
#endif

#define TOUCHSTONE_CANDIDATE_VERSION 1
#define TOUCHSTONE_MAX_POINTS 16

/* Shapes about their own centre; cylinder and capsule along local z. */
typedef enum ts_shape_kind {
  TS_CYLINDER, /* size = radius, half_length */
  TS_PLANE,    /* size = unit normal x, y, z, displacement: solid where normal.x <= displacement */
  TS_SPHERE,   /* size = radius */
  TS_CAPSULE,  /* size = radius, half_length of the segment (the caps come on top) */
  TS_BOX       /* size = half extents x, y, z */
} ts_shape_kind;

typedef struct ts_shape {
  ts_shape_kind kind;
  double size[4]; /* unused entries are zero */
} ts_shape;

typedef struct ts_pose {
  double position[3];
  double orientation[4]; /* unit quaternion w, x, y, z */
} ts_pose;

typedef struct ts_point {
  double position[3]; /* where the candidate puts it; Touchstone's own are halfway */
  double normal[3];   /* unit, from B to A, of this point */
  double depth;       /* positive inside, negative apart */
} ts_point;

typedef enum ts_status {
  TS_CONTACT,     /* normal, signed_distance and points are set */
  TS_NONE,        /* the bodies are further apart than the threshold */
  TS_UNSUPPORTED, /* the candidate has no routine for this pair */
  TS_FAILED       /* the candidate itself reports that it could not answer */
} ts_status;

typedef struct ts_answer {
  ts_status status;
  double normal[3];       /* of the deepest point */
  double signed_distance; /* negative inside */
  int point_count;        /* 0 to TOUCHSTONE_MAX_POINTS */
  ts_point points[TOUCHSTONE_MAX_POINTS];
} ts_answer;

/* A pair of shapes made ready by the candidate; only the candidate looks inside. */
typedef struct ts_prepared ts_prepared;

typedef struct ts_candidate {
  int interface_version; /* TOUCHSTONE_CANDIDATE_VERSION */
  const char* name;      /* as on the command line: "bullet" */
  const char* version;   /* of the engine: "3.24" */
  const char* settings;  /* how it is called: precision, margin, algorithm, conventions */

  /* Non-zero when the candidate has a routine for a cylinder against this kind of shape. */
  int (*supports)(ts_shape_kind other);

  /* Makes both shapes ready. `threshold` >= 0: report contacts up to this distance apart. Returns
   * NULL when the pair is not supported. */
  ts_prepared* (*prepare)(const ts_shape* a, const ts_shape* b, double threshold);

  /* One narrow-phase query. The answer depends on nothing that was queried before. */
  void (*query)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, ts_answer* answer);

  void (*release)(ts_prepared* prepared);
} ts_candidate;

#ifdef __cplusplus
}
#endif

#endif
