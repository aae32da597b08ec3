// What the engines of npm have in common: where their packages lie, and rotations.
//
// The packages of package-lock.json are installed (`npm ci --ignore-scripts`) in the folder
// TOUCHSTONE_NPM, or build/npm of the source tree; where TOUCHSTONE_RELEASE names a release of the
// adapter's package, that one is in versions/PACKAGE@RELEASE below it.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath, pathToFileURL } from 'node:url';

const installed = path.resolve(process.env.TOUCHSTONE_NPM ??
  fileURLToPath(new URL('../../build/npm', import.meta.url)));
const release = process.env.TOUCHSTONE_RELEASE;

/** The name of a candidate: with the release that was asked for. */
export const named = (name) => release ? `${name}@${release}` : name;

/** The folder in which the adapter's package was installed. */
const rootOf = (name) => release ? path.join(installed, 'versions', `${name}@${release}`) : installed;

/** The folder of a package. */
export const folderOf = (name) => path.join(rootOf(name), 'node_modules', name);

const described = (name) => JSON.parse(fs.readFileSync(path.join(folderOf(name), 'package.json')));

export const versionOf = (name) => described(name).version;

/** The module of a package. */
export async function load(name) {
  const from = (file) => import(pathToFileURL(file));
  try {
    return await from(createRequire(path.join(rootOf(name), 'any.js')).resolve(name));
  } catch (error) {
    // Rapier 0.15 and 0.17 call their CommonJS a module; the one is named beside it.
    const { module } = described(name);
    if (!release || !module) throw error;
    return from(path.join(folderOf(name), module));
  }
}

/** Ends where a release lacks what its adapter needs; the last line is told. */
export function refuse(reason) {
  console.error(`unsupported: ${reason}`);
  process.exit(2);
}
if (release) process.on('uncaughtException', ({ message }) => refuse(`${release}: ${message}`));

export const ALL_PAIRS = ['plane', 'sphere', 'capsule', 'cylinder', 'box', 'convex']
  .map((b) => `cylinder-${b}`);

/** The rotation `q` after the rotation `p`; w, x, y, z. */
export const multiply = ([a, b, c, d], [w, x, y, z]) => [
  a * w - b * x - c * y - d * z,
  a * x + b * w + c * z - d * y,
  a * y - b * z + c * w + d * x,
  a * z + b * y - c * x + d * w,
];

/** v turned by the unit quaternion q. */
export function rotate([w, x, y, z], [a, b, c]) {
  const s = 2 * (y * c - z * b), t = 2 * (z * a - x * c), u = 2 * (x * b - y * a);
  return [a + w * s + y * u - z * t, b + w * t + z * s - x * u, c + w * u + x * t - y * s];
}

/** Turns the y axis, along which many engines have their cylinders, into our z axis. */
export const Y_TO_Z = [Math.SQRT1_2, Math.SQRT1_2, 0, 0];

/** A rotation that turns the unit vector `from` into the unit vector `to`. */
export function turn(from, to) {
  const [a, b, c] = from, [x, y, z] = to;
  const w = 1 + a * x + b * y + c * z;
  let q = [w, b * z - c * y, c * x - a * z, a * y - b * x];
  if (w < 1e-9) q = Math.abs(a) < 0.8 ? [0, 0, c, -b] : [0, -c, 0, a];  // half a turn, across both
  // Not Math.hypot, which versions of node compute differently.
  const length = Math.sqrt(q.reduce((sum, v) => sum + v * v, 0));
  return q.map((v) => v / length);
}

/** The smallest half extent; of a convex body, whose margin engines bound themselves, Infinity. */
export const smallest = (shape) => Math.min(
  ...shape.half_extents ?? [shape.radius ?? Infinity, shape.half_length ?? Infinity]);

export const middle = (u, v) => [(u[0] + v[0]) / 2, (u[1] + v[1]) / 2, (u[2] + v[2]) / 2];
