// Makes an engine in JavaScript a candidate of Touchstone (candidates/host/protocol.md).
//
//     import { run } from './touchstone_candidate.mjs';
//
//     run({
//       name: 'mine', version: '0.1', settings: 'closed form, double precision',
//       pairs: ['cylinder-sphere'],
//       query: ({ a, b }, poseA, poseB, hint) =>
//         ({ signed_distance, normal, points: [{ position, normal, depth }] }),
//     });
//
//     touchstone --candidate-command "node mine.mjs" report --count 2
//
// Import this module before any other: from then on, what the process prints goes to standard
// error, for standard output belongs to the protocol. Needs node 18 or later and nothing else.
// Lengths are in metres, body A is the cylinder, normals are unit vectors from B to A in the world's
// frame, vectors are arrays, orientations are unit quaternions w, x, y, z. Shapes are as in a
// configuration:
// { shape: 'cylinder' | 'capsule', radius, half_length }, { shape: 'sphere', radius },
// { shape: 'box', half_extents }, { shape: 'plane', normal, displacement }, { shape: 'convex', vertices },
// the hull of its vertices, each of them a corner.
//
// A candidate has these members; only `name` to `pairs` and `query` are required.
//
//   name        as on the command line: printable ASCII without colon, comma, slash or space, not "-…"
//   version     of the engine
//   settings    how it is called: algorithm, margin, tolerance, where its contact points lie
//   pairs       of cylinder-plane, cylinder-sphere, cylinder-capsule, cylinder-cylinder,
//               cylinder-box and cylinder-convex
//   precision   'double' (default) or 'float'
//   runs        'script' (default), 'wasm' or 'native'
//   format      'frames' (default), or 'lines': requests and answers as text, for debugging
//   parameter   for a family: { meaning: 'margin, metres', min: 0, max: 1, usual: 0.01 }
//   models      what replaces the shapes, in a simplified model
//   roundings   see below
//
//   prepare(a, b, threshold, parameter)       makes two shapes ready, untimed, and returns what
//       `query` needs ({ a, b, threshold } by default); null: unsupported. Contacts up to
//       `threshold` apart are to be reported.
//   query(prepared, poseA, poseB, hint)       returns the contact, with at most 16 points; null:
//       the bodies are further apart than the threshold. The answer depends on the arguments alone;
//       `hint`, the normal of the previous frame or null, may only decide between normals that are
//       equally good. An exception counts as a failure of this question; its text goes to standard
//       error.
//   release(prepared)                         frees what `prepare` returned
//   model_distance(prepared, poseA, poseB)    the exact signed distance of what `models` names
//   roundings(prepared)                       the radii [A's, B's] of the balls by which the engine
//       rounds edges and corners: of cylinder and box within their sizes, of a convex body around it.
//       With it, shapes may have a `rounding`, too; without it, the candidate is not asked of those.
//   cast(prepared, poseA, poseB, sweep)       when A touches B first while it moves by `sweep`: as
//       { fraction, normal }, the fraction 0 from the start, the normal zero if there is none; null:
//       never; undefined: the engine has no cast of this pair.
import fs from 'node:fs';
import os from 'node:os';

const MAX_POINTS = 16;
const HEADER = 24;
const SIZES = { prepare: 104, question: 144, answer: 944, handle: 4, vertex: 24, roundings: 16, cast: 40 };
const PREPARE = 1, QUERY = 2, TIME = 3, RELEASE = 4, CAST = 5;
const STATUSES = { contact: 0, none: 1, unsupported: 2, failed: 3 };

const output = takeStandardOutput();

// A descriptor of its own for standard output; descriptor 1 becomes standard error. node has no
// dup2: what was closed last is opened first.
function takeStandardOutput() {
  process.stdout.write = process.stderr.write.bind(process.stderr);
  let own;
  try {
    own = fs.openSync('/proc/self/fd/1', 'w');
  } catch {
    return 1;  // not to be opened again, as a socket; what JavaScript prints is kept away
  }
  fs.closeSync(1);
  try {
    fs.openSync('/proc/self/fd/2', 'a');
  } catch {
    fs.openSync('/dev/null', 'w');
  }
  return own;
}

// Answers Touchstone until standard input ends, then ends the process. Nothing asynchronous runs
// meanwhile: load the engine first.
export function run(candidate) {
  const hello = JSON.parse(readLine() ?? '{}');
  if (hello.touchstone !== 1) {
    throw new Error(`expected the hello of Touchstone's protocol 1, got ${JSON.stringify(hello)}`);
  }
  if (os.endianness() !== 'LE') throw new Error('this machine is not little-endian');
  const { name, version, settings, pairs, precision = 'double', runs = 'script', format = 'frames',
    parameter, models, roundings, cast } = candidate;
  if (format !== 'frames' && format !== 'lines') throw new Error(`no such format: ${format}`);
  writeLine({ touchstone: 1, name, version, settings, precision, runs, format, pairs, parameter,
    models, roundings: roundings ? true : undefined, casts: cast ? true : undefined });
  const engine = new Engine(candidate);
  if (format === 'frames') answerFrames(engine);
  else answerLines(engine);
  process.exit(0);
}

// The candidate with what it has prepared, by handle.
class Engine {
  constructor(candidate) {
    this.candidate = {
      prepare: (a, b, threshold) => ({ a, b, threshold }), release: () => {}, ...candidate,
    };
    this.prepared = new Map();
  }

  prepare(handle, a, b, threshold, parameter) {
    let made;
    try {
      made = { value: this.candidate.prepare(a, b, threshold, parameter) ?? null };
    } catch (error) {
      endAfterTrap(error);
      made = { error };
    }
    this.prepared.set(handle, made);
    return made.value !== null;
  }

  // Of what could not be prepared, zeros.
  roundings(handle) {
    const { value } = this.prepared.get(handle);
    return value == null ? [0, 0] : this.candidate.roundings(value);
  }

  // The encoded answer; what cannot be encoded is a failure as well.
  query({ handle, poseA, poseB, hint }, encode) {
    const { value, error } = this.prepared.get(handle);
    if (value === null) return encode({ status: 'unsupported' });
    try {
      if (error) throw error;
      const modelDistance = this.candidate.models === undefined
        ? NaN : this.candidate.model_distance?.(value, poseA, poseB) ?? NaN;
      const contact = this.candidate.query(value, poseA, poseB, hint);
      return encode({ status: contact ? 'contact' : 'none', contact, modelDistance });
    } catch (error) {
      endAfterTrap(error);
      print(error);
      return encode({ status: 'failed' });
    }
  }

  // Its status, and of a touch the cast.
  cast({ handle, poseA, poseB, sweep }) {
    const { value, error } = this.prepared.get(handle);
    if (value === null) return { status: 'unsupported' };
    try {
      if (error) throw error;
      const cast = this.candidate.cast(value, poseA, poseB, sweep);
      if (!cast) return { status: cast === null ? 'never' : 'unsupported' };
      return { status: 'touch', ...cast, normal: [...cast.normal] };
    } catch (thrown) {
      endAfterTrap(thrown);
      print(thrown);
      return { status: 'failed' };
    }
  }

  // Nanoseconds for all passes over all questions; a failure takes what it takes.
  time(passes, questions) {
    const asked = questions
      .map(({ handle, ...question }) => ({ value: this.prepared.get(handle).value, ...question }))
      .filter(({ value }) => value != null);
    const { candidate } = this;
    const begin = process.hrtime.bigint();
    for (let pass = 0; pass < passes; ++pass) {
      for (const { value, poseA, poseB, hint } of asked) {
        try {
          candidate.query(value, poseA, poseB, hint);
        } catch (error) {
          endAfterTrap(error);
        }
      }
    }
    return Number(process.hrtime.bigint() - begin);
  }

  release(handle) {
    const { value } = this.prepared.get(handle);
    this.prepared.delete(handle);
    if (value == null) return;
    try {
      this.candidate.release(value);
    } catch (error) {
      endAfterTrap(error);
      print(error);
    }
  }
}

// Touchstone quotes the last line.
function print(error) {
  fs.writeSync(2, `${error?.stack ?? ''}\n${error}\n`);
}

// WebAssembly that trapped or aborted has lost its stack; its memory is not to be trusted again.
// Touchstone counts it as a crash and starts the command anew.
function endAfterTrap(error) {
  if (!(error instanceof WebAssembly.RuntimeError)) return;
  print(error);
  process.exit(70);
}

// ---- frames ------------------------------------------------------------------------------------

function answerFrames(engine) {
  for (;;) {
    const header = read(HEADER);
    if (!header) return;
    const view = new DataView(header.buffer);
    const operation = view.getUint32(4, true), count = view.getUint32(16, true);
    const body = read(view.getUint32(0, true) - 20);
    if (!body) return;
    const entries = new DataView(body.buffer);
    const each = (size, encode) => Array.from({ length: count }, (_, i) => encode(i * size));
    let answer;  // with the header's place before it
    if (operation === PREPARE) {
      const saysRoundings = engine.candidate.roundings !== undefined;
      const ofRoundings = saysRoundings ? SIZES.roundings : 0;
      answer = new DataView(new ArrayBuffer(HEADER + (4 + ofRoundings) * count));
      const vertices = verticesFrom(entries, SIZES.prepare * count);
      const given = (i) => numbersAt(entries, entries.byteLength - ofRoundings * (count - i), 2);
      each(SIZES.prepare, (at) => {
        const i = at / SIZES.prepare, handle = entries.getUint32(at, true);
        const shapes = [shapeAt(entries, at + 24, vertices), shapeAt(entries, at + 64, vertices)];
        if (saysRoundings) given(i).forEach((x, k) => { if (x > 0) shapes[k].rounding = x; });
        const supported = engine.prepare(handle, ...shapes, entries.getFloat64(at + 8, true),
          entries.getFloat64(at + 16, true));
        answer.setUint32(HEADER + 4 * i, supported ? 1 : 0, true);
        if (!saysRoundings) return;
        engine.roundings(handle).forEach((x, k) =>
          answer.setFloat64(HEADER + 4 * count + SIZES.roundings * i + 8 * k, x, true));
      });
    } else if (operation === RELEASE) {
      answer = new DataView(new ArrayBuffer(HEADER));
      each(SIZES.handle, (at) => engine.release(entries.getUint32(at, true)));
    } else {
      const questions = each(SIZES.question, (at) => questionAt(entries, at));
      if (operation === QUERY) {
        answer = new DataView(new ArrayBuffer(HEADER + SIZES.answer * count));
        questions.forEach((question, i) =>
          engine.query(question, (given) => writeAnswer(answer, HEADER + SIZES.answer * i, given)));
      } else if (operation === CAST) {
        answer = new DataView(new ArrayBuffer(HEADER + SIZES.cast * count));
        questions.forEach(({ hint: sweep, ...question }, i) =>
          writeCast(answer, HEADER + SIZES.cast * i, engine.cast({ sweep, ...question })));
      } else if (operation === TIME) {
        answer = new DataView(new ArrayBuffer(HEADER + 8));
        answer.setFloat64(HEADER, engine.time(view.getUint32(20, true), questions), true);
      } else {
        throw new Error(`no such operation: ${operation}`);
      }
    }
    new Uint8Array(answer.buffer).set(header);
    answer.setUint32(0, answer.byteLength - 4, true);
    write(new Uint8Array(answer.buffer));
  }
}

function numbersAt(view, at, count) {
  const numbers = [];
  for (let i = 0; i < count; ++i) numbers.push(view.getFloat64(at + 8 * i, true));
  return numbers;
}

function* verticesFrom(view, at) {
  for (;; at += SIZES.vertex) yield numbersAt(view, at, 3);
}

// `vertices` gives those of the convex bodies in turn.
function shapeAt(view, at, vertices) {
  const size = numbersAt(view, at + 8, 4);
  switch (view.getUint32(at, true)) {
    case 0: return { shape: 'cylinder', radius: size[0], half_length: size[1] };
    case 1: return { shape: 'plane', normal: size.slice(0, 3), displacement: size[3] };
    case 2: return { shape: 'sphere', radius: size[0] };
    case 3: return { shape: 'capsule', radius: size[0], half_length: size[1] };
    case 4: return { shape: 'box', half_extents: size.slice(0, 3) };
    case 5: return { shape: 'convex',
      vertices: Array.from({ length: view.getUint32(at + 4, true) }, () => vertices.next().value) };
    default: throw new Error('no such kind of shape');
  }
}

function poseAt(view, at) {
  return { position: numbersAt(view, at, 3), orientation: numbersAt(view, at + 24, 4) };
}

function questionAt(view, at) {
  return {
    handle: view.getUint32(at, true), poseA: poseAt(view, at + 8), poseB: poseAt(view, at + 64),
    hint: view.getUint32(at + 4, true) ? numbersAt(view, at + 120, 3) : null,
  };
}

function writeAnswer(view, at, { status, contact, modelDistance = NaN }) {
  const { signed_distance, normal, points } = checked(contact);
  const setNumbers = (to, numbers) => numbers.forEach((x, i) => view.setFloat64(to + 8 * i, x, true));
  view.setUint32(at, STATUSES[status], true);
  view.setUint32(at + 4, points.length, true);
  setNumbers(at + 8, [signed_distance, ...normal, modelDistance]);
  points.forEach(({ position, normal: ofPoint, depth }, i) =>
    setNumbers(at + 48 + 56 * i, [...position, ...ofPoint, depth]));
}

function writeCast(view, at, { status, fraction = NaN, normal = [0, 0, 0] }) {
  view.setUint32(at, ['touch', 'never', 'unsupported', 'failed'].indexOf(status), true);
  [fraction, ...normal].forEach((x, i) => view.setFloat64(at + 8 + 8 * i, x, true));
}

// The contact if it is one: a member that is left out would travel as a NaN, or not at all.
function checked(contact) {
  if (!contact) return { signed_distance: 0, normal: [0, 0, 0], points: [] };
  const { points = [] } = contact;
  if (points.length > MAX_POINTS) {
    throw new RangeError(`${points.length} contact points, more than ${MAX_POINTS}`);
  }
  const isVector = (v) => v?.length === 3 && [...v].every((x) => typeof x === 'number');
  const isPoint = ({ position, normal, depth }) =>
    isVector(position) && isVector(normal) && typeof depth === 'number';
  if (typeof contact.signed_distance !== 'number' || !isVector(contact.normal) ||
      !points.every(isPoint)) {
    throw new TypeError(`not a contact: ${JSON.stringify(contact)}`);
  }
  return { ...contact, points };
}

// ---- lines -------------------------------------------------------------------------------------

function answerLines(engine) {
  for (let line; (line = readLine()) !== null;) {
    const { op, ticket, passes, entries } =
      JSON.parse(line, (key, value) => NOT_FINITE.get(value) ?? value);
    if (op === 'prepare') {
      const supported = entries.map(({ handle, a, b, threshold, parameter }) =>
        engine.prepare(handle, a, b, threshold, parameter));
      const roundings = engine.candidate.roundings &&
        entries.map(({ handle }) => engine.roundings(handle));
      writeLine({ ticket, supported, roundings });
    } else if (op === 'query') {
      const answers = entries.map((entry) => engine.query(questionOf(entry), describe));
      writeLine({ ticket, answers });
    } else if (op === 'cast') {
      const casts = entries.map(({ sweep, ...entry }) =>
        engine.cast({ ...questionOf(entry), sweep }));
      writeLine({ ticket, casts });
    } else if (op === 'time') {
      writeLine({ ticket, nanoseconds: engine.time(passes, entries.map(questionOf)) });
    } else if (op === 'release') {
      entries.forEach((handle) => engine.release(handle));
      writeLine({ ticket });
    } else {
      throw new Error(`no such operation: ${op}`);
    }
  }
}

const NOT_FINITE = new Map([['nan', NaN], ['inf', Infinity], ['-inf', -Infinity]]);

const questionOf = ({ handle, pose_a: poseA, pose_b: poseB, hint }) =>
  ({ handle, poseA, poseB, hint });

function describe({ status, contact, modelDistance = NaN }) {
  const described = { status };
  if (!Number.isNaN(modelDistance)) described.model_distance = modelDistance;
  if (!contact) return described;
  const { signed_distance, normal, points } = checked(contact);
  return { ...described, signed_distance, normal: [...normal],
    points: points.map(({ position, normal: ofPoint, depth }) =>
      ({ position: [...position], normal: [...ofPoint], depth })) };
}

// JSON with the numbers that JSON.stringify loses: -0, NaN and the infinities.
function toText(value) {
  if (typeof value === 'number') {
    if (Object.is(value, -0)) return '-0.0';
    if (Number.isFinite(value)) return String(value);
    return Number.isNaN(value) ? '"nan"' : value > 0 ? '"inf"' : '"-inf"';
  }
  if (Array.isArray(value)) return `[${value.map(toText).join(', ')}]`;
  if (value === null || typeof value !== 'object') return JSON.stringify(value);
  const members = Object.entries(value).filter(([, member]) => member !== undefined);
  const texts = members.map(([name, member]) => `${JSON.stringify(name)}: ${toText(member)}`);
  return `{${texts.join(', ')}}`;
}

// ---- standard input and output, synchronous ------------------------------------------------------

function write(bytes) {
  for (let done = 0; done < bytes.length;) {
    done += whenReady(() => fs.writeSync(output, bytes, done));
  }
}

function writeLine(message) {
  write(Buffer.from(`${toText(message)}\n`));
}

let unread = Buffer.alloc(0);  // what came with the last line and belongs to the next

// `size` bytes at the beginning of a buffer of their own; null at the end of input.
function read(size) {
  const bytes = new Uint8Array(size);
  let done = unread.copy(bytes);
  unread = unread.subarray(done);
  while (done < size) {
    const got = whenReady(() => fs.readSync(0, bytes, done, size - done, null));
    if (got === 0) return null;
    done += got;
  }
  return bytes;
}

// A line without its end; null at the end of input.
function readLine() {
  const pieces = [];
  for (;;) {
    const end = unread.indexOf(10);
    if (end >= 0) {
      pieces.push(unread.subarray(0, end));
      unread = unread.subarray(end + 1);
      return Buffer.concat(pieces).toString();
    }
    pieces.push(unread);
    unread = Buffer.alloc(1 << 16);
    unread = unread.subarray(0, whenReady(() => fs.readSync(0, unread, 0, unread.length, null)));
    if (unread.length === 0) return null;
  }
}

// Retries what a descriptor that does not block refuses for the moment.
function whenReady(operation) {
  for (;;) {
    try {
      return operation();
    } catch (error) {
      if (error.code === 'EOF') return 0;
      if (error.code !== 'EAGAIN') throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 1);
    }
  }
}
