/* A contact routine as Touchstone sees it: the one interface between the harness and every
 * candidate, in C so that any engine can implement it.
 *
 * A plug-in is a shared object that exports `touchstone_plugin`. It is loaded with dlopen in a
 * process of its own, with local symbols, so that it may use any version of any library. It may
 * crash, hang or throw: that counts as its answer to the current configuration.
 *
 * A candidate prepares two shapes once and is then asked for many poses. Body A is the cylinder.
 * Lengths are in metres; poses map body frame to world frame; normals are unit vectors from B to A
 * in the world frame. No function may keep a pointer that it was given.
 *
 * The process that has loaded the plug-in is forked for every session of questions. Threads do not
 * survive a fork: start none when the plug-in is loaded, but in `after_fork`, or ask to be run
 * unforked. An engine in a language with a runtime of its own is better asked as a command
 * (docs/engine.md).
 *
 *   cc -shared -fPIC -I PREFIX/include my_engine.c -o my_engine.so -lm
 *   touchstone --load ./my_engine.so report */
#ifndef TOUCHSTONE_CANDIDATE_H
#define TOUCHSTONE_CANDIDATE_H

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this header. Plug-ins made for versions 3 and 4, which know no convex bodies and
 * no roundings, load, too, and are not asked about those; others are rejected. */
#define TOUCHSTONE_INTERFACE_VERSION 5
#define TOUCHSTONE_MAX_POINTS 16
#define TOUCHSTONE_EXPORT __attribute__((visibility("default")))

/* Shapes about their own centre, but for the convex one; cylinder and capsule along local z. */
typedef enum ts_shape_kind {
  TS_CYLINDER, /* size = radius, half_length */
  TS_PLANE,    /* size = unit normal x, y, z, displacement: solid where normal.x <= displacement */
  TS_SPHERE,   /* size = radius */
  TS_CAPSULE,  /* size = radius, half_length of the segment (the caps come on top) */
  TS_BOX,      /* size = half extents x, y, z */
  TS_CONVEX    /* the hull of `vertices`, of which each is a corner: a polyhedron, or a polygon in
                  space, as a triangle, with two faces that look in opposite directions */
} ts_shape_kind;

/* Vertices and faces are of a convex body, and else zero. They are there during `prepare` only:
 * copy what you need. */
typedef struct ts_shape {
  ts_shape_kind kind;
  double size[4];         /* unused entries are zero */
  const double* vertices; /* x, y, z of each, in the body frame: not about its origin */
  const int* faces;       /* of each the number of its corners and their indices, which go
                             counterclockwise seen from outside; all of one plane are one face */
  int vertex_count;       /* 3 to 4096 */
  int face_count;
  /* Edges and corners are rounded by a ball of this radius: the body is all points within it of a
   * core, which is a cylinder or a box whose sizes are smaller by it (size has the outer ones, and
   * it is at most the smallest), or the hull. Zero but where ts_plugin.roundings is set. */
  double rounding;
} ts_shape;

typedef struct ts_pose {
  double position[3];
  double orientation[4]; /* unit quaternion w, x, y, z */
} ts_pose;

typedef struct ts_point {
  double position[3]; /* by the candidate's convention; Touchstone's are halfway */
  double normal[3];   /* unit, from B to A, of this point */
  double depth;       /* positive inside, negative apart */
} ts_point;

typedef enum ts_status {
  TS_CONTACT,     /* normal, signed_distance and points are set */
  TS_NONE,        /* the bodies are further apart than the threshold */
  TS_UNSUPPORTED, /* the candidate has no routine for this pair */
  TS_FAILED,      /* the candidate reports that it could not answer */
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
  double usual;        /* value of the member that a default report shows */
  int whole;           /* non-zero: whole numbers only */
  int bare;            /* non-zero: the usual member has the family's name alone */
} ts_parameter;

/* A prepared pair of shapes, opaque to Touchstone. */
typedef struct ts_prepared ts_prepared;

typedef struct ts_candidate {
  const char* name;     /* as on the command line: "bullet"; ASCII, no colon, comma, slash, space */
  const char* version;  /* of the engine: "3.24" */
  const char* settings; /* how it is called: precision, margin, algorithm, conventions */

  /* What replaces the shapes in a simplified model ("capsules for cylinders"); NULL if the shapes
   * are used as they are. */
  const char* models;

  const ts_parameter* parameter; /* NULL: takes none */

  /* Non-zero if the candidate has a routine for a cylinder against this kind of shape. */
  int (*supports)(void* context, ts_shape_kind other);

  /* Prepares both shapes. Contacts up to `threshold` >= 0 apart are to be reported. `parameter` is
   * zero for a candidate without one. Returns NULL if the pair is not supported. */
  ts_prepared* (*prepare)(void* context, const ts_shape* a, const ts_shape* b, double threshold,
                          double parameter);

  /* One narrow-phase query; only this is timed. `previous_normal` is a hint: the normal of these
   * bodies' contact in the previous frame (unit, world frame, from B to A), or NULL if there was no
   * contact. It may only decide between normals whose gaps are equal to within the threshold; a
   * routine without warm start ignores it. The answer must not depend on earlier queries otherwise.
   * `answer` is not cleared: set its status, and for TS_CONTACT everything. */
  void (*query)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b,
                const double* previous_normal, ts_answer* answer);

  void (*release)(ts_prepared* prepared);

  /* For a simplified model: the signed distance of the model, exact up to rounding, so that the
   * report can separate the model's error from the solver's. NULL, or a NaN: unknown. */
  double (*model_distance)(ts_prepared* prepared, const ts_pose* a, const ts_pose* b);

  void* context; /* given to supports and prepare as it stands here; NULL if they need nothing */
} ts_candidate;

typedef struct ts_plugin {
  int interface_version; /* TOUCHSTONE_INTERFACE_VERSION */
  int count;
  const ts_candidate* candidates; /* `count` of them, in report order */

  /* Called once in every session's process before any question, for what does not survive a fork,
   * such as threads. NULL: nothing to do. */
  void (*after_fork)(void);

  /* Non-zero: is never forked. Every session then is a process that has loaded the plug-in anew,
   * which takes as long as loading does. */
  int unforked;

  /* Of version 5. Writes by which radii the engine rounds the two bodies that it was given: what it
   * models is these bodies with such a rounding (ts_shape), so that the report can separate the
   * model's error from the solver's. NULL: the candidates know no rounding, and are not asked about
   * shapes that have one. */
  void (*roundings)(const ts_prepared* prepared, double* of_a, double* of_b);
} ts_plugin;

/* The only symbol that a plug-in exports. The result stays valid. */
TOUCHSTONE_EXPORT const ts_plugin* touchstone_plugin(void);

#ifdef __cplusplus
}
#endif

#endif
