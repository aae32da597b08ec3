// The surface of a plane or box as triangles, as candidates/floor.hpp has it.
import { multiply, rotate, turn } from './packages.mjs';

/** What a candidate with floors takes, beside its name and how it is called. */
export const FLOOR = {
  pairs: ['cylinder-plane', 'cylinder-box'],
  parameter: {
    meaning: 'number of squares along a side', min: 2, max: 64, usual: 8, whole: true },
};

/**
 * Of a plane or box, and else null: the corners, the triangles as indices of them, counterclockwise seen from outside, and where the
 * frame of all that is for bodies at two poses: z is the normal of a plane.
 */
export function makeFloor(a, b, count) {
  if (b.shape !== 'plane' && b.shape !== 'box') return null;
  const corners = [], triangles = [];
  const addFace = (centre, u, v) => {
    const first = corners.length, row = count + 1;
    for (let j = 0; j <= count; ++j) {
      for (let i = 0; i <= count; ++i) {
        corners.push(
          centre.map((x, k) => x + (2 * i / count - 1) * u[k] + (2 * j / count - 1) * v[k]));
      }
    }
    for (let j = 0; j < count; ++j) {
      for (let i = 0; i < count; ++i) {
        const corner = first + j * row + i, across = corner + row + 1;
        triangles.push([corner, corner + 1, across], [corner, across, corner + row]);
      }
    }
  };
  if (b.shape === 'box') {
    const along = (k, length) => [0, 1, 2].map((i) => i === k % 3 ? length : 0);
    b.half_extents.forEach((half, k) => {
      for (const side of [1, -1]) {
        addFace(along(k, side * half), along(k + 1, b.half_extents[(k + 1) % 3]),
          along(k + 2, side * b.half_extents[(k + 2) % 3]));
      }
    });
    return { shape: 'floor', corners, triangles, at: (poseA, poseB) => poseB };
  }
  const side = 5 * Math.sqrt(a.radius ** 2 + a.half_length ** 2) / count, half = side * count / 2;
  addFace([0, 0, 0], [half, 0, 0], [0, half, 0]);
  const toNormal = turn([0, 0, 1], b.normal), offset = count % 2 === 0 ? 0 : 0.5;
  const middle = (x) => side * (Math.round(x / side - offset) + offset);
  const at = (poseA, poseB) => {
    const orientation = multiply(poseB.orientation, toNormal);
    const up = rotate(orientation, [0, 0, 1]);
    const corner = poseB.position.map((x, i) => x + b.displacement * up[i]);
    const [w, ...v] = orientation;
    const [x, y] = rotate([w, ...v.map((c) => -c)], poseA.position.map((c, i) => c - corner[i]));
    const moved = rotate(orientation, [middle(x), middle(y), 0]);
    return { position: corner.map((c, i) => c + moved[i]), orientation };
  };
  return { shape: 'floor', corners, triangles, at };
}
