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
