// ODE 0.16.2: a dHashSpace does not report two boxes that overlap.
//
// Expected  1 pair, as of a dSimpleSpace. The brick reaches from z = 0.01 to 0.07, above the middle
// of a
//           table whose top is at z = 0.05.
// Seen      0 pairs, and so wherever a box of 0.5 to 1 m reaches below z = 0 in cell x = 0, y = 0:
//           dxHashSpace finds a cell in unsigned numbers, which wrap, but steps to the next one in
//           z.
// Compile   g++ ode_hash_space.cpp -o reproducer -lode   (Debian 12: apt-get install g++
// libode-dev)
#include <cstdio>
#include <ode/ode.h>

int pairs_in(dSpaceID space) {
  const dGeomID table = dCreateBox(space, 0.8, 0.8, 0.1);
  const dGeomID brick = dCreateBox(space, 0.06, 0.06, 0.06);
  dGeomSetPosition(table, 0, 0, 0);
  dGeomSetPosition(brick, 0.2, 0.2, 0.04);
  int pairs = 0;
  dSpaceCollide(space, &pairs, [](void* count, dGeomID, dGeomID) { ++*static_cast<int*>(count); });
  return pairs;
}

int main() {
  dInitODE();
  const int simple = pairs_in(dSimpleSpaceCreate(nullptr));
  const int hash = pairs_in(dHashSpaceCreate(nullptr));
  std::printf("pairs: dSimpleSpace %d, dHashSpace %d\n", simple, hash);
  return simple == 1 && hash == 1 ? 0 : 1;
}
