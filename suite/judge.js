// Reads touchstone-suite-1 or -2 and judges answers: node judge.js [--float] SUITE.csv[.gz] ANSWERS.jsonl. See README.md.
// Or from a program: for (const c of read('touchstone-suite-1.csv.gz')) verdict(c, answer), where an answer is
// {status: 'contact', signed_distance, normal: [x, y, z], points: [{position, depth}, …]} or {status: 'none'}; to a
// cast {status: 'touch', fraction, normal}, {status: 'from-start', normal} or {status: 'never'}.
// SPDX-License-Identifier: CC0-1.0
'use strict';
const fs = require('fs'), zlib = require('zlib'), {abs, hypot, max, min} = Math;
const rowCount = 5106;  // of touchstone-suite-1; other test data have further columns, suite-2's files a last line with it
const bodies = `id group radius_a half_length_a position_a_x position_a_y position_a_z orientation_a_w orientation_a_x
orientation_a_y orientation_a_z shape_b size_b_1 size_b_2 size_b_3 size_b_4 position_b_x position_b_y position_b_z
orientation_b_w orientation_b_x orientation_b_y orientation_b_z `;
const columns = (bodies + `signed_distance signed_distance_error signed_distance_low
signed_distance_high contact min_distance max_distance max_regret min_point_depth ties normal patch_kind`).split(/\s/);
const castColumns = (bodies + `sweep_x sweep_y sweep_z outcome fraction fraction_low fraction_high start_depth
touch tolerance min_fraction max_fraction ties normal vertices_b
float_touch float_tolerance float_min_fraction float_max_fraction about`).split(/\s/);
const texts = 'id group shape_b contact ties normal patch_kind outcome touch float_touch vertices_b about'.split(' ');
const statusesOf = ['"contact", "none"', '"touch", "from-start", "never"'];  // of answers to contacts and to casts
function textOf(file) {
  try {
    const bytes = fs.readFileSync(file);
    return (file.endsWith('.gz') ? zlib.gunzipSync(bytes) : bytes).toString();
  } catch (e) { throw Error(`${file}: cannot be read: ${e.message}`); }
}
function read(file) {  // throws an Error with the line and column of what is wrong
  const lines = textOf(file).trimEnd().split('\n').map((row, i) => ({line: i + 1, row: row.replace(/\r$/, '')}));
  const [header, ...rows] = lines.filter(({row}) => !row.startsWith('#')).map(({line, row}) => Object.assign(row.split(','), {line}));
  const known = [columns, castColumns].find(names => names.every((name, i) => header?.[i] === name));
  if (!known)
    throw Error(`${file}:1: must be the columns of touchstone-suite-1 or -2, "id,group,…"; a packed file ends in .gz`);
  const value = (line, name, cell) => {
    if (texts.includes(name) || !known.includes(name)) return cell;
    if (cell.trim() === '' || Number.isNaN(Number(cell))) throw Error(`${file}:${line}: ${name} is "${cell}": must be a number`);
    return Number(cell);
  };
  const cases = rows.map(row => {
    if (row.length !== header.length)
      throw Error(`${file}:${row.line}: has ${row.length} cells: must have ${header.length}; the file is cut off or damaged`);
    return Object.fromEntries(row.map((cell, k) => [header[k], value(row.line, header[k], cell)]));
  });
  if (known === columns && header.length === columns.length && cases.length !== rowCount)
    throw Error(`${file}: has ${cases.length} configurations: must have ${rowCount}; the file is cut off`);
  const end = `# ${cases.length} configurations`;
  if (lines[0].row.startsWith('#') && lines.at(-1).row !== end)
    throw Error(`${file}:${lines.length}: must be "${end}"; the file is cut off`);
  return cases;
}
function inFloat(c) {  // one of touchstone-suite-2, with the limits for a routine in single precision
  if ('outcome' in c) {
    const ofFloat = Object.entries(c).filter(([name]) => name.startsWith('float_'));
    return {...c, ...Object.fromEntries(ofFloat.map(([name, x]) => [name.slice(6), x]))};
  }
  const t = Number(c.float_tolerance), distance = c.signed_distance;
  return {...c, contact: distance < -t ? 'required' : distance > t ? 'forbidden' : 'optional',
    min_distance: distance - t, max_distance: distance + t, max_regret: t, min_point_depth: -t};
}
function readAnswers(file, cases) {  // cases by id; throws an Error with the line and field of what is wrong
  const isObject = v => typeof v === 'object' && v !== null && !Array.isArray(v);
  const number = x => x === null || ['nan', 'inf', '-inf'].includes(x) || typeof x === 'number';
  const vector = v => Array.isArray(v) && v.length === 3 && v.every(number);
  const point = p => isObject(p) && vector(p.position) && number(p.depth);
  const kinds = {signed_distance: [number, 'a number'], normal: [vector, '[x, y, z]'],
    points: [v => Array.isArray(v) && v.every(point), '[{"position": [x, y, z], "depth": d}, …]']};
  const casts = [...cases.values()].some(c => 'outcome' in c), {normal} = kinds;
  const kindsOf = casts ? {touch: {fraction: [number, 'a number'], normal}, 'from-start': {normal}} : {contact: kinds};
  const [statuses, others] = casts ? [...statusesOf].reverse() : statusesOf;
  const text = textOf(file).replace(/^\ufeff/, ''), answers = [];  // some editors write a byte order mark
  for (const [i, row] of text.split('\n').entries()) {
    const wrong = what => Error(`${file}:${i + 1}: ${what}`);
    if (row.trim() === '') continue;
    let answer;
    try { answer = JSON.parse(row); } catch (e) { throw wrong(`is not JSON (${e.message}): write an object on each line`); }
    if (!isObject(answer)) throw wrong('is no object: write {"id": …, "status": …}');
    if (i === 0 && !('id' in answer) && 'candidate' in answer) continue;
    if (!('id' in answer)) throw wrong('id is missing: must be that of a configuration');
    if (!cases.has(answer.id)) throw wrong(`id is ${JSON.stringify(answer.id)}: must be that of a configuration of the suite`);
    if (typeof answer.status !== 'string') throw wrong(`status is missing: must be ${statuses} or why there is no answer`);
    if (others.split(', ').includes(`"${answer.status}"`)) throw wrong(`status is "${answer.status}": must be ${statuses} or why there is no answer`);
    for (const [name, [isRight, rightForm]] of Object.entries(kindsOf[answer.status] ?? {})) {
      if (!(name in answer)) throw wrong(`${name} is missing: must be ${rightForm}`);
      if (!isRight(answer[name])) throw wrong(`${name} is not usable: must be ${rightForm}`);
    }
    answers.push(answer);
  }
  if (answers.length === 0) throw Error(`${file}: has no answers: write an object on each line`);
  return answers;
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
  if (c.shape_b === 'convex')
    return dot(d, n) - halfA - max(...c.vertices_b.split(';').map(v => dot(v.split(' ').map(Number), b)));
  const halfB = {sphere: b1, capsule: b1 + b2 * abs(b[2]), cylinder: b2 * abs(b[2]) + b1 * hypot(b[0], b[1]),
    box: dot([b1, b2, b3], b.map(abs))}[c.shape_b];
  return dot(d, n) - halfA - halfB;
}
const number = x => x === null ? NaN : Number(x);
function castVerdict(c, answer) {
  if (answer.status === 'never') return c.touch === 'required' ? 'missed' : 'agree';
  if (!['touch', 'from-start'].includes(answer.status)) return answer.status;
  const t = answer.status === 'touch' ? number(answer.fraction) : 0, n = answer.normal.map(number), length = hypot(...n);
  if (![t, ...n].every(Number.isFinite)) return 'not-finite';
  if (t < c.min_fraction || t > c.max_fraction)
    return c.outcome === 'never' ? 'made-up' : t < c.min_fraction ? 'early' : 'late';
  if (length === 0) return 'agree';  // a routine that has no normals
  if (!(abs(length - 1) <= 1e-6)) return 'wrong-normal';
  const there = {...c};
  for (const e of 'xyz') there[`position_a_${e}`] += t * c[`sweep_${e}`];
  const best = c.normal === 'none' ? [] : c.normal.split(';').map(one => one.split(' ').map(Number));
  const distance = max(-max(c.start_depth, c.tolerance), ...best.map(one => gap(there, one)));
  return distance - gap(there, n.map(x => x / length)) > c.tolerance ? 'wrong-normal' : 'agree';
}
function verdict(c, answer) {
  if ('outcome' in c) return castVerdict(c, answer);
  const required = c.contact === 'required';
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
const right = c => c.touch === 'forbidden' ? 'touch forbidden' :
  'outcome' in c ? `touch ${c.touch}, fraction ${c.min_fraction} to ${c.max_fraction}, normal ${c.normal}` :
  `contact ${c.contact}, signed distance ${c.min_distance} to ${c.max_distance}, normal ${c.normal}`;
module.exports = {read, readAnswers, inFloat, gap, verdict, right};
if (require.main === module) {
  const fail = message => { console.error(message); process.exit(2); };
  const words = process.argv.slice(2), single = words.includes('--float'), files = words.filter(word => word !== '--float');
  if (files.length !== 2) fail('usage: node judge.js [--float] SUITE.csv[.gz] ANSWERS.jsonl');
  const [cases, answers] = (() => {
    try {
      const all = read(files[0]);
      if (single && !all.every(c => 'float_tolerance' in c))
        throw Error(`${files[0]}: has no float_tolerance: --float needs a file of touchstone-suite-2`);
      const byId = new Map(all.map(c => [c.id, single ? inFloat(c) : c]));
      return [byId, readAnswers(files[1], byId)];
    } catch (e) { return fail(e.message); }
  })();
  for (const answer of answers) {
    const c = cases.get(answer.id), judged = verdict(c, answer);
    console.log(answer.id, judged, judged === 'agree' ? '' : `right: ${right(c)}`);
    if (judged !== 'agree') process.exitCode = 1;
  }
}
