// Reads touchstone-suite-1 and judges answers: node judge.js SUITE.csv[.gz] ANSWERS.jsonl. README.md has its format.
// Or from a program: for (const c of read('touchstone-suite-1.csv.gz')) verdict(c, answer), where an answer is
// {status: 'contact', signed_distance, normal: [x, y, z], points: [{position, depth}, …]} or {status: 'none'}. CC0.
'use strict';
const fs = require('fs'), zlib = require('zlib'), {abs, hypot, max, min} = Math;
const texts = ['id', 'group', 'shape_b', 'contact', 'ties', 'normal', 'patch_kind'];
function read(file) {
  const bytes = fs.readFileSync(file), text = (file.endsWith('.gz') ? zlib.gunzipSync(bytes) : bytes).toString();
  const [header, ...rows] = text.trimEnd().split('\n').map(row => row.split(','));
  return rows.map(row => Object.fromEntries(row.map((cell, i) => [header[i], texts.includes(header[i]) ? cell : Number(cell)])));
}
const numbers = (c, name, letters = 'xyz') => [...letters].map(letter => c[`${name}_${letter}`]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
function inFrame([w, x, y, z], v) {  // the quaternion may have any length
  const s = 2 / (w * w + x * x + y * y + z * z);
  return [v[0] + s * (v[1] * (x * y + w * z) + v[2] * (x * z - w * y) - v[0] * (y * y + z * z)),
    v[1] + s * (v[2] * (y * z + w * x) + v[0] * (x * y - w * z) - v[1] * (x * x + z * z)),
    v[2] + s * (v[0] * (x * z + w * y) + v[1] * (y * z - w * x) - v[2] * (x * x + y * y))];
}
function gap(c, n) {  // g(n): clearance along the unit vector n
  const r = c.radius_a, h = c.half_length_a, [b1, b2, b3, b4] = numbers(c, 'size_b', '1234'), qB = numbers(c, 'orientation_b', 'wxyz');
  const a = inFrame(numbers(c, 'orientation_a', 'wxyz'), n), b = inFrame(qB, n), positionB = numbers(c, 'position_b');
  const d = numbers(c, 'position_a').map((x, i) => x - positionB[i]), halfA = h * abs(a[2]) + r * hypot(a[0], a[1]);
  if (c.shape_b === 'plane') {  // against the column of the half-space beneath the cylinder's circumsphere
    const length = hypot(b1, b2, b3), rho = hypot(r, h), up = [b1 / length, b2 / length, b3 / length], cosine = dot(b, up);
    const height = dot(inFrame(qB, d), up) - b4 / length, sine = hypot(...b.map((x, i) => x - cosine * up[i]));
    return height * cosine - halfA - rho * sine - 2 * rho * max(0, -cosine);
  }
  const halfB = {sphere: b1, capsule: b1 + b2 * abs(b[2]), cylinder: b2 * abs(b[2]) + b1 * hypot(b[0], b[1]),
    box: dot([b1, b2, b3], b.map(abs))}[c.shape_b];
  return dot(d, n) - halfA - halfB;
}
function verdict(c, answer) {
  const number = x => x === null ? NaN : Number(x), required = c.contact === 'required';
  if (answer.status === 'none') return required ? 'missed' : 'agree';
  if (answer.status !== 'contact') return answer.status;
  const distance = number(answer.signed_distance), n = answer.normal.map(number), length = hypot(...n);
  const depths = answer.points.map(p => number(p.depth)), places = answer.points.flatMap(p => p.position.map(number));
  if (![distance, ...n, ...depths, ...places].every(Number.isFinite)) return 'not-finite';
  if (c.contact === 'forbidden') return 'phantom';
  if (distance > c.max_distance) return 'shallow';
  if (distance < c.min_distance) return 'overdeep';
  if (!(abs(length - 1) <= 1e-6)) return 'wrong-normal';
  if (c.signed_distance - gap(c, n.map(x => x / length)) > c.max_regret) return 'wrong-normal';
  if (depths.length === 0) return required ? 'shallow-points' : 'agree';
  if (max(...depths) < -c.max_distance) return 'shallow-points';
  if (max(...depths) > -c.min_distance) return 'overdeep-points';
  return min(...depths) < c.min_point_depth ? 'phantom-points' : 'agree';
}
const right = c => `contact ${c.contact}, signed distance ${c.min_distance} to ${c.max_distance}, normal ${c.normal}`;
module.exports = {read, gap, verdict, right};
if (require.main === module) {
  const cases = new Map(read(process.argv[2]).map(c => [c.id, c]));
  const answers = fs.readFileSync(process.argv[3], 'utf8').trimEnd().split('\n').map(line => JSON.parse(line));
  for (const answer of answers.filter(a => 'id' in a)) {
    const c = cases.get(answer.id), judged = verdict(c, answer);
    console.log(answer.id, judged, judged === 'agree' ? '' : `right: ${right(c)}`);
    if (judged !== 'agree') process.exitCode = 1;
  }
}
