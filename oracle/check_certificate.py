#!/usr/bin/env python3
"""Checks a certificate of `touchstone certify`: check_certificate.py FILE...

A certificate proves lo <= signed distance <= hi of two bodies (format and proof are in
docs/certificate.md). Rational arithmetic only; nothing is shared with the program that wrote it.
Prints accepted or rejected with the reason for each file; exit code 1 unless all are accepted.
"""

import json
import sys
from fractions import Fraction
from math import isqrt

ROOT_BITS = 600  # roots are bounded to a relative 2^-600 or better


class Rejected(Exception):
    pass


def require(condition, reason):
    if not condition:
        raise Rejected(reason)


def vector(texts, length=3):
    require(len(texts) == length, f"no vector of {length}: {texts}")
    return [Fraction(text) for text in texts]


def dot(v, w):
    return sum(x * y for x, y in zip(v, w))


def root(x, above=False):
    """The root of x >= 0, not less (above) or not more than exact."""
    grains = isqrt(x.numerator * x.denominator << 2 * ROOT_BITS) + above
    return Fraction(grains, x.denominator << ROOT_BITS)


def same_numbers(floats, fractions):
    """Is the input in hexadecimal floats, number by number, the one in fractions?"""
    if isinstance(floats, dict):
        return floats.keys() == fractions.keys() and all(
            same_numbers(value, fractions[key]) for key, value in floats.items())
    if isinstance(floats, list):
        return len(floats) == len(fractions) and all(map(same_numbers, floats, fractions))
    return floats == fractions or Fraction(float.fromhex(floats)) == Fraction(fractions)


class Body:
    """A shape in its own frame, and the exact rotation R(q)/|q|^2 of its pose."""

    def __init__(self, shape, pose):
        self.kind = shape["shape"]
        if self.kind == "plane":
            self.normal = vector(shape["normal"])
            self.displacement = Fraction(shape["displacement"])
        elif self.kind == "box":
            self.half_extents = vector(shape["half_extents"])
            require(min(self.half_extents) > 0, "a box without size")
        else:  # a sphere is a capsule of half length zero
            require(self.kind in ("cylinder", "capsule", "sphere"), f"no shape: {self.kind}")
            self.radius = Fraction(shape["radius"])
            self.half_length = Fraction(shape.get("half_length", 0))
            require(self.radius > 0 and self.half_length >= 0, f"a {self.kind} without size")
        self.centre = vector(pose["position"])
        w, x, y, z = vector(pose["orientation"], 4)
        s = w * w + x * x + y * y + z * z
        columns = [[w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)],
                   [2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)],
                   [2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z]]
        self.axes = [[c / s for c in column] for column in columns]

    def to_world(self, v):
        return [dot(row, v) for row in zip(*self.axes)]

    def to_local(self, v):
        return [dot(axis, v) for axis in self.axes]

    def contains(self, p):
        x, y, z = p
        across = x * x + y * y
        if self.kind == "cylinder":
            return abs(z) <= self.half_length and across <= self.radius**2
        if self.kind == "box":
            return all(abs(c) <= h for c, h in zip(p, self.half_extents))
        if self.kind == "plane":
            return dot(self.normal, p) <= self.displacement
        beyond = max(abs(z) - self.half_length, 0)
        return across + beyond**2 <= self.radius**2

    def support_above(self, n):
        """At least the largest p·n over the body's points p about its centre, n in the world."""
        x, y, z = self.to_local(n)
        if self.kind == "box":
            return sum(h * abs(c) for h, c in zip(self.half_extents, (x, y, z)))
        square = x * x + y * y + (0 if self.kind == "cylinder" else z * z)
        return self.half_length * abs(z) + self.radius * root(square, above=True)


def difference(a, b, entry):
    """w = a - b in the world for a point of each body, given in its frame."""
    p, q = vector(entry["a"]), vector(entry["b"])
    require(a.contains(p), "a point outside body a")
    require(b.contains(q), "a point outside body b")
    return [x + y - u - v for x, y, u, v in zip(a.centre, a.to_world(p), b.centre, b.to_world(q))]


def product_at_most(product, bound, square):
    """Is product <= bound * root(square), decided by squares?"""
    p, b = product**2, bound**2 * square
    return product <= 0 and p >= b if bound < 0 else product <= 0 or p <= b


def check_lower(a, b, n, lo):
    """One direction: lo <= g(n/|n|)."""
    require(any(n), "the zero vector as normal")
    square = dot(n, n)
    gap = dot(n, [x - y for x, y in zip(a.centre, b.centre)]) - a.support_above(n)
    if b.kind == "plane":
        normal = b.to_world(b.normal)  # along any other direction there is no gap
        scale = dot(n, normal) / dot(normal, normal)
        require(scale > 0 and n == [scale * x for x in normal], "not the plane's normal")
        gap -= scale * b.displacement
    else:
        gap -= b.support_above(n)
    require(lo * root(square, above=lo > 0) <= gap, "the gap along the normal is below lo")


def check_cover(paths):
    """Disjoint cells whose areas sum up to the cube's: six faces, quarters of quarters."""
    paths = sorted(paths)
    for path, following in zip(paths, paths[1:] + [""]):
        require(path and path[0] in "012345" and not path[1:].strip("0123"), f"no cell: {path}")
        require(not following.startswith(path), f"cell {following} twice")
    area = sum(Fraction(1, 4 ** (len(path) - 1)) for path in paths)
    require(area == 6, "the cells do not cover all directions")


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


def check_upper(a, b, n, hi, certificate):
    """Points of both bodies: g(m) <= (a - b)·m for every unit vector m."""
    if "pair" in certificate:
        w = difference(a, b, certificate["pair"])
        along = product_at_most(dot(w, n), hi, dot(n, n)) if b.kind == "plane" else False
        require(along or hi >= 0 and dot(w, w) <= hi**2, "the points are farther apart than hi")
    else:
        require(hi <= 0, "cells prove overlap only")
        check_cover([entry["cell"] for entry in certificate["cells"]])
        for entry in certificate["cells"]:
            w = difference(a, b, entry)
            for m in corners(entry["cell"]):
                bounded = product_at_most(dot(w, m), hi, dot(m, m))
                require(bounded, f"hi does not bound cell {entry['cell']}")


def check(certificate):
    """The proven ends. Raises Rejected."""
    require(certificate["schema"] == "touchstone-certificate-1", "another schema")
    exact = certificate["exact"]
    require(same_numbers(certificate["configuration"], exact), "the two forms of the input differ")
    a, b = Body(exact["a"], exact["pose_a"]), Body(exact["b"], exact["pose_b"])
    require(a.kind == "cylinder", "body a is no cylinder")
    (lo, hi), n = vector(certificate["signed_distance"], 2), vector(certificate["normal"])
    grain = Fraction(certificate["grain"])
    require(lo % grain == 0 == hi % grain, "lo or hi is no multiple of the grain")
    check_lower(a, b, n, lo)
    check_upper(a, b, n, hi, certificate)
    return lo, hi


def main(files):
    good = bool(files)
    for name in files:
        try:
            with open(name, encoding="utf-8") as file:
                lo, hi = check(json.load(file))
            print(f"{name}: accepted: {float(lo):.17g} m, width {float(hi - lo):.2g} m")
        except Exception as error:  # what cannot be read proves nothing either
            good = False
            print(f"{name}: rejected: {error if isinstance(error, Rejected) else repr(error)}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
