#!/usr/bin/env python3
"""Checks certificates of `touchstone replay --certify`: check_certificate.py FILE...

A certificate proves lo <= signed distance <= hi of two bodies, or how far one may move before it
comes next to the other; oracle/truth.md has the format, the proof and the limits. All arithmetic is
rational, and nothing is shared with the program that wrote the certificate. Prints what each file
proves, or why it is rejected. Exit code: 0 all are accepted, 1 one is rejected, 2 one cannot be read.
"""

import json
import os
import re
import sys
from decimal import Context, Decimal
from fractions import Fraction
from math import inf, isfinite, isqrt, lcm

# Limits of time and memory; what `touchstone replay --certify` writes stays far below them.
MAX_BYTES = 16 * 2**20  # of a file
MAX_DIGITS = 4000  # of a numerator or a denominator
MAX_CELLS = 100_000
MAX_LEVEL = 1000  # quarterings from a face of the cube down to a cell
MAX_VERTICES = 4096
MAX_PARTS = 1000  # of a sweep
ROOT_BITS = 600  # roots are bounded to a relative 2^-600
MAX_SPIN = 100  # radians
TURN_ERROR = Fraction(1, 2**100)  # of a turned quaternion, relative

FRACTION = re.compile(rf"(-?[0-9]{{1,{MAX_DIGITS}}})(?:/([1-9][0-9]{{0,{MAX_DIGITS - 1}}}))?")
CELL = re.compile(rf"[0-5][0-3]{{0,{MAX_LEVEL}}}")
VERTEX = re.compile(r"0|[1-9][0-9]{0,3}")
# What the C function strtod reads without leaving a rest: so does `touchstone solve`.
DECIMAL = re.compile(r"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?")
HEXADECIMAL = re.compile(
    r"[+-]?0[xX]([0-9a-fA-F]+(\.[0-9a-fA-F]*)?|\.[0-9a-fA-F]+)([pP][+-]?[0-9]+)?")

SHAPES = {"cylinder": ("radius", "half_length"), "capsule": ("radius", "half_length"),
          "sphere": ("radius",), "box": ("half_extents",), "plane": ("normal", "displacement"),
          "convex": ("vertices",)}
ROUNDED = ("cylinder", "box", "convex")  # may have a rounding
LENGTHS = {"half_extents": 3, "normal": 3, "position": 3, "sweep": 3, "spin": 3, "orientation": 4}  # the rest are numbers
IDENTITY = {"position": [0.0, 0.0, 0.0], "orientation": [1.0, 0.0, 0.0, 0.0]}


class Rejected(Exception):
    pass


def require(condition, *reason):
    """`reason` is a sentence, or a field with its value and what it must be."""
    if not condition:
        field, *value = reason
        raise Rejected(f"{field} is {shown(value[0])}: must be {value[1]}" if value else field)


def shown(value):
    if isinstance(value, (dict, list)):
        return "an object" if isinstance(value, dict) else f"an array of {len(value)}"
    return json.dumps(value[:57] + "..." if isinstance(value, str) and len(value) > 60 else value)


# Reading. `field` is the value's place in the file, for the reason of a rejection.

def parse(data):
    """The JSON value of a file's bytes. Every number in it is a finite float."""
    def members_once(pairs):
        names = set()
        for name, _ in pairs:
            require(name not in names, f"a member is given twice: {name[:60]!a}")
            names.add(name)
        return dict(pairs)

    def finite(text):
        number = float(text)
        require(isfinite(number), "a number", text, "finite")
        return number

    require(len(data) <= MAX_BYTES, f"the file is longer than {MAX_BYTES} bytes")
    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=members_once, parse_int=finite,
                          parse_float=finite, parse_constant=finite)
    except (ValueError, RecursionError) as error:
        raise Rejected(f"the file is not JSON: {error}") from None


def members(value, field, required, optional=()):
    """Requires an object with these members and no others."""
    require(isinstance(value, dict), field, value, "an object")
    for name in required:
        require(name in value, f"{field}.{name} is missing")
    for name in value:
        require(name in required or name in optional,
                f"{field} has a member that is not known: {name[:60]!a}")


def array(value, field, length, read):
    require(isinstance(value, list) and len(value) == length,
            field, value, f"an array of {length} numbers")
    return [read(x, f"{field}[{i}]") for i, x in enumerate(value)]


def double(value, field):
    """A number of the configuration: exactly the double that `touchstone solve` reads."""
    result = value
    if isinstance(value, str):
        hexadecimal = HEXADECIMAL.fullmatch(value)
        if hexadecimal or DECIMAL.fullmatch(value):
            try:
                result = float.fromhex(value) if hexadecimal else float(value)
            except OverflowError:
                result = inf
    require(isinstance(result, float), field, value, "a number, decimal or hexadecimal")
    require(isfinite(result), field, value, "finite")
    return Fraction(result)


def rational(value, field):
    """A number of the proof: a string such as "-3/8" or "2"."""
    match = FRACTION.fullmatch(value) if isinstance(value, str) else None
    require(match, field, value, f"a string with a fraction, -3/8, of at most {MAX_DIGITS} digits")
    return Fraction(int(match[1]), int(match[2] or 1))


def vector(value, field):
    return array(value, field, 3, rational)


def doubles(value, field, names):
    return {name: array(value[name], f"{field}.{name}", LENGTHS[name], double)
            if name in LENGTHS else double(value[name], f"{field}.{name}") for name in names}


def read_shape(value, field):
    require(isinstance(value, dict), field, value, "an object")
    kind = value.get("shape")
    require(isinstance(kind, str) and kind in SHAPES, field + ".shape", kind, " or ".join(SHAPES))
    members(value, field, ("shape", *SHAPES[kind]), ("rounding",) if kind in ROUNDED else ())
    rounding = doubles(value, field, ("rounding",) if "rounding" in value else ())
    require(min(rounding.values(), default=0) >= 0, f"{field}.rounding is negative")
    if kind == "convex":
        vertices = read_vertices(value["vertices"], field + ".vertices")
        return {"shape": kind, "vertices": vertices, **rounding}
    numbers = doubles(value, field, SHAPES[kind])
    if kind == "plane":
        require(any(numbers["normal"]), f"{field}.normal is zero")
    else:
        for name, x in numbers.items():
            least = min(x) if name in LENGTHS else x
            require(least > 0, f"{field}.{name} is not positive")
            require(least >= max(rounding.values(), default=0), f"{field}.rounding is above {name}")
    return {"shape": kind, **numbers, **rounding}


def read_vertices(value, field):
    require(isinstance(value, list) and 3 <= len(value) <= MAX_VERTICES,
            field, value, f"an array of 3 to {MAX_VERTICES} points")
    vertices = [array(v, f"{field}[{i}]", 3, double) for i, v in enumerate(value)]
    steps = [[x - y for x, y in zip(v, vertices[0])] for v in vertices]
    along = next(filter(any, steps), steps[0])
    require(any(any(cross(along, step)) for step in steps), f"{field} are on one line")
    return vertices


def read_pose(value, field):
    members(value, field, (), IDENTITY)
    pose = doubles({**IDENTITY, **value}, field, IDENTITY)
    require(any(pose["orientation"]), f"{field}.orientation is zero")
    return pose


def read_configuration(value):
    """The configuration that `touchstone solve` reads; rejects what it refuses."""
    members(value, "configuration", ("a", "b"), ("pose_a", "pose_b"))
    result = {name: read_shape(value[name], f"configuration.{name}") for name in ("a", "b")}
    for name in ("pose_a", "pose_b"):
        result[name] = read_pose(value.get(name, {}), f"configuration.{name}")
    require("cylinder" in (result["a"]["shape"], result["b"]["shape"]),
            "configuration.a.shape", result["a"]["shape"], "cylinder, or configuration.b.shape")
    return result


def require_same(exact, read, field):
    """Is `exact` what was read, with every number as a fraction in lowest terms?"""
    if isinstance(read, dict):
        members(exact, field, read)
        for name in read:
            require_same(exact[name], read[name], f"{field}.{name}")
    elif isinstance(read, list):
        array(exact, field, len(read), lambda x, path: x)
        for i, x in enumerate(read):
            require_same(exact[i], x, f"{field}[{i}]")
    else:
        require(exact == str(read), field, exact,
                "as in the configuration: the two forms of the input differ")


# Geometry. A vector is a list of three rational numbers.

def dot(v, w):
    return sum(x * y for x, y in zip(v, w))


def cross(v, w):
    return [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]


def integers(v):
    """Integers, and the least d > 0 with v = integers / d."""
    d = lcm(*(x.denominator for x in v))
    return [x.numerator * (d // x.denominator) for x in v], d


def root(x, above=False):
    """The root of x >= 0, not less (above) or not more than exact."""
    square = x.numerator * x.denominator << 2 * ROOT_BITS
    grains = isqrt(square)
    return Fraction(grains + (above and grains**2 < square), x.denominator << ROOT_BITS)


class Body:
    """A shape in its own frame, of a rounded one the core, and the exact rotation R(q)/|q|^2 of its
    pose."""

    def __init__(self, name, configuration):
        shape, pose = configuration[name], configuration["pose_" + name]
        self.name, self.kind, self.centre = name, shape["shape"], pose["position"]
        self.rounding = shape.get("rounding", Fraction(0))
        if self.kind == "plane":
            self.normal, self.displacement = shape["normal"], shape["displacement"]
            self.size = Fraction(0)
        elif self.kind == "box":
            self.half_extents = [h - self.rounding for h in shape["half_extents"]]
            self.size = max(shape["half_extents"])
        elif self.kind == "convex":
            self.vertices = shape["vertices"]  # those of a hull; as many as there are inside it
            axes = [list(map(float, axis)) for axis in zip(*self.vertices)]
            largest = max(max(axis) / 2 - min(axis) / 2 for axis in axes)
            self.size = Fraction(min(largest + float(self.rounding), sys.float_info.max))
        else:  # a sphere is a capsule of half length zero
            self.radius, self.half_length = shape["radius"], shape.get("half_length", Fraction(0))
            self.size = (max(self.radius, self.half_length) if self.kind == "cylinder"
                         else min(self.radius + self.half_length, Fraction(sys.float_info.max)))
            self.radius -= self.rounding
            self.half_length -= self.rounding
        w, x, y, z = integers(pose["orientation"])[0]
        self.square = w * w + x * x + y * y + z * z
        self.columns = [[w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)],
                        [2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)],
                        [2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z]]

    def to_world(self, v):
        """Integers, and their common denominator."""
        local, d = integers(v)
        return [dot(row, local) for row in zip(*self.columns)], d * self.square

    def to_local(self, v):
        return [dot(column, v) / self.square for column in self.columns]

    def contains(self, p):
        x, y, z = p
        if self.kind == "box":
            return all(abs(c) <= h for c, h in zip(p, self.half_extents))
        if self.kind == "plane":
            return dot(self.normal, p) <= self.displacement
        beyond = max(abs(z) - self.half_length, 0)
        if self.kind == "cylinder" and beyond > 0:
            return False
        return x * x + y * y + beyond * beyond <= self.radius**2

    def point(self, value, field):
        """A point in the body, given by its coordinates; in a hull as the mean of vertices, by
        weights that are not negative."""
        if self.kind != "convex":
            point = vector(value, field)
            require(self.contains(point), f"{field} is a point outside body {self.name}")
            return point
        require(isinstance(value, dict), field, value, "an object of vertices' weights")
        weights = {}
        for name, x in value.items():
            require(VERTEX.fullmatch(name) and int(name) < len(self.vertices),
                    field + " has a vertex that", name, "a vertex's number")
            weights[int(name)] = weight = rational(x, f"{field}.{name}")
            require(weight >= 0, f"{field}.{name} is negative: outside body {self.name}")
        total = sum(weights.values())
        require(total > 0, f"{field} has no weight")
        return [sum(x * self.vertices[i][k] for i, x in weights.items()) / total for k in range(3)]

    def support_above(self, n):
        """At least the largest p·n over the body's points p about its centre, n in the world."""
        x, y, z = self.to_local(n)
        if self.kind == "convex":
            return max(dot(v, (x, y, z)) for v in self.vertices)
        if self.kind == "box":
            return sum(h * abs(c) for h, c in zip(self.half_extents, (x, y, z)))
        square = x * x + y * y + (0 if self.kind == "cylinder" else z * z)
        return self.half_length * abs(z) + self.radius * root(square, above=True)


# The proof. Here body a is the cylinder and b the other body, whatever their names.

def difference(a, b, entry, field):
    """w = a - b in the world for a point of each body: integers, and their common denominator."""
    terms = [integers([x - y for x, y in zip(a.centre, b.centre)])]
    for body, sign in ((a, 1), (b, -1)):
        rotated, d = body.to_world(body.point(entry[body.name], f"{field}.{body.name}"))
        terms.append(([sign * x for x in rotated], d))
    common = lcm(*(d for _, d in terms))
    return [sum(v[i] * (common // d) for v, d in terms) for i in range(3)], common


def product_at_most(product, bound, square):
    """Is product <= bound * root(square), decided by squares?"""
    p, b = product**2, bound**2 * square
    return product <= 0 and p >= b if bound < 0 else product <= 0 or p <= b


def check_lower(a, b, n, lo):
    """One direction: lo <= g(n/|n|)."""
    require(any(n), "normal is the zero vector")
    gap = dot(n, [x - y for x, y in zip(a.centre, b.centre)]) - a.support_above(n)
    if b.kind == "plane":  # along any other direction than its normal there is no gap
        normal, d = b.to_world(b.normal)
        scale = dot(n, normal) / dot(normal, normal)
        require(scale > 0 and n == [scale * x for x in normal], "normal is not the plane's normal")
        gap -= scale * d * b.displacement
    else:
        gap -= b.support_above(n)
    require(lo * root(dot(n, n), above=lo > 0) <= gap, "the gap along the normal is below lo")


def check_cover(paths):
    """Disjoint cells whose areas sum up to the cube's: six faces, quarters of quarters."""
    for path in paths:
        is_cell = isinstance(path, str) and CELL.fullmatch(path)
        require(is_cell, "cell", path, f"a face, 0 to 5, then at most {MAX_LEVEL} quarters, 0 to 3")
    paths = sorted(paths)
    for path, following in zip(paths, paths[1:]):
        require(not following.startswith(path), f"cell {following[:60]} twice")
    deepest = max(map(len, paths), default=1)
    area = sum(4 ** (deepest - len(path)) for path in paths)
    require(area == 6 * 4 ** (deepest - 1), "the cells do not cover all directions")


def corners(path):
    """The four corners of a cell, scaled to integers."""
    u = v = 0
    for quarter in map(int, path[1:]):
        u, v = 2 * u + quarter % 2, 2 * v + quarter // 2
    side, axis = 1 << len(path) - 1, int(path[0]) // 2
    for i, j in ((0, 0), (1, 0), (0, 1), (1, 1)):
        m = [0, 0, 0]
        m[axis] = -side if path[0] in "135" else side
        m[(axis + 1) % 3] = 2 * (u + i) - side
        m[(axis + 2) % 3] = 2 * (v + j) - side
        yield m


def check_pair(a, b, n, hi, pair):
    """One pair of points bounds g by hi: along n over a plane, else along all directions."""
    members(pair, "pair", ("a", "b"))
    w, d = difference(a, b, pair, "pair")
    along = b.kind == "plane" and product_at_most(dot(w, n), hi * d, dot(n, n))
    require(along or hi >= 0 and dot(w, w) <= (hi * d)**2, "the points are farther apart than hi")


def check_cells(a, b, hi, cells):
    """With a pair of points for each cell, w·m <= hi |m| for every m in it, as at its corners."""
    require(hi <= 0, "cells prove overlap only")
    require(isinstance(cells, list) and len(cells) <= MAX_CELLS,
            "cells", cells, f"an array of at most {MAX_CELLS} cells")
    for i, entry in enumerate(cells):
        members(entry, f"cells[{i}]", ("cell", "a", "b"))
    check_cover([entry["cell"] for entry in cells])
    for i, entry in enumerate(cells):
        w, d = difference(a, b, entry, f"cells[{i}]")
        for m in corners(entry["cell"]):
            require(product_at_most(dot(w, m) * hi.denominator, hi.numerator * d, dot(m, m)),
                    f"hi does not bound cells[{i}]")


def check_width(width, exact, size):
    """Is it `exact` over the larger size, but for rounding? Null is said beyond all doubles."""
    require(width is None or isinstance(width, float), "width", width, "a number")
    error = abs(Fraction(width or 0) * size - exact)
    require(width is None or error <= exact / 2**40 + size / 2**1074, "width is not hi - lo")


def check_schema(certificate, schema):
    require(certificate["schema"] == schema, "schema", certificate["schema"], schema)


def bodies(configuration, n):
    """The cylinder, the other body, and the normal from that to the cylinder."""
    a, b = Body("a", configuration), Body("b", configuration)
    return (a, b, n) if a.kind == "cylinder" else (b, a, [-x for x in n])


def turned(q, spin, t):
    """The quaternion q after the turn by t * spin, to TURN_ERROR of its length: by the series of cosine
    and sine of half the angle, whose terms alternate. They are rounded by 2^-600 each, and none is
    larger than e^50."""
    one = 1 << ROOT_BITS
    square = int(t * t * dot(spin, spin) / 4 * one)  # of half the angle
    cosine = sine = k = 0
    term = one
    while term > one * TURN_ERROR / 8 or k * k * one < square:
        sign = -1 if k % 2 else 1
        cosine, sine, k = cosine + sign * term, sine + sign * term // (2 * k + 1), k + 1
        term = term * square // (one * (2 * k - 1) * 2 * k)
    w, v = Fraction(cosine, one), [t * x / 2 * Fraction(sine, one) for x in spin]
    along, across = dot(v, q[1:]), cross(v, q[1:])
    return [w * q[0] - along, *(w * x + q[0] * y + z for x, y, z in zip(q[1:], v, across))]


class Motion:
    """Of body a, by t times a sweep and a spin about its centre."""

    def __init__(self, configuration, sweep, spin):
        self.configuration, self.start = configuration, configuration["pose_a"]
        self.sweep, self.spin = sweep, spin
        body = Body("a", configuration)
        require(not any(spin) or body.kind == "cylinder",
                "configuration.a.shape", body.kind, "cylinder, of a body with a spin")
        require(dot(spin, spin) <= MAX_SPIN**2, f"configuration.spin is longer than {MAX_SPIN}")
        self.slack = Fraction(0)
        if any(spin):
            sizes = [body.radius + body.rounding, body.half_length + body.rounding]
            self.reach = root(dot(sizes, sizes), above=True)  # of A's farthest point from its centre
            axis = cross(spin, body.columns[2])
            self.axis_turns = root(dot(axis, axis), above=True) / body.square
            # Quaternions that differ by e of their length differ by an angle of at most 5 e.
            self.slack = 5 * TURN_ERROR * self.reach

    def at(self, t, normal):
        """As `bodies`. Those of A's points that turn are off by no more than the slack."""
        self.configuration["pose_a"] = {
            "position": [x + t * w for x, w in zip(self.start["position"], self.sweep)],
            "orientation": turned(self.start["orientation"], self.spin, t) if any(self.spin)
            else self.start["orientation"]}
        return bodies(self.configuration, normal)

    def check_apart(self, t, until, normal):
        """Is the gap along the normal positive from t to `until`? It is linear in between, or with
        a spin falls no faster than A's farthest point moves."""
        if not any(self.spin):
            for end in (t, until):
                a, b, n = self.at(end, normal)
                check_lower(a, b, n, a.rounding + b.rounding)
            return
        a, b, n = self.at(t, normal)
        require(any(n), "normal is the zero vector")
        turn, goes = cross(self.spin, n), dot(self.sweep, n)
        turns = min(root(dot(turn, turn), above=True) / root(dot(n, n)), self.axis_turns)
        falls = max(self.reach * turns - goes / root(dot(n, n), above=goes > 0), 0)
        check_lower(a, b, n, a.rounding + b.rounding + self.slack + falls * (until - t))


def check_cast(certificate):
    """How far body a moves, as a part of its sweep, without overlapping b, and how near it is to b
    there; None for the whole sweep. Raises Rejected."""
    is_near = "pair" in certificate
    members(certificate, "certificate", ("schema", "configuration", "exact", "apart",
                                         *(("pair", "distance") if is_near else ())))
    check_schema(certificate, "touchstone-cast-certificate-1")
    given = certificate["configuration"]
    require(isinstance(given, dict) and "sweep" in given, "configuration.sweep is missing")
    moves = doubles(given, "configuration", [name for name in ("sweep", "spin") if name in given])
    configuration = read_configuration({k: x for k, x in given.items() if k not in moves})
    require_same(certificate["exact"], {**configuration, **moves}, "exact")
    motion = Motion(configuration, moves["sweep"], moves.get("spin", [Fraction(0)] * 3))
    parts = certificate["apart"]
    require(isinstance(parts, list) and 0 < len(parts) <= MAX_PARTS,
            "apart", parts, f"an array of 1 to {MAX_PARTS} parts")
    t = Fraction(0)
    for i, part in enumerate(parts):
        members(part, f"apart[{i}]", ("until", "normal"))
        until = rational(part["until"], f"apart[{i}].until")
        require(t <= until <= 1, f"apart[{i}].until", part["until"], "in order, from 0 to 1")
        normal = vector(part["normal"], f"apart[{i}].normal")
        motion.check_apart(t, until, normal)
        t = until
    require(is_near or t == 1, "pair is missing, and the parts end before 1")
    if not is_near:
        return t, None
    distance = rational(certificate["distance"], "distance")
    require(distance >= motion.slack, "distance is negative, or too small to tell of a spin")
    a, b, n = motion.at(t, normal)
    check_pair(a, b, n, distance - motion.slack + a.rounding + b.rounding, certificate["pair"])
    return t, distance


def check(certificate):
    """The proven ends. Raises Rejected."""
    bound = "pair" if isinstance(certificate, dict) and "pair" in certificate else "cells"
    members(certificate, "certificate", ("schema", "configuration", "exact", "signed_distance",
                                         "grain", "width", "normal", bound))
    check_schema(certificate, "touchstone-certificate-1")
    configuration = read_configuration(certificate["configuration"])
    require_same(certificate["exact"], configuration, "exact")
    lo, hi = array(certificate["signed_distance"], "signed_distance", 2, rational)
    grain = rational(certificate["grain"], "grain")
    require(grain > 0 and lo % grain == 0 == hi % grain, "lo or hi is no multiple of the grain")
    a, b, n = bodies(configuration, vector(certificate["normal"], "normal"))  # from b to a
    rounding = a.rounding + b.rounding  # by which the cores are farther apart, along every direction
    check_lower(a, b, n, lo + rounding)
    if bound == "pair":
        check_pair(a, b, n, hi + rounding, certificate["pair"])
    else:
        check_cells(a, b, hi + rounding, certificate["cells"])
    check_width(certificate["width"], hi - lo, max(a.size, b.size))
    return lo, hi


def rounded(x, digits):
    """Text of a rational of any size, beyond that of doubles too."""
    return f"{Context(prec=digits).divide(Decimal(x.numerator), Decimal(x.denominator)):g}"


def verdict(data):
    """What a file's bytes prove, and whether they do."""
    try:
        certificate = parse(data)
        if isinstance(certificate, dict) and "apart" in certificate:
            part, distance = check_cast(certificate)
            near = "" if distance is None else f", then {rounded(distance, 2)} m apart at most"
            return True, f"accepted: free for {rounded(part, 17)} of its sweep{near}"
        lo, hi = check(certificate)
        return True, f"accepted: {rounded(lo, 17)} m, width {rounded(hi - lo, 2)} m"
    except Rejected as reason:
        return False, f"rejected: {reason}"


def main(files):
    code = 0 if files else 2
    for name in files:
        try:
            with open(name, "rb") as file:
                good, text = verdict(file.read(MAX_BYTES + 1))
            os.write(1, os.fsencode(f"{name}: {text}\n"))  # at once, so that a failure is seen here
            code = max(code, 0 if good else 1)
        except OSError as error:
            code = 2
            print(f"{ascii(name)}: {error.strerror}", file=sys.stderr)
    if not files:
        print(__doc__, file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
