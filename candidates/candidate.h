/* A contact routine as Touchstone sees it: the one interface between the harness and every
 * candidate, in C so that any engine can implement it.
 *
 * A plug-in is a shared object that exports `touchstone_plugin`. It is loaded with dlopen in a
 * process of its own, with local symbols, so that it may bring any version of any library; it may
 * crash, hang or throw, which is counted against the configuration that it was asked for.
 *
 * A candidate prepares two shapes once and is then asked for many poses. Body A is the cylinder.
 * Lengths are in metres; poses map body frame to world frame; normals are unit vectors from B to A
 * in the world frame. No function may keep a pointer that it was given. A process has one thread.
 *
 *   cc -shared -fPIC -I PREFIX/include my_engine.c -o my_engine.so -lm
 *   touchstone --candidate ./my_engine.so report */
#ifndef TOUCHSTONE_CANDIDATE_H
#define TOUCHSTONE_CANDIDATE_H

#ifdef __cplusplus
extern "C" {
#endif

/* Of this header. A plug-in made for another version is refused. */
#define TOUCHSTONE_INTERFACE_VERSION 3
#define TOUCHSTONE_MAX_POINTS 16
#define TOUCHSTONE_EXPORT __attribute__((visibility("default")))

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
  TS_FAILED,      /* the candidate itself reports that it could not answer */
  TS_CRASHED,     /* set by Touchstone alone: the candidate's process ended */
  TS_TIMED_OUT    /* set by Touchstone alone: the candidate was ended for taking too long */
} ts_status;

typedef struct ts_answer {
  ts_status status;
  double normal[3];       /* of the deepest point */
  double signed_distance; /* negative inside */
  int point_count;        /* 0 to TOUCHSTONE_MAX_POINTS */
  ts_point points[TOUCHSTONE_MAX_POINTS];
} ts_answer;

/* A number that a family of candidates takes, as 16 in "prism:16". */
typedef struct ts_parameter {
  const char* meaning; /* "number of sides" */
  double least, most;  /* inclusive */
  double usual;        /* of the member that a default report shows */
  int whole;           /* non-zero: only whole numbers */
  int bare;            /* non-zero: the usual member is called by the family's name alone */
} ts_parameter;

/* A pair of shapes made ready by the candidate; only the candidate looks inside. */
typedef struct ts_prepared ts_prepared;

typedef struct ts_candidate {
  const char* name;     /* as on the command line: "bullet"; ASCII, no colon, comma, space */
  const char* version;  /* of the engine: "3.24" */
  const char* settings; /* how it is called: precision, margin, algorithm, conventions */

  /* What stands for the shapes in a simplified model ("capsules for cylinders"); NULL when the
   * shapes are taken as they are. */
  const char* models;

  const ts_parameter* parameter; /* NULL: takes none */

  /* Non-zero when the candidate has a routine for a cylinder against this kind of shape. */
  int (*supports)(ts_shape_kind other);

  /* Makes both shapes ready. `threshold` >= 0: report contacts up to this distance apart.
   * `parameter` is zero without one. Returns NULL when the pair is not supported. */
  ts_prepared* (*prepare)(const ts_shape* a, const ts_shape* b, double threshold, double parameter);

  /* One narrow-phase query; only this is timed. `previous_normal` is a hint: the normal of these
   * bodies' contact in the frame before, unit, world frame, from B to A, or NULL when there was
   * none. It may decide between normals that are equally good to within the threshold and nothing
   * else; a routine without warm start ignores it. The answer depends on nothing else that was
   * queried before. `answer` comes uncleared: set its status, and for TS_CONTACT everything. */
  void (*query)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b,
                const double* previous_normal, ts_answer* answer);

  void (*release)(ts_prepared* prepared);

  /* Of a simplified model: the signed distance of what it models, exact but for rounding, so that
   * the report can tell the model's error from the solver's. NULL, or a NaN: not known. */
  double (*model_distance)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b);
} ts_candidate;

typedef struct ts_plugin {
  int interface_version; /* TOUCHSTONE_INTERFACE_VERSION */
  int count;
  const ts_candidate* candidates; /* `count` of them, in report order */
} ts_plugin;

/* The one symbol that a plug-in exports. What it returns stays valid. */
TOUCHSTONE_EXPORT const ts_plugin* touchstone_plugin(void);

#ifdef __cplusplus
}
#endif

#endif
