#!/usr/bin/env python3
"""What check_certificate.py accepts and rejects: check_certificate_test.py PROGRAM.

Small certificates by hand, one fault in each. PROGRAM is `touchstone`, which has to read the same
configurations, number for number.
"""

import copy
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from fractions import Fraction
from math import cos, isqrt, pi, sin, sqrt

sys.dont_write_bytecode = True
import check_certificate as checker  # noqa: E402

PROGRAM = None
CHECKER = checker.__file__


def exact(value):
    """A configuration's `exact` form; numbers are floats."""
    if isinstance(value, dict):
        return {name: exact(x) for name, x in value.items()}
    if isinstance(value, list):
        return [exact(x) for x in value]
    return value if isinstance(value, str) else str(Fraction(value))


def pose(position, orientation=(1.0, 0.0, 0.0, 0.0)):
    return {"position": list(position), "orientation": list(orientation)}


def certificate(a, pose_a, b, pose_b, **proof):
    configuration = {"a": a, "pose_a": pose_a, "b": b, "pose_b": pose_b}
    return {"schema": "touchstone-certificate-1", "configuration": configuration,
            "exact": exact(configuration), "grain": "1", "width": 0.0, **proof}


def cylinder(radius=1.0, half_length=1.0):
    return {"shape": "cylinder", "radius": radius, "half_length": half_length}


def apart():
    """A rim point and a sphere's nearest point: 5 - 2 = 3, exactly."""
    return certificate(cylinder(), pose([0.0, 0.0, 0.0]), {"shape": "sphere", "radius": 2.0},
                       pose([4.0, 0.0, 5.0]), signed_distance=["3", "3"], normal=["-3", "0", "-4"],
                       pair={"a": ["1", "0", "1"], "b": ["-6/5", "0", "-8/5"]})


def above_plane():
    """A cap one metre above the plane, whose normal has length 2: it is x <= 1."""
    plane = {"shape": "plane", "normal": [0.0, 0.0, 2.0], "displacement": 2.0}
    return certificate(cylinder(), pose([0.0, 0.0, 3.0]), plane, pose([0.0, 0.0, 0.0]),
                       signed_distance=["1", "1"], normal=["0", "0", "1/7"],
                       pair={"a": ["0", "0", "-1"], "b": ["9", "9", "1"]})


def overlap():
    """A cylinder and a cube around one centre, two metres wide: -2, proven to be below -1 by the
    six faces of the cube of directions."""
    def face(k):
        along, back = ["0", "0", "0"], ["0", "0", "0"]
        along[k // 2], back[k // 2] = ("-1", "1") if k % 2 else ("1", "-1")
        return {"cell": str(k), "a": back, "b": along}
    return certificate(cylinder(), pose([0.0, 0.0, 0.0]),
                       {"shape": "box", "half_extents": [1.0, 1.0, 1.0]}, pose([0.0, 0.0, 0.0]),
                       signed_distance=["-2", "-1"], normal=["0", "0", "1"], width=1.0,
                       cells=[face(k) for k in range(6)])


def overlap_with_hull():
    """The same with the cube as a hull, and a point in it: corner k is on the upper side of axis i
    if bit i of k is set."""
    value = overlap()
    cube = [[1.0 if k >> i & 1 else -1.0 for i in range(3)] for k in range(8)]
    for name, numbers in (("configuration", cube + [[0.5, 0.0, 0.0]]),
                          ("exact", exact(cube + [[0.5, 0.0, 0.0]]))):
        value[name]["b"] = {"shape": "convex", "vertices": numbers}
    for k, entry in enumerate(value["cells"]):
        corners = [c for c in range(8) if (c >> k // 2 & 1) != k % 2]
        entry["b"] = {str(c): "3/4" for c in corners}
    return value


def let_down():
    """A can whose lower cap comes from 4 m, by 4 m, down to the top of a sphere at 2 m; its rim
    alone proves the first eighth."""
    value = certificate(cylinder(), pose([0.0, 0.0, 5.0]), {"shape": "sphere", "radius": 2.0},
                        pose([0.0, 0.0, 0.0]))
    value["configuration"]["sweep"], value["exact"]["sweep"] = [0.0, 0.0, -4.0], ["0", "0", "-4"]
    return {"schema": "touchstone-cast-certificate-1", "configuration": value["configuration"],
            "exact": value["exact"],
            "apart": [{"until": "1/8", "normal": ["0", "3", "4"]},
                      {"until": "1/2", "normal": ["0", "0", "2"]}],
            "pair": {"a": ["0", "0", "-1"], "b": ["0", "0", "2"]}, "distance": "0"}


def turning():
    """A coin of 1 m radius that turns by one radian about the x axis, towards which its rim comes down
    while its centre stays 2 m above a half-space."""
    value = certificate(cylinder(), pose([0.0, 0.0, 2.0]), {"shape": "plane", "normal": [0.0, 0.0, 1.0], "displacement": 0.0},
                        pose([0.0, 0.0, 0.0]))
    for form, sizes, sweep, spin in (("configuration", (1.0, 0.125), [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
                                     ("exact", ("1", "1/8"), ["0", "0", "0"], ["1", "0", "0"])):
        value[form]["a"].update(radius=sizes[0], half_length=sizes[1])
        value[form]["sweep"], value[form]["spin"] = sweep, spin
    return {"schema": "touchstone-cast-certificate-1", "configuration": value["configuration"],
            "exact": value["exact"], "apart": [{"until": "1", "normal": ["0", "0", "1"]}]}


def split(entry):
    return [{**entry, "cell": entry["cell"] + quarter} for quarter in "0123"]


def text(value):
    return json.dumps(value).encode()


def changed(value, path, new):
    value = copy.deepcopy(value)
    at = value
    for name in path[:-1]:
        at = at[name]
    at[path[-1]] = new
    return value


class CheckerTest(unittest.TestCase):
    def assert_accepted(self, value):
        good, verdict = checker.verdict(value if isinstance(value, bytes) else text(value))
        self.assertTrue(good, verdict)

    def assert_rejected(self, value, reason):
        good, verdict = checker.verdict(value if isinstance(value, bytes) else text(value))
        self.assertFalse(good, verdict)
        self.assertRegex(verdict, reason)


class Reading(CheckerTest):
    def test_members_that_are_missing_or_unknown_are_rejected(self):
        for name in apart():
            with self.subTest(name):
                value = apart()
                del value[name]
                self.assert_rejected(value, "is missing")
        for path in ((), ("configuration",), ("configuration", "a"), ("configuration", "b"),
                     ("configuration", "pose_a"), ("exact",), ("exact", "b"), ("pair",)):
            with self.subTest(path):
                self.assert_rejected(changed(apart(), (*path, "more"), "1"), "not known: 'more'")

    def test_a_sphere_has_no_half_length(self):
        value = changed(apart(), ("configuration", "b", "half_length"), 2.0)
        self.assert_rejected(changed(value, ("exact", "b", "half_length"), "2"), "'half_length'")

    def test_a_member_given_twice_is_rejected(self):
        whole = text(apart())
        for member in (b'"radius": 2.0', b'"grain": "1"', b'"normal": ["-3", "0", "-4"]'):
            self.assertIn(member, whole)
            self.assert_rejected(whole.replace(member, member + b", " + member), "given twice")

    def test_what_is_no_json_is_rejected(self):
        whole = text(apart())
        for data in (b"", b"null", b"[]", b"3", b'"x"', whole[:-1], whole + b"x", whole + b"\0",
                     b"\0" + whole, b"\xef\xbb\xbf" + whole, whole.replace(b"cyl", b"cy\xff"),
                     whole.decode().encode("utf-16"), whole.replace(b"0.0", b"00.0", 1),
                     whole.replace(b"0.0", b"+0.0", 1), whole.replace(b"0.0", b"0x0", 1),
                     whole.replace(b"0.0", b"NaN", 1), whole.replace(b"0.0", b"-Infinity", 1),
                     whole.replace(b"0.0", b"1e400", 1), whole.replace(b"0.0", b"1_0", 1)):
            self.assert_rejected(data, "JSON|finite|must be an object")

    def test_values_of_another_type_are_rejected(self):
        def paths(value, path=()):
            yield path
            for name in (value if isinstance(value, dict) else
                         range(len(value)) if isinstance(value, list) else ()):
                yield from paths(value[name], (*path, name))

        for make in (apart, above_plane, overlap):
            for path in list(paths(make()))[1:]:
                for other in (True, None, {}, [], "", 10**400, [[]] * 3, {"a": 1}):
                    if (path, other) in ((("width",), None), (("configuration", "pose_a"), {}),
                                         (("configuration", "pose_b"), {})):
                        continue  # may be
                    with self.subTest(path=path, other=other):
                        self.assert_rejected(changed(make(), path, other), ".")

    def test_configurations_are_rejected_that_solve_refuses(self):
        for path, value in ((("a", "radius"), 0.0), (("a", "half_length"), -1.0),
                            (("b", "radius"), -2.0), (("b", "shape"), "ball"),
                            (("a", "rounding"), -0.5), (("a", "rounding"), 1.25),
                            (("b", "rounding"), 0.5),
                            (("pose_a", "orientation"), [0.0] * 4),
                            (("pose_a", "position"), [0.0] * 2),
                            (("b",), {"shape": "plane", "normal": [0.0] * 3, "displacement": 0.0}),
                            (("b",), {"shape": "box", "half_extents": [1.0, 1.0, 0.0]}),
                            (("b",), {"shape": "capsule", "radius": 1.0, "half_length": 0.0}),
                            (("a",), {"shape": "sphere", "radius": 1.0}),
                            (("b",), {"shape": "convex", "vertices": [[0.0] * 3] * 4097}),
                            (("b",), {"shape": "convex", "vertices": [[0.0] * 3, [1.0] * 3]}),
                            (("b",), {"shape": "convex",
                                      "vertices": [[x, 2 * x, 3 * x] for x in (1.0, 1.0, 2.0)]})):
            with self.subTest(path=path, value=value):
                forged = changed(apart(), ("configuration", *path), value)
                self.assert_rejected(changed(forged, ("exact", *path), exact(value)),
                                     "configuration.")

    def test_a_rounded_body_is_its_core_and_nearer_by_the_rounding(self):
        value = changed(apart(), ("signed_distance",), ["2", "2"])
        for name, a in (("configuration", cylinder(2.0, 2.0)), ("exact", exact(cylinder(2.0, 2.0)))):
            value = changed(value, (name, "a"), a)
        self.assert_rejected(value, "the gap along the normal")
        for name, one in (("configuration", 1.0), ("exact", "1")):
            value = changed(value, (name, "a", "rounding"), one)
        self.assert_accepted(value)
        self.assert_rejected(changed(value, ("signed_distance",), ["3", "3"]), "along the normal")
        self.assert_rejected(changed(value, ("signed_distance",), ["1", "1"]), "farther apart than hi")

    def test_a_pose_may_be_missing(self):
        value = apart()
        del value["configuration"]["pose_a"], value["configuration"]["pose_b"]["orientation"]
        self.assert_accepted(value)

    def test_either_body_may_be_the_cylinder(self):
        def exchanged(value):
            names = {"a": "b", "b": "a", "pose_a": "pose_b", "pose_b": "pose_a"}
            if isinstance(value, dict):
                return {names.get(name, name): exchanged(x) for name, x in value.items()}
            return [exchanged(x) for x in value] if isinstance(value, list) else value

        def reversed_normal(value):
            return {**value, "normal": [str(-Fraction(x)) for x in value["normal"]]}

        for make in (apart, above_plane):
            self.assert_accepted(reversed_normal(exchanged(make())))
            self.assert_rejected(exchanged(make()), "normal")
        self.assert_accepted(exchanged(overlap()))


class Numbers(CheckerTest):
    """Numbers of the configuration, as `touchstone solve` reads them."""
    READ = {"10": 10, "0x10": 16, "0x1.8p-1": 0.75, "0X1P3": 8, "0x.8": 0.5, "0x8.": 8, "+1": 1,
            "-1": -1, "1.": 1, ".5": 0.5, "1e1": 10, "1E+1": 10, "1e-1": 0.1, "0.1": 0.1, "-0": 0,
            "1e-400": 0,
            "1e-999999999999999999999": 0, "0x1p-99999999999999999999": 0, "0x1p-1074": 5e-324,
            "0x1.fffffffffffffp+1023": 1.7976931348623157e308, "007": 7, "0x0p99999": 0,
            "0." + "0" * 400 + "1e401": 1, "9007199254740993": 9007199254740992,
            "1.00000000000000011102230246251565404236316680908203125": 1,
            "1.00000000000000011102230246251565404236316680908203126": 1.0000000000000002,
            "0x1.00000000000008": 1, "0x1.000000000000080000000000001": 1.0000000000000002}
    REFUSED = ("", " ", " 1", "1 ", "\t1", "1\n", "1_0", "1/3", "1,5", "--1", "+-1", "0x-1", "1e",
               "1e+", "0x", "0x.", "0x1p", ".", "e5", "1f", "1d", "p1", "ff", "nan", "nan(1)",
               "inf", "-infinity", "1e999", "1e999999999", "-0x1p1024", "0x1.fffffffffffff8p+1023",
               "0b1", "1e1.5", "0x1e+1p", "\u0661", "\uff11", "\u00bd", "1\u00a0")

    @staticmethod
    def moved(spelled):
        """Above the plane that is moved to the height `spelled`, the cylinder always at 3."""
        return changed(above_plane(), ("configuration", "pose_b", "position", 2), spelled)

    def test_are_read_as_the_nearest_double(self):
        for spelled, number in self.READ.items():
            with self.subTest(spelled[:60]):
                self.assertEqual(checker.double(spelled, "x"), Fraction(number))
                read = changed(self.moved(spelled), ("exact", "pose_b", "position", 2),
                               str(Fraction(number)))
                read["signed_distance"] = [str(1 - Fraction(number))] * 2
                read["grain"] = str(Fraction(1, Fraction(number).denominator))
                self.assert_accepted(read)

    def test_what_solve_refuses_is_rejected(self):
        for spelled in self.REFUSED:
            with self.subTest(spelled):
                self.assert_rejected(self.moved(spelled), r"pose_b.position\[2\] is .*must be")
        self.assert_rejected(self.moved("1\0"), r"pose_b.position\[2\] is .*must be")

    def test_exact_is_in_lowest_terms(self):
        for spelled in ("4/2", "2/1", "+2", "2.0", "02", " 2", "2 ", "1e0", "0x2"):
            self.assert_rejected(changed(apart(), ("exact", "b", "radius"), spelled), "two forms")

    def run_program(self, command, *spelled):
        """With a line for each of these."""
        lines = [json.dumps(self.moved(s)["configuration"]) + "\n" for s in spelled]
        return subprocess.run([PROGRAM, *command], input="".join(lines).encode(),
                              capture_output=True, check=False)

    @unittest.skipUnless(len(sys.argv) > 1, "needs the program")
    def test_certify_reads_the_same(self):
        for spelled in self.READ:
            with self.subTest(spelled[:60]):
                run = self.run_program(["replay", "--certify", "-"], spelled)
                self.assertEqual(run.returncode, 0, run.stderr)
                read = json.loads(run.stdout)["configuration"]["pose_b"]["position"][2]
                self.assertEqual(float.fromhex(read), self.READ[spelled])
                self.assert_accepted(run.stdout)

    @unittest.skipUnless(len(sys.argv) > 1, "needs the program")
    def test_solve_refuses_the_same(self):
        run = self.run_program(["solve", "--candidates", "reference"], *self.REFUSED)
        self.assertEqual(run.returncode, 2, run.stderr)
        answers = run.stdout.decode().splitlines()
        self.assertEqual([json.loads(answer).get("field") for answer in answers],
                         ["pose_b.position[2]"] * len(self.REFUSED))

    def test_of_the_proof_are_fractions_of_bounded_length(self):
        long = "1" + "0" * 4000
        for spelled in ("1/0", "1/-3", "+3", "3.0", "3e0", "1e999999999", "0x3", " 3", "3 ", "3\n",
                        "1_0", "\u0663", "3/ 1", "3//1", "3/1/1", "--3", "", "-", "/", "nan", long,
                        "-" + long, "1/" + long):
            for path in (("grain",), ("signed_distance", 0), ("normal", 1), ("pair", "a", 0)):
                with self.subTest(spelled=spelled[:20], path=path):
                    self.assert_rejected(changed(apart(), path, spelled), "must be a string with")

    def test_as_long_as_allowed_are_read(self):
        longest = "9" * 4000
        for path in (("normal", 1), ("pair", "a", 0), ("signed_distance", 0), ("grain",)):
            self.assert_rejected(changed(apart(), path, longest + "/" + longest[:-1] + "7"),
                                 "gap along|outside|multiple|apart")


class Proof(CheckerTest):
    def test_what_holds_is_accepted(self):
        for make in (apart, above_plane, overlap, overlap_with_hull):
            self.assert_accepted(make())
        wider = {**apart(), "signed_distance": ["-7", "7/2"], "grain": "1/2", "width": 5.25}
        self.assert_accepted(wider)
        deeper = changed(above_plane(), ("configuration", "pose_a", "position", 2), -3.0)
        deeper = changed(deeper, ("exact", "pose_a", "position", 2), "-3")
        self.assert_accepted({**deeper, "signed_distance": ["-5", "1"], "width": 6.0})

    def test_a_turned_body_is_turned_the_right_way(self):
        turned = pose([0.0, 0.0, 0.0], [2.0, 2.0, 0.0, 0.0])  # its z is the world's -y
        value = certificate(cylinder(1.0, 3.0), turned, {"shape": "sphere", "radius": 1.0},
                            pose([0.0, -9.0, 0.0]), signed_distance=["5", "5"],
                            normal=["0", "1", "0"],
                            pair={"a": ["0", "0", "3"], "b": ["0", "1", "0"]})
        self.assert_accepted(value)
        self.assert_rejected(changed(value, ("pair", "a", 2), "-3"), "farther apart")

    def test_a_lower_end_above_the_gap_is_rejected(self):
        for make in (apart, above_plane, overlap):
            value = make()
            lo = Fraction(value["signed_distance"][0]) + Fraction(1, 10**300)
            value["signed_distance"][0] = str(lo)
            self.assert_rejected({**value, "grain": str(Fraction(1, 10**300))}, "is below lo")

    def test_irrational_roots_are_rounded_to_the_safe_side(self):
        # Along (3, 4, 1), of length root 26, a cylinder reaches 6, a box 8, a sphere 2 root 26.
        grain, rounding = Fraction(1, 10**190), Fraction(1, 10**175)
        box, sphere = {"half_extents": [1.0] * 3}, {"radius": 2.0}
        for shape, size, apart_by, gap in (("box", box, 5, 1), ("box", box, 4, -2),
                                           ("sphere", sphere, 5, 9)):
            beyond = 2 if shape == "sphere" else 0
            # Rounded up: above the gap by less than a grain, and by less than roots are rounded.
            above = (isqrt(gap**2 * 10**380 // 26) + 1 if gap > 0 else -isqrt(4 * 10**380 // 26))
            above = above * grain - beyond
            value = certificate(cylinder(), pose([0.0, 0.0, 0.0]), {"shape": shape, **size},
                                pose([-float(apart_by), 0.0, 0.0]), grain=str(grain),
                                normal=["3", "4", "1"], signed_distance=[str(above), "3"],
                                pair={"a": ["-1", "0", "0"], "b": ["1", "0", "0"]})
            value["width"] = None
            self.assert_rejected(value, "is below lo")
            value["signed_distance"][0] = str(above - rounding)
            self.assert_accepted(value)

    def test_an_upper_end_below_the_bound_is_rejected(self):
        for make, reason in ((apart, "farther"), (above_plane, "farther")):
            value = make()
            grain = Fraction(1, 10**300)
            ends = [str(Fraction(x) - grain) for x in value["signed_distance"]]
            self.assert_rejected({**value, "signed_distance": ends, "grain": str(grain)}, reason)
        self.assert_rejected({**overlap(), "signed_distance": ["-2", "-2"]}, "does not bound")

    def test_the_grain_is_positive_and_divides_the_ends(self):
        for grain in ("0", "-1", "2", "0/1", "5/3"):
            self.assert_rejected({**apart(), "grain": grain}, "grain")

    def test_a_wrong_width_is_rejected(self):
        for width in (1e-30, -1.0, 5e-324 * 2**60, 1e308):
            self.assert_rejected({**apart(), "width": width}, "width is not")
        self.assert_rejected({**overlap(), "width": 1.0001}, "width is not")

    def test_a_point_outside_its_body_is_rejected(self):
        for path, x in ((("a", 0), "2"), (("a", 2), "5/4"), (("b", 1), "9/2"),
                        (("a", 1), "1/" + "9" * 900)):
            self.assert_rejected(changed(apart(), ("pair", *path), x), "outside body")
        self.assert_rejected(changed(apart(), ("pair", "a"), ["0", "0", "3/2"]), "outside body a")
        self.assert_rejected(changed(above_plane(), ("pair", "b", 2), "2"), "outside body b")

    def test_a_capsules_point_may_be_in_its_ends_and_not_beyond(self):
        capsule = {"shape": "capsule", "radius": 1.0, "half_length": 1.0}
        value = certificate(cylinder(), pose([0.0, 0.0, 9.0]), capsule, pose([0.0, 0.0, 0.0]),
                            signed_distance=["6", "6"], normal=["0", "0", "1"],
                            pair={"a": ["0", "0", "-1"], "b": ["0", "0", "2"]})
        self.assert_accepted(value)
        value["pair"]["b"] = ["1/10", "0", "2"]
        self.assert_rejected(value, "outside body b")

    def test_a_hulls_point_is_a_mean_of_vertices(self):
        for weights, reason in (({}, "no weight"), ({"1": "0"}, "no weight"),
                                ({"8": "1", "9": "0"}, "vertex's number"),
                                ({"01": "1"}, "vertex's number"), ({"-1": "1"}, "vertex's number"),
                                ({"1.0": "1"}, "vertex's number"), ({"1": "2", "0": "-1"}, "outside"),
                                ({"1": 1.0}, "string with"), (["1", "0", "0"], "an object"),
                                ({"8": "1"}, "does not bound"), ({"0": "1"}, "does not bound")):
            with self.subTest(weights):
                self.assert_rejected(changed(overlap_with_hull(), ("cells", 0, "b"), weights), reason)
        # More towards a side, and still on the face.
        self.assert_accepted(changed(overlap_with_hull(), ("cells", 0, "b"),
                                     {"1": "2", "3": "2", "5": "2", "7": "2"}))

    def test_a_hull_reaches_as_far_as_its_highest_vertex(self):
        value = overlap_with_hull()
        value["configuration"]["b"]["vertices"].append([0.0, 0.0, 1.5])
        value["exact"]["b"]["vertices"].append(["0", "0", "3/2"])
        value["width"] = 2 / 3
        self.assert_rejected(value, "below lo")
        self.assert_rejected({**value, "signed_distance": ["-5/2", "-1"], "grain": "1/2"}, "width")
        self.assert_accepted({**value, "signed_distance": ["-5/2", "-1"], "grain": "1/2",
                              "width": 1.2})

    @unittest.skipUnless(len(sys.argv) > 1, "needs the program")
    def test_of_hulls_the_program_proves_what_is_known_on_paper(self):
        cube = [[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
        triangle = [[3.0, 0.0, 1.0], [-2.0, 2.0, 1.0], [-2.0, -3.0, 1.0]]
        for vertices in (cube, triangle):
            for height, distance in ((2.5, 0.5), (1.75, -0.25), (2.0, 0)):
                line = {"a": cylinder(0.5), "pose_a": pose([0.0, 0.0, height]),
                        "b": {"shape": "convex", "vertices": vertices}}
                run = subprocess.run([PROGRAM, "replay", "--certify", "-"], capture_output=True,
                                     input=json.dumps(line).encode(), check=False)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assert_accepted(run.stdout)
                lo, hi = map(Fraction, json.loads(run.stdout)["signed_distance"])
                self.assertTrue(lo <= distance <= hi and hi - lo < 1e-29, (lo, hi))

    def test_the_direction_is_a_vector_and_a_planes_own(self):
        self.assert_rejected({**apart(), "normal": ["0", "0", "0"]}, "zero vector")
        for normal in (["0", "0", "-1"], ["0", "1/" + "9" * 900, "1"], ["1", "0", "0"]):
            self.assert_rejected({**above_plane(), "normal": normal}, "plane's normal")

    def test_a_pair_proves_no_overlap_but_over_a_plane(self):
        value = overlap()
        del value["cells"]
        value["pair"] = {"a": ["0", "0", "0"], "b": ["0", "0", "0"]}
        self.assert_rejected(value, "farther apart than hi")
        value = changed(above_plane(), ("pair", "a", 2), "1")
        self.assert_rejected(value, "farther apart than hi")

    def test_cells_prove_overlap_only(self):
        self.assert_rejected({**overlap(), "signed_distance": ["-2", "1"]}, "overlap only")

    def test_a_pair_and_cells_are_too_much(self):
        self.assert_rejected({**overlap(), "pair": apart()["pair"]}, "not known: 'cells'")

    def test_cells_have_to_cover_all_directions_once(self):
        def cells(change):
            value = overlap()
            value["cells"] = change(value["cells"])
            return value

        self.assert_accepted(cells(lambda c: split(c[0]) + c[1:]))
        self.assert_accepted(cells(lambda c: c[::-1]))
        self.assert_accepted(cells(lambda c: [x for k in c for y in split(k) for x in split(y)]))
        missing, twice = "do not cover", "twice"
        for reason, change in (
                (missing, lambda c: []), (missing, lambda c: c[1:]), (missing, lambda c: c[:-1]),
                (missing, lambda c: split(c[0])[1:] + c[1:]),
                (twice, lambda c: c + c[:1]), (twice, lambda c: c[:5] + c[:1]),
                (twice, lambda c: c + split(c[0])), (twice, lambda c: c[1:] + split(c[1])),
                # Their areas add up to the cube's, with a hole where another cell is met twice.
                (twice, lambda c: c[1:5] + 2 * split(c[0])),
                (twice, lambda c: c[1:] + 4 * split(c[1])[:1]),
                (twice, lambda c: split(c[0])[1:] + c[1:] + split(split(c[0])[1])),
                (missing, lambda c: split(split(c[0])[0]) + c[1:]),
                (missing, lambda c: [x for k in c for x in split(k)[:-1]])):
            self.assert_rejected(cells(change), reason)

    def test_a_cell_is_a_face_and_quarters(self):
        for path in ("", "6", "-1", "04", "0 ", " 0", "0\n", "0.", "00_", "٠", "0a", "/"):
            self.assert_rejected(changed(overlap(), ("cells", 0, "cell"), path), "cell is")
        for path in (["0"], 0, None, {}, "0" * 1002):
            self.assert_rejected(changed(overlap(), ("cells", 0, "cell"), path), "cell is")

    def test_a_cell_needs_a_pair_of_its_own(self):
        value = overlap()
        for k in range(6):
            other = changed(value, ("cells", k, "cell"), value["cells"][k ^ 1]["cell"])
            other["cells"][k ^ 1]["cell"] = value["cells"][k]["cell"]
            self.assert_rejected(other, "does not bound")

    def test_a_quarter_lies_where_its_number_says(self):
        for face in range(6):
            value = overlap()
            quarters = split(value["cells"].pop(face))
            for k, quarter in enumerate(quarters):  # one that holds in no other quarter
                quarter["b"] = list(quarter["b"])
                quarter["b"][(face // 2 + 1) % 3] = "1" if k % 2 else "-1"
                quarter["b"][(face // 2 + 2) % 3] = "1" if k // 2 else "-1"
            value["cells"] += quarters
            self.assert_accepted(value)
            for k in range(4):
                other = changed(value, ("cells", 5 + k, "b"), quarters[(k + 1) % 4]["b"])
                self.assert_rejected(other, f"does not bound cells.{5 + k}.")

    def test_a_cells_points_may_be_fractions(self):
        value = overlap()
        for entry in value["cells"]:
            for name in "ab":
                entry[name] = [str(Fraction(x) / 2) for x in entry[name]]
        self.assert_rejected(value, "does not bound cells.0.")
        value.update(signed_distance=["-2", "-1/2"], grain="1/2", width=1.5)
        self.assert_accepted(value)

    def test_a_bound_that_fails_at_one_corner_is_rejected(self):
        for y in ("-1", "1"):  # each moves one corner's product from -2 to 0
            for z in ("-1", "1"):
                value = changed(overlap(), ("cells", 0, "b"), ["1", y, z])
                self.assert_rejected(value, "does not bound cells.0.")

    def test_a_bound_that_holds_at_a_cells_middle_alone_is_rejected(self):
        # Along the face's middle a.n - b.n = -2, at its corners -2/root 3: no better hi than that.
        for hi, holds in (("-1154/1000", True), ("-1155/1000", False)):
            value = {**overlap(), "signed_distance": ["-2", hi], "grain": "1/1000", "width": None}
            if holds:
                self.assert_accepted(value)
            else:
                self.assert_rejected(value, "does not bound")


class CastProof(CheckerTest):
    def test_what_holds_is_accepted(self):
        self.assertRegex(checker.verdict(text(let_down()))[1], "^accepted: free for 0.5 of its sweep, then 0 m apart")
        swapped = let_down()
        for form in ("configuration", "exact"):
            numbers = swapped[form]
            for one, other in (("a", "b"), ("pose_a", "pose_b")):
                numbers[one], numbers[other] = numbers[other], numbers[one]
            numbers["sweep"] = [0.0, 0.0, 4.0] if form == "configuration" else ["0", "0", "4"]
        swapped["apart"] = [{**part, "normal": ["-" + x if x != "0" else x for x in part["normal"]]}
                            for part in swapped["apart"]]
        swapped["pair"] = {"a": swapped["pair"]["b"], "b": swapped["pair"]["a"]}
        self.assert_accepted(swapped)

    def test_without_a_touch_the_normals_hold_to_the_end(self):
        never = changed(changed(let_down(), ("configuration", "sweep"), [8.0, 0.0, 0.0]), ("exact", "sweep"), ["8", "0", "0"])
        never["apart"][1]["until"] = "1"
        del never["pair"], never["distance"]
        self.assertEqual(checker.verdict(text(never)), (True, "accepted: free for 1 of its sweep"))
        self.assert_rejected(changed(never, ("apart", 1, "until"), "9/8"), "in order, from 0 to 1")
        self.assert_rejected(changed(never, ("apart", 1, "until"), "1/2"), "the parts end before 1")
        parts = [{"until": "1", "normal": ["0", "0", "1"]}] * (checker.MAX_PARTS + 1)
        self.assert_rejected(changed(never, ("apart",), parts), "apart is an array")

    def test_a_normal_holds_at_the_start_of_its_part_too(self):
        rising = changed(changed(let_down(), ("configuration", "sweep"), [0.0, 0.0, 4.0]), ("exact", "sweep"), ["0", "0", "4"])
        rising["apart"] = [{"until": "1", "normal": ["0", "0", "1"]}]
        del rising["pair"], rising["distance"]
        self.assert_accepted(rising)
        for form, low in (("configuration", 2.0), ("exact", "2")):  # in the sphere by 1 m
            rising[form]["pose_a"]["position"][2] = low
        self.assert_rejected(rising, "gap along the normal")

    def test_of_a_rounded_body_the_rounding_counts_in_gap_and_pair(self):
        rounded = let_down()
        for form, rounding in (("configuration", 0.25), ("exact", "1/4")):
            rounded[form]["a"]["rounding"] = rounding
        rounded["pair"]["a"] = ["0", "0", "-3/4"]  # of the core
        self.assertRegex(checker.verdict(text(rounded))[1], "^accepted: free for 0.5 of its sweep, then 0 m apart")
        self.assert_rejected(changed(rounded, ("apart", 1, "until"), "9/16"), "gap along the normal")

    def test_with_a_spin_a_normal_holds_as_long_as_no_point_can_come_so_far(self):
        self.assertEqual(checker.verdict(text(turning())), (True, "accepted: free for 1 of its sweep"))
        # 1.875 m are left at the start, and the farthest point is 1.0078 m from the centre.
        nearer = [changed(turning(), ("configuration", "spin", 0), 1.75), changed(turning(), ("configuration", "spin", 0), 2.0)]
        for value, spin in zip(nearer, ("7/4", "2")):
            value["exact"]["spin"][0] = spin
        self.assert_accepted(nearer[0])
        self.assert_rejected(nearer[1], "gap along the normal")
        halves = changed(nearer[1], ("apart",), [{"until": half, "normal": ["0", "0", "1"]} for half in ("1/2", "1")])
        self.assert_accepted(halves)  # after one radian 1.09 m are left
        self.assert_rejected(changed(halves, ("apart", 0, "until"), "19/20"), "gap along the normal")
        self.assert_rejected(changed(turning(), ("exact", "spin", 1), "1"), "exact.spin")
        upright = changed(changed(turning(), ("configuration", "spin"), [0.0, 0.0, 99.0]), ("exact", "spin"), ["0", "0", "99"])
        self.assert_accepted(upright)  # its axis stays where it is
        self.assert_rejected(changed(changed(upright, ("configuration", "spin", 2), 101.0), ("exact", "spin", 2), "101"), "longer than 100")

    def test_a_turn_is_that_of_trigonometry(self):
        half = [sqrt(0.5), 0, sqrt(0.5), 0]  # about y by a right angle
        for t, angle in ((0, 0), (0.25, 0.75), (1, 3), (0.5, 1.5)):
            q = checker.turned([Fraction(1), Fraction(0), Fraction(0), Fraction(0)], [Fraction(3), Fraction(0), Fraction(0)], Fraction(t))
            for got, expected in zip(q, (cos(angle / 2), sin(angle / 2), 0, 0)):
                self.assertAlmostEqual(float(got), expected, delta=1e-16)
        q = checker.turned([Fraction(x) for x in half], [Fraction(0), Fraction(0), Fraction(pi)], Fraction(1))
        for got, expected in zip(q, (0, -sqrt(0.5), 0, sqrt(0.5))):  # k (w + y j) = w k - y i
            self.assertAlmostEqual(float(got), expected, delta=1e-15)
        q = checker.turned([Fraction(1), 0, 0, 0], [Fraction(60), Fraction(80), Fraction(0)], Fraction(1))
        self.assertLess(abs(checker.dot(q, q) - 1), Fraction(1, 2**95))

    def test_each_fault_is_rejected(self):
        farther = changed(let_down(), ("apart", 1, "until"), "1001/2000")
        self.assert_rejected(farther, "gap along the normal")
        self.assert_rejected(changed(let_down(), ("apart", 0, "until"), "1/2"), "gap along the normal")
        self.assert_rejected(changed(let_down(), ("apart", 1, "normal"), ["0", "0", "-1"]), "gap along the normal")
        self.assert_rejected(changed(let_down(), ("apart", 0, "until"), "-1/8"), "in order")
        self.assert_rejected(changed(let_down(), ("apart", 1, "until"), "1/16"), "in order")
        self.assert_rejected(changed(let_down(), ("apart",), []), "apart is an array of 0")
        self.assert_rejected(changed(let_down(), ("pair", "b"), ["0", "0", "1"]), "farther apart")
        self.assert_rejected(changed(let_down(), ("pair", "a"), ["0", "0", "-2"]), "outside body a")
        self.assert_rejected(changed(let_down(), ("distance",), "-1"), "distance is negative")
        self.assert_rejected(changed(let_down(), ("exact", "sweep", 2), "-5"), "exact.sweep")
        self.assert_rejected(changed(let_down(), ("schema",), "touchstone-certificate-1"), "schema")
        for name in let_down():
            value = let_down()
            del value[name]
            self.assert_rejected(value, "missing|not known")


class Limits(CheckerTest):
    """Whatever a file holds, the checker ends soon and says why."""

    # Processor time of one test, which takes a few; squared in a file's length it would be hours.
    SECONDS = 600

    def setUp(self):
        self.start = time.process_time()

    def tearDown(self):
        self.assertLess(time.process_time() - self.start, self.SECONDS)

    def test_a_huge_exponent_is_rejected_at_once(self):
        self.assert_rejected({**apart(), "grain": "1e999999999"}, "grain is")
        self.assert_rejected({**apart(), "grain": "1e-999999999"}, "grain is")

    def test_a_file_is_not_longer_than_the_limit(self):
        self.assert_rejected(text(apart()) + b" " * checker.MAX_BYTES, "longer than")
        padded = text(apart())
        self.assert_accepted(padded + b" " * (checker.MAX_BYTES - len(padded)))

    def test_deep_files_are_rejected(self):
        for bomb in (b"[" * 10**6, b'{"a":' * 10**6, b"[" * 10**6 + b"]" * 10**6,
                     b'{"a":' * 500 + b"1" + b"}" * 500):
            self.assert_rejected(bomb, ".")

    def test_long_numbers_are_read_or_rejected_soon(self):
        digits = 8 * 10**6
        for number in ("1" * digits, "0." + "1" * digits, "1" * digits + "x", "0x" + "1" * digits,
                       "0x" + "1" * digits + "x", "1e" + "1" * digits, "0x1p" + "1" * digits):
            moved = Numbers.moved(number)
            self.assert_rejected(moved, ".")
            self.assert_rejected(text(moved).replace(f'"{number}"'.encode(), number.encode()), ".")
            self.assert_rejected(changed(apart(), ("grain",), number), "grain is")

    def test_many_members_or_cells_are_rejected_soon(self):
        many = ",".join(f'"{k}":[]' for k in range(10**6)).encode()
        self.assert_rejected(text(apart())[:-1] + b"," + many + b"}", "not known")
        value = overlap()
        value["cells"] = value["cells"] * 20000
        self.assert_rejected(value, "at most 100000 cells")

    def test_the_deepest_cells_are_read(self):
        value = overlap()
        *rest, cell = value["cells"]
        while len(cell["cell"]) <= checker.MAX_LEVEL:
            *quarters, cell = split(cell)
            rest += quarters
        self.assert_accepted({**value, "cells": [*rest, cell]})


class Program(unittest.TestCase):
    def run_checker(self, *arguments, **options):
        return subprocess.run([sys.executable, CHECKER, *arguments], check=False,
                              **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options})

    def test_exit_code_says_accepted_rejected_or_not_read(self):
        with tempfile.TemporaryDirectory() as folder:
            good, bad = os.path.join(folder, "good.json"), os.path.join(folder, "bad \udcff\n.json")
            with open(good, "wb") as file:
                file.write(text(apart()))
            with open(bad, "wb") as file:
                file.write(text({**apart(), "normal": ["0", "0", "0"]}))
            for code, printed, files in ((0, b"accepted: 3", [good]), (1, b"zero vector", [bad]),
                                         (1, b"accepted: 3", [bad, good]),
                                         (2, b"", [os.path.join(folder, "none")]),
                                         (2, b"", [folder]),
                                         (2, b"accepted: 3", [folder, good]), (2, b"", [])):
                run = self.run_checker(*files)
                self.assertEqual(run.returncode, code, run)
                self.assertIn(printed, run.stdout)
                self.assertEqual(code == 2, bool(run.stderr))
                self.assertNotIn(b"Traceback", run.stderr)
            with open("/dev/full", "wb") as full:
                run = self.run_checker(good, stdout=full)
            self.assertEqual(run.returncode, 2)
            self.assertNotIn(b"Traceback", run.stderr)

    def test_ends_beyond_all_doubles_are_printed(self):
        far = 1.7e308
        value = certificate(cylinder(), pose([far, 0.0, 0.0]), {"shape": "sphere", "radius": 1.0},
                            pose([-far, 0.0, 0.0]), signed_distance=[str(2 * int(far) - 2)] * 2,
                            normal=["1", "0", "0"],
                            pair={"a": ["-1", "0", "0"], "b": ["1", "0", "0"]})
        self.assertEqual(checker.verdict(text(value)),
                         (True, "accepted: 3.3999999999999999e+308 m, width 0 m"))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else None
    unittest.main()
