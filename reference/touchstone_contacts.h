/* Contacts of cylinders for programs in C, and for languages that call C. The questions are those
 * of touchstone.hpp: body A is a cylinder; lengths are in metres; poses map body frame to world
 * frame; normals are unit vectors from B to A, the way A moves to come free. No function keeps
 * anything, so that threads may ask at once.
 *
 *   cc program.c -ltouchstone_reference -lstdc++ -lm */
#ifndef TOUCHSTONE_CONTACTS_H
#define TOUCHSTONE_CONTACTS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TOUCHSTONE_CONTACT_MAX_POINTS 8

/* Shapes about their own centre; cylinder and capsule along local z. Convex bodies are left out: a
 * Convex (shape.hpp) is made of its faces, too, which only exact arithmetic finds for certain. */
typedef enum touchstone_shape_kind {
  TOUCHSTONE_CYLINDER, /* size = radius, half length */
  TOUCHSTONE_PLANE,  /* size = normal x, y, z, displacement: solid where normal.x <= displacement */
  TOUCHSTONE_SPHERE, /* size = radius */
  TOUCHSTONE_CAPSULE, /* size = radius, half length of the segment (the caps come on top) */
  TOUCHSTONE_BOX      /* size = half extents x, y, z */
} touchstone_shape_kind;

typedef struct touchstone_body {
  touchstone_shape_kind kind;
  double size[4];
  double position[3];
  double orientation[4]; /* quaternion w, x, y, z of any length but zero */
} touchstone_body;

typedef struct touchstone_contact_point {
  double position[3]; /* halfway between the surfaces along the normal */
  double depth;       /* positive inside, negative apart */
} touchstone_contact_point;

typedef struct touchstone_contact {
  double normal[3];
  double signed_distance; /* positive apart, negative inside */
  int point_count;        /* 0 where the bodies are further apart than the threshold */
  touchstone_contact_point points[TOUCHSTONE_CONTACT_MAX_POINTS];
} touchstone_contact;

/* Each returns 0 and writes the answer; or 1, and writes nothing, if A is no cylinder, a length is
 * not positive and finite, or a pose is not finite or has no orientation. */

/* Normal, signed distance and points where the distance is at most `threshold`; else no points, and
 * the clearance along some direction that proves it larger. */
int touchstone_find_contact(const touchstone_body* a, const touchstone_body* b, double threshold,
                            touchstone_contact* contact);

/* The exact signed distance and its normal, however far apart the bodies are. */
int touchstone_find_signed_distance(const touchstone_body* a, const touchstone_body* b,
                                    double* signed_distance, double normal[3]);

/* 1 if the bodies share a point, else 0. */
int touchstone_find_overlap(const touchstone_body* a, const touchstone_body* b, int* overlap);

/* The same of many poses of one pair of bodies, as a broad phase finds them, which takes less time
 * than one by one (batch.hpp). Poses and answers are arrays of `count`, which may be 0; the poses
 * of the bodies themselves do not count. Each returns 0 and writes all answers, with the bits of
 * those above; or 1, and writes nothing, if a body or any pose is invalid. */

typedef struct touchstone_pose {
  double position[3];
  double orientation[4]; /* quaternion w, x, y, z of any length but zero */
} touchstone_pose;

typedef struct touchstone_distance {
  double value; /* positive apart, negative inside */
  double normal[3];
} touchstone_distance;

int touchstone_find_contacts(const touchstone_body* a, const touchstone_pose* poses_a,
                             const touchstone_body* b, const touchstone_pose* poses_b, size_t count,
                             double threshold, touchstone_contact* contacts);
int touchstone_find_signed_distances(const touchstone_body* a, const touchstone_pose* poses_a,
                                     const touchstone_body* b, const touchstone_pose* poses_b,
                                     size_t count, touchstone_distance* distances);
int touchstone_find_overlaps(const touchstone_body* a, const touchstone_pose* poses_a,
                             const touchstone_body* b, const touchstone_pose* poses_b, size_t count,
                             int* overlaps);

/* When A touches B first while it moves by `sweep` (metres, world); cast.hpp says how exactly. */

typedef enum touchstone_cast_status {
  TOUCHSTONE_CAST_TOUCH,     /* at `fraction` of the sweep */
  TOUCHSTONE_CAST_NEVER,     /* `fraction` is 1 */
  TOUCHSTONE_CAST_FROM_START /* `fraction` is 0 */
} touchstone_cast_status;

typedef struct touchstone_cast {
  touchstone_cast_status status;
  double fraction;
  double normal[3];
} touchstone_cast;

int touchstone_find_cast(const touchstone_body* a, const double sweep[3], const touchstone_body* b,
                         touchstone_cast* cast);
/* Of many poses: sweeps[3 i] to sweeps[3 i + 2] are the i-th. */
int touchstone_find_casts(const touchstone_body* a, const touchstone_pose* poses_a,
                          const double* sweeps, const touchstone_body* b,
                          const touchstone_pose* poses_b, size_t count, touchstone_cast* casts);

/* Contacts for programs that keep poses in float. Answers are found in double, for the bodies as
 * they are given, and rounded (single_precision.hpp). */

typedef struct touchstone_float_pose {
  float position[3];
  float orientation[4];
} touchstone_float_pose;

typedef struct touchstone_float_distance {
  float value;
  float normal[3];
} touchstone_float_distance;

typedef struct touchstone_float_contact_point {
  float position[3];
  float depth;
} touchstone_float_contact_point;

typedef struct touchstone_float_contact {
  float normal[3];
  float signed_distance;
  int point_count;
  touchstone_float_contact_point points[TOUCHSTONE_CONTACT_MAX_POINTS];
} touchstone_float_contact;

int touchstone_find_float_contacts(const touchstone_body* a, const touchstone_float_pose* poses_a,
                                   const touchstone_body* b, const touchstone_float_pose* poses_b,
                                   size_t count, float threshold,
                                   touchstone_float_contact* contacts);
int touchstone_find_float_signed_distances(const touchstone_body* a,
                                           const touchstone_float_pose* poses_a,
                                           const touchstone_body* b,
                                           const touchstone_float_pose* poses_b, size_t count,
                                           touchstone_float_distance* distances);
int touchstone_find_float_overlaps(const touchstone_body* a, const touchstone_float_pose* poses_a,
                                   const touchstone_body* b, const touchstone_float_pose* poses_b,
                                   size_t count, int* overlaps);

#ifdef __cplusplus
}
#endif

#endif
