/* A complete plug-in: a cylinder against a plane, by the four rim points that lie deepest and
 * highest on each cap. Build and try it:
 *
 *   cc -O2 -shared -fPIC -I PREFIX/include cylinder_plane.c -o my_engine.so -lm
 *   touchstone --load ./my_engine.so report --pair cylinder-plane */
#include <math.h>
#include <stdlib.h>
#include <touchstone/candidate.h>

struct ts_prepared {
  double radius, half_length, normal[3], displacement, threshold;
};

static int supports(void* context, ts_shape_kind other) {
  (void)context;
  return other == TS_PLANE;
}

static ts_prepared* prepare(void* context, const ts_shape* a, const ts_shape* b, double threshold,
                            double parameter) {
  ts_prepared* p = malloc(sizeof *p);
  (void)context;
  (void)parameter;
  *p = (ts_prepared){
      a->size[0], a->size[1], {b->size[0], b->size[1], b->size[2]}, b->size[3], threshold};
  return p;
}

static double dot(const double* u, const double* v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/* out = v turned by the unit quaternion q: v + 2 w (u × v) + 2 u × (u × v) with u its vector. */
static void rotate(const double q[4], const double v[3], double out[3]) {
  double c[3];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] = 2 * (q[1 + j] * v[k] - q[1 + k] * v[j]);
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = v[i] + q[0] * c[i] + q[1 + j] * c[k] - q[1 + k] * c[j];
  }
}

static void query(ts_prepared* p, const ts_pose* a, const ts_pose* b, const double* previous_normal,
                  ts_answer* answer) {
  const double z[3] = {0, 0, 1}, x[3] = {1, 0, 0};
  double n[3], axis[3], down[3];
  (void)previous_normal; /* there is but one normal */
  rotate(b->orientation, p->normal, n);
  rotate(a->orientation, z, axis);
  for (int i = 0; i < 3; ++i) down[i] = dot(n, axis) * axis[i] - n[i]; /* across the axis */
  if (dot(down, down) < 1e-24) rotate(a->orientation, x, down);        /* standing: any way */
  const double length = sqrt(dot(down, down));
  answer->status = TS_NONE;
  answer->point_count = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double along = corner & 1 ? -p->half_length : p->half_length;
    const double across = (corner & 2 ? -p->radius : p->radius) / length;
    double on_a[3];
    for (int i = 0; i < 3; ++i) on_a[i] = a->position[i] + along * axis[i] + across * down[i];
    const double distance = dot(n, on_a) - dot(n, b->position) - p->displacement;
    if (distance > p->threshold) continue;
    ts_point* point = &answer->points[answer->point_count++];
    for (int i = 0; i < 3; ++i) point->position[i] = on_a[i] - distance / 2 * n[i];
    for (int i = 0; i < 3; ++i) point->normal[i] = answer->normal[i] = n[i];
    point->depth = -distance;
    if (answer->status == TS_NONE || distance < answer->signed_distance)
      answer->signed_distance = distance;
    answer->status = TS_CONTACT;
  }
}

static void release(ts_prepared* p) { free(p); }

const ts_plugin* touchstone_plugin(void) {
  static const ts_candidate me = {"my-engine", "1.0", "double precision; rim points",
                                  NULL,        NULL,  supports,
                                  prepare,     query, release,
                                  NULL,        NULL};
  static const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 1, &me, NULL, 0, NULL};
  return &plugin;
}
