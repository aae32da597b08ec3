/* Contacts of cylinders for programs in C, and for languages that call C. The questions are those
 * of touchstone.hpp: body A is a cylinder; lengths are in metres; poses map body frame to world
 * frame; normals are unit vectors from B to A, the way A moves to come free. No function keeps
 * anything, so that threads may ask at once.
 *
 *   cc program.c -ltouchstone_reference -lstdc++ -lm */
#ifndef TOUCHSTONE_CONTACTS_H
#define TOUCHSTONE_CONTACTS_H

#ifdef __cplusplus
extern "C" {
#endif

#define TOUCHSTONE_CONTACT_MAX_POINTS 8

/* Shapes about their own centre; cylinder and capsule along local z. */
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

#ifdef __cplusplus
}
#endif

#endif
