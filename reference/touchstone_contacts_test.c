/* The interface for C, from C: values known on paper, and what is refused. */
#include "touchstone_contacts.h"

#include <math.h>
#include <stdio.h>

static int failures = 0;

static void expect(int holds, const char* what) {
  if (holds) return;
  printf("FAILED: %s\n", what);
  ++failures;
}

static int near_to(double x, double y) { return fabs(x - y) < 1e-12; }

/* A can of 0.5 m radius and 2 m length whose lower cap is 10 mm below z = 0. */
static const touchstone_body can = {
    TOUCHSTONE_CYLINDER, {0.5, 1, 0, 0}, {0.1, 0.2, 0.99}, {1, 0, 0, 0}};

/* Bodies that reach up to z = 0 below the can. */
static const touchstone_body others[] = {
    {TOUCHSTONE_PLANE, {0, 0, 2, 0}, {0, 0, 0}, {1, 0, 0, 0}},
    {TOUCHSTONE_SPHERE, {0.3, 0, 0, 0}, {0.1, 0.2, -0.3}, {1, 0, 0, 0}},
    {TOUCHSTONE_CAPSULE, {0.2, 0.5, 0, 0}, {0.1, 0.2, -0.2}, {1, 0, 1, 0}},
    {TOUCHSTONE_CYLINDER, {0.5, 1, 0, 0}, {0.1, 0.2, -1}, {2, 0, 0, 0}},
    {TOUCHSTONE_BOX, {1, 1, 0.5, 0}, {0, 0, -0.5}, {1, 0, 0, 0}}};
static const int point_counts[] = {3, 1, 2, 3, 3};

/* As many as need more than one round of a batch, the can ever higher. */
enum { count = 37 };

static void test_batches(const touchstone_body* b) {
  touchstone_pose poses_a[count], poses_b[count];
  touchstone_float_pose float_poses_a[count], float_poses_b[count];
  touchstone_contact contacts[count], one;
  touchstone_float_contact float_contacts[count];
  touchstone_distance distances[count];
  touchstone_float_distance float_distances[count];
  int overlaps[count], float_overlaps[count];
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      poses_a[i].position[k] = can.position[k] + (k == 2 ? 0.001 * i : 0);
      poses_b[i].position[k] = b->position[k];
      float_poses_a[i].position[k] = (float)poses_a[i].position[k];
      float_poses_b[i].position[k] = (float)poses_b[i].position[k];
    }
    for (int k = 0; k < 4; ++k) {
      poses_a[i].orientation[k] = can.orientation[k];
      poses_b[i].orientation[k] = b->orientation[k];
      float_poses_a[i].orientation[k] = (float)can.orientation[k];
      float_poses_b[i].orientation[k] = (float)b->orientation[k];
    }
  }
  expect(touchstone_find_contacts(&can, poses_a, b, poses_b, count, 0.005, contacts) == 0 &&
             touchstone_find_signed_distances(&can, poses_a, b, poses_b, count, distances) == 0 &&
             touchstone_find_overlaps(&can, poses_a, b, poses_b, count, overlaps) == 0,
         "a batch is answered");
  expect(touchstone_find_float_contacts(&can, float_poses_a, b, float_poses_b, count, 0.005F,
                                        float_contacts) == 0 &&
             touchstone_find_float_signed_distances(&can, float_poses_a, b, float_poses_b, count,
                                                    float_distances) == 0 &&
             touchstone_find_float_overlaps(&can, float_poses_a, b, float_poses_b, count,
                                            float_overlaps) == 0,
         "a batch in float is answered");
  for (int i = 0; i < count; ++i) {
    touchstone_body a = can;
    const double gap = -0.01 + 0.001 * i;
    a.position[2] = poses_a[i].position[2];
    touchstone_find_contact(&a, b, 0.005, &one);
    expect(contacts[i].signed_distance == one.signed_distance &&
               contacts[i].point_count == one.point_count &&
               contacts[i].normal[2] == one.normal[2] &&
               (one.point_count == 0 || contacts[i].points[0].depth == one.points[0].depth),
           "as one by one");
    expect(near_to(distances[i].value, gap) && near_to(distances[i].normal[2], 1),
           "the signed distance in a batch");
    expect(i == 10 || overlaps[i] == (gap < 0), "an overlap in a batch");
    expect(fabs(float_distances[i].value - gap) < 1e-6 &&
               fabs(float_distances[i].normal[2] - 1) < 1e-6,
           "the signed distance in float");
    expect(i == 10 || float_overlaps[i] == (gap < 0), "an overlap in float");
    expect(i == 15 || float_contacts[i].point_count == one.point_count, "as many points in float");
    for (int k = 0; k < float_contacts[i].point_count; ++k) {
      expect(fabs(float_contacts[i].points[k].depth + gap) < 1e-6, "each as deep in float");
      expect(fabs(float_contacts[i].points[k].position[2] - gap / 2) < 1e-6, "halfway in float");
    }
  }
  expect(touchstone_find_contacts(&can, poses_a, b, poses_b, 0, 0, contacts) == 0, "no pose");
  contacts[0].point_count = -1;
  float_overlaps[0] = -1;
  poses_b[count - 1].orientation[0] = NAN;
  float_poses_a[count - 1].position[0] = NAN;
  expect(touchstone_find_contacts(&can, poses_a, b, poses_b, count, 0, contacts) == 1 &&
             contacts[0].point_count == -1,
         "no orientation of one pose, and nothing written");
  expect(touchstone_find_float_overlaps(&can, float_poses_a, b, float_poses_b, count,
                                        float_overlaps) == 1 &&
             float_overlaps[0] == -1,
         "no position of one pose, and nothing written");
  expect(touchstone_find_overlaps(b, poses_b, &can, poses_a, 1, overlaps) ==
             (b->kind != TOUCHSTONE_CYLINDER),
         "A must be a cylinder in a batch");
}

/* The can, 10 mm deep, starts 1.51 m higher and is let down by 3 m. */
static void test_casts(const touchstone_body* b) {
  const double down[3] = {0, 0, -3}, beyond[3] = {0, INFINITY, 0};
  touchstone_body above = can;
  above.position[2] += 1.51;
  touchstone_cast cast = {TOUCHSTONE_CAST_NEVER, -1, {0, 0, 0}};
  expect(touchstone_find_cast(&above, beyond, b, &cast) == 1 && cast.fraction == -1,
         "a sweep without end, and nothing written");
  expect(touchstone_find_cast(&above, down, b, &cast) == 0 &&
             cast.status == TOUCHSTONE_CAST_TOUCH && near_to(cast.fraction, 0.5) &&
             near_to(cast.normal[2], 1),
         "it touches after 1.5 m");
  expect(touchstone_find_cast(&can, down, b, &cast) == 0 &&
             cast.status == TOUCHSTONE_CAST_FROM_START && cast.fraction == 0,
         "it overlaps from the start");

  const touchstone_pose one_b = {
      {b->position[0], b->position[1], b->position[2]},
      {b->orientation[0], b->orientation[1], b->orientation[2], b->orientation[3]}};
  touchstone_pose poses_a[2], poses_b[2];
  for (int i = 0; i < 2; ++i) {
    poses_a[i] =
        (touchstone_pose){{above.position[0], above.position[1], above.position[2]}, {1, 0, 0, 0}};
    poses_b[i] = one_b;
  }
  const double sweeps[6] = {0, 0, -1, 0, 0, -6};
  touchstone_cast casts[2];
  expect(touchstone_find_casts(&above, poses_a, sweeps, b, poses_b, 2, casts) == 0, "two casts");
  expect(casts[0].status == TOUCHSTONE_CAST_NEVER && casts[0].fraction == 1, "too short a sweep");
  expect(casts[1].status == TOUCHSTONE_CAST_TOUCH && near_to(casts[1].fraction, 0.25),
         "twice the sweep takes half the time");
}

int main(void) {
  touchstone_contact contact;
  double distance = 0, normal[3] = {0, 0, 0};
  int overlap = 0;
  for (int i = 0; i < 5; ++i) {
    const touchstone_body* b = &others[i];
    printf("%d\n", i);
    expect(touchstone_find_contact(&can, b, 0, &contact) == 0, "a contact is found");
    expect(near_to(contact.signed_distance, -0.01) && near_to(contact.normal[2], 1),
           "10 mm deep, and free upwards");
    expect(contact.point_count == point_counts[i], "as many points as the patch needs");
    for (int k = 0; k < contact.point_count; ++k) {
      expect(near_to(contact.points[k].depth, 0.01), "each 10 mm deep");
      expect(near_to(contact.points[k].position[2], -0.005), "and halfway");
    }
    expect(touchstone_find_signed_distance(&can, b, &distance, normal) == 0 &&
               near_to(distance, -0.01) && near_to(normal[2], 1),
           "the signed distance");
    expect(touchstone_find_overlap(&can, b, &overlap) == 0 && overlap == 1, "an overlap");

    touchstone_body above = can;
    above.position[2] = 1.5;
    expect(touchstone_find_contact(&above, b, 0.1, &contact) == 0 && contact.point_count == 0,
           "no point above the threshold");
    expect(touchstone_find_overlap(&above, b, &overlap) == 0 && overlap == 0, "no overlap");

    expect(touchstone_find_overlap(b, &can, &overlap) == (b->kind != TOUCHSTONE_CYLINDER),
           "A must be a cylinder");
    test_batches(b);
    test_casts(b);
  }
  touchstone_body invalid = can;
  invalid.size[0] = 0;
  expect(touchstone_find_contact(&invalid, &others[0], 0, &contact) == 1, "no radius");
  invalid = can;
  invalid.position[1] = NAN;
  expect(touchstone_find_contact(&invalid, &others[0], 0, &contact) == 1, "no position");
  invalid = others[4];
  invalid.kind = (touchstone_shape_kind)7;
  expect(touchstone_find_contact(&can, &invalid, 0, &contact) == 1, "no shape");
  return failures > 0;
}
