#!/usr/bin/env python3
"""Forges certificates and shows them to check_certificate.py: forge_certificates.py PROGRAM.

True certificates of all pairs are changed at random: their text, numbers, cells, configurations.
Every forgery must be rejected with a reason, or still be true: `touchstone solve` has to accept its
configuration and to find a signed distance that its ends enclose.

Exit code: 0 it is so, 1 it is not. A forgery is remade from the seed and its number.
"""

import argparse
import json
import math
import random
import subprocess
import sys
from collections import Counter
from fractions import Fraction

sys.dont_write_bytecode = True
import check_certificate as checker  # noqa: E402

PAIRS = ("plane", "sphere", "capsule", "cylinder", "box")
CLASSES = ("general-separated", "general-shallow", "general-deep", "touching")
# A slab as a hull, and a triangle: apart, shallow and deep.
HULLS = ([[x, y, z] for x in (-1, 1) for y in (-2, 2) for z in (-0.5, 0.5)],
         [[-1, -1, 0], [2, 0, 0.25], [0, 3, 0.125]])
HEIGHTS = (2, 1.375, 0.5)
WIDTHS = ("1e-6", "1e-30")  # the wide ones have few cells, and are checked in little time
TRUTH_WIDTH = "1e-100"  # far below any grain: what is false by a grain is seen


def certified(program, subject, width, line=""):
    run = subprocess.run([program, "replay", "--certify", subject, "--width", width,
                          "--cells", "400"], input=line.encode(), stdout=subprocess.PIPE, check=True)
    return run.stdout.strip()


def certificates(program):
    """The texts of true certificates."""
    for vertices in HULLS:
        for height in HEIGHTS:
            yield certified(program, "-", WIDTHS[0], json.dumps({
                "a": {"shape": "cylinder", "radius": 0.5, "half_length": 1.25},
                "pose_a": {"position": [0.25, 0.125, height], "orientation": [4, 1, 2, 1]},
                "b": {"shape": "convex", "vertices": vertices}}))
    for pair in PAIRS:
        for name in CLASSES:
            for width in WIDTHS if name == "general-deep" else WIDTHS[:1]:
                yield certified(program, f"cylinder-{pair}/{name}/20261122/0", width)


# Changes of the text.

EXTRA = (b"0", b"9", b"-", b"+", b".", b"_", b" ", b"\0", b"e9", b"/3", b'"', b",", b"[", b"}", b"null",
         b"1e999999999", b"\xef\xbb\xbf", "\u0663".encode())


def replaced(text, at, count, by):
    return text[:at] + by + text[at + count:]


def exchanged(text, at, rng):
    count = rng.randrange(1, 20)
    other = rng.randrange(at + count, len(text) + 20)
    first, second = text[at:at + count], text[other:other + count]
    return replaced(replaced(text, other, count, first), at, count, second)


def other_digit(text, at, rng):
    digits = [k for k in range(at, min(at + 200, len(text))) if text[k:k + 1].isdigit()]
    return replaced(text, rng.choice(digits or [at]), 1, rng.choice(b"0123456789").to_bytes(1, "big"))


def member_twice(text, at, rng):
    value = json.loads(text)
    name = rng.choice(list(value))
    changed = other_value(value[name], rng) if rng.random() < 0.5 else value[name]
    member = f"{json.dumps(name)}:{json.dumps(changed)}".encode()
    return rng.choice((b"{" + member + b"," + text[1:], text[:-1] + b"," + member + b"}"))


TEXT_CHANGES = (
    exchanged, other_digit, member_twice,
    lambda text, at, rng: replaced(text, at, 1, bytes([rng.randrange(256)])),
    lambda text, at, rng: replaced(text, at, 1, bytes([text[at] ^ 1 << rng.randrange(8)])),
    lambda text, at, rng: text[:at],
    lambda text, at, rng: replaced(text, at, rng.randrange(1, 40), b""),
    lambda text, at, rng: replaced(text, at, 0, rng.choice(EXTRA)),
    lambda text, at, rng: replaced(text, at, 0, text[at:at + rng.randrange(1, 200)]))


# Changes of values. They act on the parsed certificate.

def rational(text):
    """A number that may have been forged already: Fraction would never end with a huge exponent."""
    return checker.rational(text, "number")


def places(value, path=()):
    """All places of a value, those of cells no oftener than the rest."""
    if path:
        yield path
    if isinstance(value, dict):
        for name in value:
            yield from places(value[name], (*path, name))
    elif isinstance(value, list):
        for i, x in enumerate(value if len(value) < 10 else value[:3]):
            yield from places(x, (*path, i))


def other_value(value, rng):
    if isinstance(value, str) and rng.random() < 0.85:
        return other_number(value, rng)
    return rng.choice((None, True, False, 0, 1, -1, 0.5, 1e308, "", "0", "1", [], {}, [value],
                       {"a": value}, "1e999999999", "nan", "Infinity", *checker.SHAPES))


def other_number(text, rng):
    """The text of a number, a little different."""
    at = rng.randrange(len(text) + 1)
    numerator, slash, denominator = text.partition("/")
    plus_one = str(int(numerator) + rng.choice((-1, 1))) if numerator.lstrip("-").isdigit() else "1"
    return rng.choice((
        lambda: text[:at] + rng.choice("0123456789abf") + text[at + 1:],
        lambda: text[:at] + rng.choice("0123456789") + text[at:],
        lambda: text[:at] + text[at + 1:],
        lambda: text[1:] if text.startswith("-") else "-" + text,
        lambda: plus_one + slash + denominator,
        lambda: (denominator or "1") + "/" + numerator,
        lambda: text + rng.choice(("0", "/2", "e1", "p1", " ", ".", "_0", "e999999999", "\u0660")),
        lambda: rng.choice((" ", "+", "0", "0x")) + text,
        lambda: text.replace("0x", ""),
        lambda: "0"))()


def change_place(value, rng):
    *path, last = rng.choice(list(places(value)))
    at = value
    for name in path:
        at = at[name]
    kind = rng.random()
    if kind < 0.7:
        at[last] = other_value(at[last], rng)
    elif kind < 0.8 and isinstance(at, dict):
        del at[last]
    elif kind < 0.9 and isinstance(at, dict):
        name = rng.choice(("half_length", "radius", "normal", "id", "pair", "cells", "A", ""))
        at[name] = at[last]
    elif isinstance(at, list):
        at.insert(last, at[rng.randrange(len(at))])
    else:
        other = rng.choice(list(at))
        at[last], at[other] = at[other], at[last]


def change_configuration(value, rng):
    """Another configuration with this proof: one of its doubles, or a shape."""
    configuration = value["configuration"]
    if rng.random() < 0.15:
        name = rng.choice("ab")
        sizes = {"radius": "0x1p-1", "half_length": "0x1p+0", "half_extents": ["0x1p+0"] * 3,
                 "normal": ["0x0p+0", "0x0p+0", "0x1p+0"], "displacement": "0x0p+0",
                 "vertices": HULLS[1]}
        kind = rng.choice(list(checker.SHAPES))
        old = configuration[name]
        configuration[name] = {"shape": kind, **{size: old.get(size, sizes[size])
                                                 for size in checker.SHAPES[kind]}}
        return
    numbers = [path for path in places(configuration) if path[-1] != "shape"]
    *path, last = rng.choice(numbers)
    at = configuration
    for name in path:
        at = at[name]
    if not isinstance(at[last], str):
        return
    x = float.fromhex(at[last])
    y = rng.choice((math.nextafter(x, math.inf), math.nextafter(x, -math.inf), -x, 2 * x, x / 2,
                    0.0, 5e-324, 1e308, x + rng.uniform(-1, 1), x * (1 + rng.uniform(-1e-6, 1e-6))))
    at[last] = rng.choice((y.hex(), y.hex(), repr(y), y, f"{y:.5g}"))


def with_numbers(value, other):
    """A configuration with `other` of each of its numbers in their place."""
    if isinstance(value, dict):
        return {name: with_numbers(x, other) for name, x in value.items()}
    if isinstance(value, list):
        return [with_numbers(x, other) for x in value]
    return value if value in checker.SHAPES else other(value)


def respell_configuration(value, rng):
    """The same doubles in other words."""
    def respelled(x):
        y = float.fromhex(x)
        return rng.choice((x, y.hex(), repr(y), y, x.upper(), f"{y:.40g}"))
    value["configuration"] = with_numbers(value["configuration"], respelled)


def exchange_bodies(value, rng):
    names = {"a": "b", "b": "a", "pose_a": "pose_b", "pose_b": "pose_a"}
    for member in ("configuration", "exact", "pair")[:rng.choice((2, 3))]:
        if member in value:
            value[member] = {names[name]: x for name, x in value[member].items()}
    if rng.random() < 0.5:
        value["normal"] = [str(-rational(x)) for x in value["normal"]]


def move_end(value, rng):
    which = rng.randrange(2)
    grain = rational(value["grain"])
    steps = rng.choice((-1, 1)) * rng.choice((1, 1, 2, 3, 2**20, 2**40, 10**30))
    if rng.random() < 0.2:  # with a grain that allows it
        grain /= 10**6
        value["grain"] = str(grain)
    ends = value["signed_distance"]
    ends[which] = str(rational(ends[which]) + steps * grain)
    if rng.random() < 0.1:
        ends.reverse()


def change_cells(value, rng):
    cells = value.get("cells")
    if not cells:
        return change_place(value, rng)
    i, j = rng.randrange(len(cells)), rng.randrange(len(cells))
    cell, other = cells[i], cells[j]

    def quartered(quarters):
        cells[i:i + 1] = [{**cell, "cell": cell["cell"] + k} for k in quarters]

    rng.choice((
        lambda: quartered("0123"),
        lambda: quartered("0122"),
        lambda: cells.remove(cell),
        lambda: cells.append(dict(cell)),
        lambda: cells.__setitem__(i, dict(other)),
        lambda: cells.__setitem__(i, {**cell, "cell": other["cell"]}),
        lambda: (cells.__setitem__(i, {**cell, "cell": other["cell"]}),
                 cells.__setitem__(j, {**other, "cell": cell["cell"]})),
        lambda: cell.update(cell=cell["cell"][:-1]),
        lambda: cell.update(cell=cell["cell"] + rng.choice("01234")),
        lambda: cell.update(cell=rng.choice("0123456") + cell["cell"][1:]),
        lambda: cell.update(a=other["a"]),
        lambda: cell.update(b=other["b"]),
        lambda: cell.update(a=other["b"], b=other["a"]),
        lambda: cell.update(a=[str(2 * rational(x)) for x in cell["a"]]),
        lambda: cell.update(a=[str(-rational(x)) for x in cell["a"]]),
        lambda: cell["b"].__setitem__(rng.randrange(3), cell["b"][rng.randrange(3)]),
        lambda: rng.shuffle(cells)))()


def narrow(value, rng):
    """What a hostile prover does: ends closer together than is true, and a proof bent to fit."""
    lo, hi = map(rational, value["signed_distance"])
    grain = rational(value["grain"])
    step = math.ceil(max(abs(hi), 1000 * grain) / rng.choice((1000, 10, 2)) / grain) * grain
    longer = 1 + rng.choice((Fraction(1, 500), Fraction(1, 5), Fraction(2)))
    if rng.random() < 0.2:
        lo, hi = lo + step, max(hi, lo + step)
        value["normal"] = [str(longer * rational(x)) for x in value["normal"]]
    else:
        lo, hi = min(lo, hi - step), hi - step
        if "pair" in value or rng.random() < 0.5:  # points outside their bodies
            for entry in value.get("cells", [value.get("pair")]):
                for name in "ab":
                    entry[name] = outside(entry[name], longer)
        else:  # cells that do not hold are left out, or replaced by some that do
            holding = [entry for entry in value["cells"] if holds(value, entry, hi)]
            missing = [len(entry["cell"]) for entry in value["cells"] if entry not in holding]
            largest = min(holding, key=lambda entry: len(entry["cell"]))
            replaced = [{**largest, "cell": largest["cell"].ljust(n, "0")} for n in missing]
            value["cells"] = holding + (replaced if rng.random() < 0.5 else [])
    value["signed_distance"] = [str(lo), str(hi)]


def outside(point, longer):
    """A point beyond one: longer, or of a hull with a negative weight."""
    if isinstance(point, list):
        return [str(longer * rational(x)) for x in point]
    first, *others = point
    return {**{name: str(-rational(point[name]) / 8) for name in others}, first: str(longer)}


def holds(value, entry, hi):
    configuration = checker.read_configuration(value["configuration"])
    a, b = (checker.Body(name, configuration) for name in "ab")
    w, d = checker.difference(a, b, entry, "")
    return all(checker.product_at_most(checker.dot(w, m), hi * d, checker.dot(m, m))
               for m in checker.corners(entry["cell"]))


def another_proof(value, rng, others):
    """The configuration, ends, or proof of another certificate."""
    other = json.loads(rng.choice(others))
    for name in rng.choice((("configuration", "exact"), ("cells",), ("pair",), ("normal",),
                            ("signed_distance", "grain"), ("signed_distance",),
                            ("cells", "normal"))):
        value.pop(name, None)
        if name in other:
            value[name] = other[name]


def exact_form(configuration):
    """A configuration's numbers as fractions; a pose that is missing is the identity."""
    def exact(x):
        return str(Fraction(float.fromhex(x) if "x" in str(x).lower() else float(x)))

    poses = {name: {"position": [0] * 3, "orientation": [1, 0, 0, 0], **configuration.get(name, {})}
             for name in ("pose_a", "pose_b")}
    return with_numbers({**configuration, **poses}, exact)


def repair(value):
    """Makes `exact` and `width` agree with the rest, so that the proof has to decide."""
    try:
        value["exact"] = exact_form(value["configuration"])
        value["width"] = None
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError):
        pass  # there is nothing to agree with


def forgery(number, seed, originals):
    """The text of a certificate, changed."""
    rng = random.Random(f"{seed}/{number}")
    text = rng.choice(originals)
    if rng.random() < 0.3:
        change = rng.choice(TEXT_CHANGES)
        # The cells are most of a text, and all alike.
        start = rng.choice((0, *map(text.index, (b'"configuration"', b'"exact"', b'"grain"'))))
        end = min(len(text), start + 400) if start else len(text)
        return change(text, rng.randrange(start, end), rng)
    value = json.loads(text)
    changes = (change_place, change_configuration, respell_configuration, exchange_bodies, move_end,
               change_cells, narrow, another_proof)
    change = rng.choice(changes)
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        if change is another_proof:
            change(value, rng, originals)
        else:
            try:
                change(value, rng)
            except (ValueError, TypeError, KeyError, AttributeError,
                    IndexError, ZeroDivisionError, checker.Rejected):
                pass  # what was changed before is not there to be changed again
        change = rng.choice(changes)
        if rng.random() < 0.7:
            repair(value)
    return json.dumps(value).encode()


def false_claims(program, claims):
    """Those of (configuration, lo, hi) that `touchstone solve` does not confirm, and why."""
    claims = list(claims)
    if not claims:
        return
    run = subprocess.run([program, "solve", "--width", TRUTH_WIDTH, "--candidates", "reference"],
                         input="".join(c + "\n" for c, _, _ in claims).encode(),
                         stdout=subprocess.PIPE, check=False)
    answers = run.stdout.decode().splitlines()
    for claim, answer in zip(claims, answers + ["{}"] * (len(claims) - len(answers))):
        answer = json.loads(answer)
        if "truth" not in answer:
            yield claim, answer.get("error", f"solve ended with {run.returncode}")
            continue
        lo, hi = map(Fraction, answer["truth"]["signed_distance"])
        if not (claim[1] <= hi and lo <= claim[2]):
            yield claim, f"the truth is {float(lo)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="touchstone")
    parser.add_argument("--count", type=int, default=1000, help="how many (default: 1000)")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--first", type=int, default=0, help="number of the first forgery")
    parser.add_argument("--show", action="store_true", help="print the forgeries, check none")
    options = parser.parse_args()

    originals = list(certificates(options.program))
    for text in originals:
        good, verdict = checker.verdict(text)
        assert good, verdict
    outcomes, claims, failed = Counter(), {}, False
    for number in range(options.first, options.first + options.count):
        text = forgery(number, options.seed, originals)
        if options.show:
            sys.stdout.buffer.write(text + b"\n")
            continue
        try:
            lo, hi = checker.check(checker.parse(text))
        except checker.Rejected as reason:
            assert str(reason)
            outcomes["rejected"] += 1
            continue
        outcomes["accepted"] += 1
        value = json.loads(text)
        if value["exact"] != exact_form(value["configuration"]):
            failed = True
            print(f"forgery {number} (seed {options.seed}) is accepted with another exact form")
        claims.setdefault((json.dumps(value["configuration"]), lo, hi), number)
    for claim, reason in false_claims(options.program, claims):
        failed = True
        print(f"forgery {claims[claim]} (seed {options.seed}) is accepted, but {reason}:\n  "
              f"{float(claim[1])} to {float(claim[2])} of {claim[0]}")
    if not options.show:
        print(f"{options.count} forgeries of {len(originals)} certificates: {outcomes['rejected']} "
              f"rejected, {outcomes['accepted']} accepted with {len(claims)} different claims, "
              f"{'NOT ' if failed else ''}all of them true")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
