// Answers as echo.py does, in JavaScript.
import { run } from '../touchstone_candidate.mjs';
import { execSync } from 'node:child_process';
import fs from 'node:fs';

console.log('this is no hello');

// The clock moves by one with every query and with every message or number that the client reads, as that of echo.py.
let clock = 0n;
process.hrtime.bigint = () => clock;
for (const [owner, name] of [[JSON, 'parse'], [DataView.prototype, 'getFloat64']]) {
  const read = owner[name];
  owner[name] = function (...given) {
    ++clock;
    return read.apply(this, given);
  };
}

run({
  name: 'echo', version: '1', settings: 'none', format: process.argv[2],
  pairs: ['cylinder-plane', 'cylinder-box', 'cylinder-cylinder', 'cylinder-convex'],
  parameter: { meaning: 'number', min: 0, max: 9, usual: 3, whole: true },
  models: 'nothing at all',

  prepare(a, b, threshold, parameter) {
    if (b.shape === 'sphere') return null;
    if (b.shape === 'capsule') throw new Error('no capsules today');
    const sizes = b.vertices?.flat() ?? b.half_extents ?? [...b.normal, b.displacement];
    return [a.radius, a.half_length, ...sizes, threshold, parameter];
  },

  query(prepared, poseA, poseB, hint) {
    ++clock;
    const asked = poseA.position[0];
    const point = { position: [0, 0, 0], normal: [0, 0, 1], depth: 0 };
    if (asked === 1) throw new Error('one is too much');
    if (asked === 2) return { signed_distance: 0, normal: [0, 0, 1], points: Array(17).fill(point) };
    if (asked === 3) return null;
    if (asked === 4) {
      console.log('printed');
      fs.writeSync(1, 'written to the descriptor\n');
      execSync('echo by a child', { stdio: 'inherit' });
    }
    if (asked === 5) return { signed_distance: 'far', normal: [0, 0, 1] };
    const points = Array.from({ length: 16 }, (_, i) => ({
      position: poseA.position, normal: poseB.position, depth: prepared[i % prepared.length],
    }));
    points[0] = { position: [NaN, Infinity, -Infinity], normal: hint ?? [-0, 0, 5e-324], depth: -0 };
    return { signed_distance: poseA.orientation[0], normal: poseB.orientation.slice(1), points };
  },

  model_distance: (prepared, poseA, poseB) => poseA.position[0] === 3 ? NaN : poseB.orientation[0],

  release(prepared) {
    console.log('released', prepared[0]);
  },
});
