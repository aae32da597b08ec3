#!/usr/bin/env python3
"""Holds the engines of npm to contacts that are known on paper: npm_test.py FOLDER-WITH-PACKAGES CLASS…
Only the class Releases needs the registry.

Every pose is one where faces or generators meet, whose contact no margin changes, and is asked as
it is and with both bodies moved by one rotation and translation. A wrong sign, frame, axis or body
order of an adapter cannot pass."""

import contextlib
import functools
import json
import math
import os
import subprocess
import sys
import unittest
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "clients/testing"))
from protocol import Child

ALL = ("plane", "sphere", "capsule", "cylinder", "box", "convex")
FLAT = ("plane", "box")


class Engine(NamedTuple):
    arguments: list[str]
    inside: float
    """Error of depths, metres. Rounding coordinates of some metres to float costs 1e-6."""
    apart: float
    """Error of distances."""
    normal: float
    """Error of normals, of a vector of length one."""
    kinds: tuple[str, ...] = ALL
    parameter: float = 0


# PhysX's GJK stops within 2 mm of the distance; MuJoCo turns the bodies by 1 mrad for its other
# points. Floors of triangles are of 2 by 2 squares: bodies lie on seams.
ENGINES = {
    "jolt": Engine(["jolt.mjs"], 2e-6, 2e-6, 2e-4),
    "jolt-margin-0": Engine(["jolt.mjs", "margin-0"], 2e-6, 2e-6, 2e-4),
    "jolt-margin": Engine(["jolt.mjs", "margin"], 2e-6, 2e-6, 2e-4, parameter=0.02),
    "jolt-world": Engine(["jolt.mjs", "world"], 2e-6, 2e-6, 2e-4),
    "rapier": Engine(["rapier.mjs"], 2e-4, 1e-5, 5e-3),
    "rapier-world": Engine(["rapier.mjs", "world"], 2e-4, 1e-5, 5e-3),
    "physx-world": Engine(["physx.mjs", "world"], 1e-4, 2e-3, 2e-3),
    "physx": Engine(["physx.mjs"], 5e-6, 2e-3, 2e-4),
    "havok": Engine(["havok.mjs"], 5e-6, 5e-6, 2e-5, kinds=ALL[1:]),
    "mujoco3": Engine(["mujoco3.mjs"], 1e-6, 1e-6, 2e-3),
    "mujoco3-single": Engine(["mujoco3.mjs", "single"], 1e-6, 1e-6, 1e-5),
    "jolt-floor": Engine(["jolt.mjs", "floor"], 2e-6, 2e-6, 1e-3, kinds=FLAT, parameter=2),
    "rapier-floor": Engine(["rapier.mjs", "floor"], 2e-4, 1e-5, 3e-2, kinds=FLAT, parameter=2),
    "rapier-floor-edges": Engine(["rapier.mjs", "floor-edges"], 2e-4, 1e-5, 5e-3, kinds=FLAT,
                                 parameter=2),
    "physx-floor": Engine(["physx.mjs", "floor"], 5e-4, 2e-3, 5e-2, kinds=FLAT, parameter=2),
    "havok-floor": Engine(["havok.mjs", "floor"], 5e-4, 5e-4, 1e-3, kinds=FLAT, parameter=2),
}

# PhysX stops 0.1 mm short, Rapier up to 0.3 mm too late; their normals are as exact as of contacts.
CAST_ERROR, CAST_NORMAL = 5e-4, 5e-3

HALF = math.sqrt(0.5)
UPRIGHT, TO_X = (1, 0, 0, 0), (HALF, 0, HALF, 0)  # turns z to x
CYLINDER = {"shape": "cylinder", "radius": 0.5, "half_length": 1}
PLANE = {"shape": "plane", "normal": [0, 0, 1], "displacement": 0.25}
SLOPE = {"shape": "plane", "normal": [0.6, 0, 0.8], "displacement": -0.5}
SPHERE = {"shape": "sphere", "radius": 0.3}
CAPSULE = {"shape": "capsule", "radius": 0.2, "half_length": 0.6}
DISC = {"shape": "cylinder", "radius": 0.7, "half_length": 0.3}
BOX = {"shape": "box", "half_extents": [0.8, 0.9, 0.4]}
# A roof whose origin is elsewhere: its ridge is along y, 1.5 above the origin.
ROOF = {"shape": "convex", "vertices": [[3, -1, 0], [3, 1, 0], [5, -1, 0], [5, 1, 0], [4, -1, 1.5], [4, 1, 1.5]]}
DEPTH = 0.01

# Name, B, pose of A, pose of B; the normal, and where along it the contact lies; at depth 0.01. The
# numbers are the bodies' extents along the normal, so that they overlap by just that.
CASES = [
    ("standing on a plane", PLANE,
     (0.1, 0.2, 1.24), UPRIGHT, (0, 0, 0), UPRIGHT, (0, 0, 1), 0.245),
    ("lying on a plane", PLANE,
     (0.1, 0.2, 0.74), TO_X, (0, 0, 0), UPRIGHT, (0, 0, 1), 0.245),
    ("standing on a plane whose body is moved", PLANE,
     (0, 0, 2.24), UPRIGHT, (5, 6, 1), UPRIGHT, (0, 0, 1), 1.245),
    ("beside a plane whose body is turned", PLANE,
     (0.74, 0, 0), UPRIGHT, (0, 0, 0), TO_X, (1, 0, 0), 0.245),
    ("a corner on a slope", SLOPE,
     (0, 0, 0), UPRIGHT, (-0.354, 0, -0.472), UPRIGHT, (0.6, 0, 0.8), -1.095),
    ("a sphere at the side", SPHERE,
     (0, 0, 0), UPRIGHT, (0.79, 0, 0.3), UPRIGHT, (-1, 0, 0), -0.495),
    ("a sphere at the other side", SPHERE,
     (0, 0, 0), UPRIGHT, (0, -0.79, -0.3), UPRIGHT, (0, 1, 0), -0.495),
    ("a sphere on the cap", SPHERE,
     (0, 0, 0), UPRIGHT, (0.1, 0.2, 1.29), UPRIGHT, (0, 0, -1), -0.995),
    ("a sphere below", SPHERE,
     (0, 0, 0), UPRIGHT, (0.1, 0.2, -1.29), UPRIGHT, (0, 0, 1), -0.995),
    ("a capsule across the side", CAPSULE,
     (0, 0, 0), UPRIGHT, (0, 0.69, 0.2), TO_X, (0, -1, 0), -0.495),
    ("a capsule on the cap", CAPSULE,
     (0, 0, 0), UPRIGHT, (0.1, 0.2, -1.79), UPRIGHT, (0, 0, 1), -0.995),
    ("a capsule's end at the side", CAPSULE,
     (0, 0, 0), UPRIGHT, (-1.29, 0, 0.2), TO_X, (1, 0, 0), -0.495),
    ("a cap on a cap", DISC,
     (0, 0, 0), UPRIGHT, (0.3, 0.2, -1.29), UPRIGHT, (0, 0, 1), -0.995),
    ("a cap at the side", DISC,
     (0, 0, 0), UPRIGHT, (0.79, 0, 0.2), TO_X, (-1, 0, 0), -0.495),
    ("crossed sides", DISC,
     (0, 0, 0), UPRIGHT, (0, 1.19, 0), TO_X, (0, -1, 0), -0.495),
    ("a cap on a box", BOX,
     (0.1, 0.2, 1.39), UPRIGHT, (0, 0, 0), UPRIGHT, (0, 0, 1), 0.395),
    ("the side on a box", BOX,
     (0.1, 0.2, 0.89), TO_X, (0, 0, 0), UPRIGHT, (0, 0, 1), 0.395),
    ("the side at a box's side", BOX,
     (0, -1.39, 0), UPRIGHT, (0, 0, 0), UPRIGHT, (0, -1, 0), 0.895),
    ("below a box", BOX,
     (0, 0, -1.39), UPRIGHT, (0, 0, 0), UPRIGHT, (0, 0, -1), 0.395),
    ("below a roof", ROOF,
     (0.1, 0.2, -0.99), UPRIGHT, (-4, 0, 0), UPRIGHT, (0, 0, -1), -0.005),
    ("the side below a roof that is turned", ROOF,
     (-0.49, 0.1, 0.2), UPRIGHT, (0, 0, 4), TO_X, (-1, 0, 0), -0.005),
    ("the side at a roof's gable", ROOF,
     (0.1, -1.49, 0.3), UPRIGHT, (-4, 0, 0), UPRIGHT, (0, -1, 0), 0.995),
]
MOVED = ((0.36, 0.48, -0.64, 0.48), (1.5, -2.25, 0.75))


def rotate(q, v):
    w, x, y, z = q
    s, t, u = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * s + y * u - z * t, v[1] + w * t + z * s - x * u,
            v[2] + w * u + x * t - y * s)


def multiply(p, q):
    a, b, c, d = p
    w, x, y, z = q
    return (a * w - b * x - c * y - d * z, a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x, a * z + b * y - c * x + d * w)


def dot(u, v):
    return sum(x * y for x, y in zip(u, v))


def cases_for(engine, left_out):
    """Those of its kinds; of a floor without a rim, for the others are between faces and sides."""
    return [case for case in CASES if case[1]["shape"] in engine.kinds and case[0] not in left_out
            and not (engine.kinds == FLAT and case[0] == "a corner on a slope")]


# Starting an engine takes longer than all that it is asked here: each is started once.
running = contextlib.ExitStack()


def settings_of(name):
    return ENGINES[name.split("@")[0]]


@functools.cache
def child_of(name):
    script, *arguments = settings_of(name).arguments
    release = name.partition("@")[2]
    command = ["env", f"TOUCHSTONE_RELEASE={release}"] if release else []
    return running.enter_context(Child([*command, "node", str(HERE / script), *arguments]))


def tearDownModule():
    running.close()


class Npm(unittest.TestCase):
    names = tuple(ENGINES)
    with_casts = 6
    left_out = ()

    def engines(self):
        for name in self.names:
            yield name, settings_of(name), child_of(name)

    def ask(self, child, cases, threshold, moved, retreat=0.0):
        """The answers to CASES, all bodies moved alike, A first drawn back along the normal."""
        turn, shift = moved

        def pose(position, orientation):
            at = [x + y for x, y in zip(rotate(turn, position), shift)]
            return {"position": at, "orientation": list(multiply(turn, orientation))}

        parameter = settings_of(child.hello["name"]).parameter
        supported = child.prepare(
            [(i, CYLINDER, case[1], threshold, parameter) for i, case in enumerate(cases)])
        self.assertEqual(supported, [True] * len(cases))
        answers = child.query([
            (i, pose([x + retreat * n for x, n in zip(at_a, normal)], turned_a),
             pose(at_b, turned_b), None)
            for i, (_, _, at_a, turned_a, at_b, turned_b, normal, _) in enumerate(cases)])
        child.release(list(range(len(cases))))
        return answers

    def test_hello_says_what_is_supported(self):
        for name, engine, child in self.engines():
            with self.subTest(engine=name):
                self.assertEqual(child.hello["name"], name)
                self.assertEqual(child.hello["runs"], "wasm")
                self.assertEqual(child.hello["precision"], "double" if "mujoco" in name else "float")
                self.assertEqual(child.hello["pairs"], [f"cylinder-{kind}" for kind in engine.kinds])
                supported = child.prepare([(i, CYLINDER, b, 0, engine.parameter) for i, b in enumerate(
                    (PLANE, SPHERE, CAPSULE, CYLINDER, BOX, ROOF))])
                self.assertEqual(supported, [kind in engine.kinds for kind in ALL])
                child.release(list(range(len(ALL))))

    def test_contacts_are_as_on_paper(self):
        for name, engine, child in self.engines():
            cases = cases_for(engine, self.left_out)
            for moved in ((UPRIGHT, (0, 0, 0)), MOVED):
                for case, answer in zip(cases, self.ask(child, cases, 0, moved)):
                    with self.subTest(engine=name, case=case[0], moved=moved is MOVED):
                        self.assert_contact(answer, case, moved, -DEPTH, engine)

    def test_casts_stop_where_bodies_touch(self):
        # A comes from 0.99 m along the normal, and would go on for as long.
        asked = 0
        for name, engine, child in self.engines():
            if not child.hello.get("casts"):
                continue
            asked += 1
            cases = cases_for(engine, self.left_out)
            for moved in ((UPRIGHT, (0, 0, 0)), MOVED):
                for case, (status, fraction, normal) in zip(cases, self.cast(child, cases, moved)):
                    with self.subTest(engine=name, case=case[0], moved=moved is MOVED):
                        if (name.split("@")[0], case[1]["shape"]) == ("physx", "plane"):
                            self.assertEqual(status, "unsupported")
                            continue
                        self.assertEqual(status, "touch")
                        self.assertAlmostEqual(2 * fraction, 1 - DEPTH, delta=CAST_ERROR)
                        self.assertLess(math.dist(normal, rotate(moved[0], case[6])), CAST_NORMAL)
        self.assertEqual(asked, self.with_casts)

    def cast(self, child, cases, moved):
        """The casts of A along the normal, from 1 m before its pose in CASES, by 2 m."""
        turn, shift = moved

        def pose(position, orientation):
            at = [x + y for x, y in zip(rotate(turn, position), shift)]
            return {"position": at, "orientation": list(multiply(turn, orientation))}

        parameter = settings_of(child.hello["name"]).parameter
        child.prepare([(i, CYLINDER, case[1], 0, parameter) for i, case in enumerate(cases)])
        answers = child.cast([
            (i, pose([x + n for x, n in zip(at_a, normal)], turned_a), pose(at_b, turned_b),
             tuple(-2 * n for n in rotate(turn, normal)))
            for i, (_, _, at_a, turned_a, at_b, turned_b, normal, _) in enumerate(cases)])
        child.release(list(range(len(cases))))
        return answers

    def test_bodies_apart_are_answered_up_to_the_threshold(self):
        for name, engine, child in self.engines():
            cases = cases_for(engine, self.left_out)
            for case, answer in zip(cases, self.ask(child, cases, 0.02, MOVED, 2 * DEPTH)):
                with self.subTest(engine=name, case=case[0]):
                    self.assert_contact(answer, case, MOVED, DEPTH, engine)
            for threshold in (0, 0.005):
                for case, answer in zip(cases, self.ask(child, cases, threshold, MOVED, 2 * DEPTH)):
                    with self.subTest(engine=name, case=case[0], threshold=threshold):
                        self.assertEqual(answer.status, "none")

    def test_answers_depend_on_the_question_alone(self):
        for name, engine, child in self.engines():
            cases = cases_for(engine, self.left_out)
            with self.subTest(engine=name):
                first = self.ask(child, cases, 0, MOVED)
                self.ask(child, cases, 0.02, (UPRIGHT, (0.001, 0, 0)))
                again = self.ask(child, cases[::-1], 0, MOVED)[::-1]
                self.assertEqual([a.bits() for a in first], [a.bits() for a in again])

    def assert_contact(self, answer, case, moved, distance, engine):
        _, _, _, _, _, _, normal, level = case
        turn, shift = moved
        normal = rotate(turn, normal)
        # Half of what A was drawn back moves the middle.
        level += dot(normal, shift) + (distance + DEPTH) / 2
        error = engine.inside if distance < 0 else engine.apart
        self.assertEqual(answer.status, "contact")
        self.assertAlmostEqual(answer.signed_distance, distance, delta=error)
        self.assertLess(math.dist(answer.normal, normal), engine.normal)
        self.assertGreater(len(answer.points), 0)
        for *rest, depth in answer.points:
            self.assertAlmostEqual(dot(normal, rest[:3]), level, delta=error)
            self.assertLess(math.dist(rest[3:6], normal), engine.normal)
            self.assertAlmostEqual(depth, -distance, delta=error)


class Releases(Npm):
    """Older releases, whose calls are others: Rapier's casts and prediction before 0.13, its steps before
    0.14, its modules of 0.15 and 0.17."""
    names = ("rapier@0.12", "rapier-world@0.12", "rapier-world@0.13", "rapier@0.15", "rapier-world@0.17", "rapier@0.20", "jolt@0.31",
             "jolt-margin@0.31", "jolt-world@0.35", "havok@1.3.0", "mujoco3-single@3.10", "physx@2.7.2")
    with_casts = 7
    left_out = ("a capsule's end at the side",)  # old ones of Rapier miss it
    # Which body comes first in a manifold of an old world, and so the last bit, depends on what was asked.
    test_answers_depend_on_the_question_alone = None

    @classmethod
    def setUpClass(cls):
        install = ("say() { :; }; . \"$0\"; [ -n \"$(npm_releases jolt-physics)\" ] || exit 3; "
                   "for engine in ${@:2}; do install_release $engine \"$1\" || exit; done")
        done = subprocess.run(["bash", "-c", install, HERE / "releases.sh",
                               Path(os.environ["TOUCHSTONE_NPM"]) / "versions", *cls.names])
        if done.returncode == 3:
            raise unittest.SkipTest("npm's registry cannot be asked")
        assert done.returncode == 0, "a release cannot be installed"


class KnownFailures(unittest.TestCase):
    """What docs/engines.md says of these engines. One that no longer fails has been mended: say so
    there."""

    def ask(self, name, b, position, orientation, other=(UPRIGHT, (0, 0, 0)), parameter=0):
        """The answer to a cylinder there and B upright in the origin, or as `other` says."""
        length = math.hypot(*orientation)
        child = child_of(name)
        child.prepare([(0, CYLINDER, b, 0, parameter)])
        (answer,) = child.query([(
            0, {"position": list(position), "orientation": [x / length for x in orientation]},
            {"position": list(other[1]), "orientation": list(other[0])}, None)])
        child.release([0])
        return answer

    def test_multiple_contacts_of_mujoco_reverse_normals(self):
        drum = {"shape": "cylinder", "radius": 1, "half_length": 1}
        for name, up in (("mujoco3-single", 1), ("mujoco3", -1)):
            answer = self.ask(name, drum, (-1, -0.2, 1.53), (0.5, 0.3, -0.4, -0.2))
            self.assertAlmostEqual(answer.signed_distance, -0.0427004408, delta=1e-9)
            self.assertAlmostEqual(answer.normal[2], up, delta=1e-9)

    def test_mujoco_misses_cylinders_about_the_same_centre(self):
        for shape in (DISC, BOX, CAPSULE):
            self.assertEqual(self.ask("mujoco3", shape, (0, 0, 0), UPRIGHT).status, "none")

    def test_physx_reverses_a_normal(self):
        disc = {"shape": "cylinder", "radius": 0.3, "half_length": 0.2}
        pose = (-0.7860149, -0.9957942, 0.6171945), (0, 0, -2, 3)
        right, wrong = (self.ask(name, disc, *pose) for name in ("mujoco3-single", "physx"))
        self.assertAlmostEqual(right.signed_distance, -5.5e-5, delta=1e-6)
        self.assertLess(dot(right.normal, wrong.normal), -0.999)

    def test_jolt_without_a_margin_makes_a_contact_deeper(self):
        disc = {"shape": "cylinder", "radius": 0.3, "half_length": 0.2}
        pose = (0.5639439, 0.5639428, 0.81), (HALF, 0, 0, HALF)
        distance = math.hypot(*pose[0][:2]) - 0.8
        self.assertAlmostEqual(self.ask("jolt", disc, *pose).signed_distance, distance, delta=1e-6)
        without = self.ask("jolt-margin-0", disc, *pose)
        self.assertAlmostEqual(without.signed_distance, -0.08, delta=1e-3)

    def test_jolts_cast_along_the_axis_of_two_cans_has_a_horizontal_normal(self):
        child = child_of("jolt")
        child.prepare([(0, CYLINDER, CYLINDER, 0, 0)])
        down, below = (0, 0, -0.3), {"position": [0, 0, 0], "orientation": list(UPRIGHT)}
        for beside, up in ((0, 0), (0.3, 1)):
            at = {"position": [beside, 0, 2.1], "orientation": list(UPRIGHT)}
            ((status, fraction, normal),) = child.cast([(0, at, below, down)])
            self.assertEqual(status, "touch")
            self.assertAlmostEqual(fraction, 1 / 3, delta=1e-4)
            self.assertAlmostEqual(normal[2], up, delta=1e-3)
        child.release([0])

    def test_a_fast_can_passes_through_a_wall_of_jolt_unless_it_is_cast(self):
        """The experiment fast-can, which touches the wall after 1.24 m."""
        printed = subprocess.run(["node", HERE.parent / "testing/jolt_fast_can.mjs"], check=True,
                                 capture_output=True, text=True).stdout
        way, cast_way = json.loads(printed)
        self.assertAlmostEqual(way, 36, delta=1e-3)
        may_overlap = 0.25 * 0.05  # LinearCastMaxPenetration, of the inner radius
        self.assertAlmostEqual(cast_way, 1.24 + may_overlap, delta=1e-4)

    def test_only_some_know_a_flat_body(self):
        """A cylinder that stands 0.05 deep in a triangle, and one beside it, within the box about it."""
        triangle = {"shape": "convex", "vertices": [[-2, -2, 0], [2, -2, 0], [0, 2, 0]]}
        for name, deeper in (("jolt", 0), ("jolt-world", 0), ("rapier", 0), ("rapier-world", 0),
                             ("havok", 0.015), ("physx", 0.01), ("physx-world", 0.01)):
            with self.subTest(engine=name):
                on_face = self.ask(name, triangle, (0, -0.5, 0.95), UPRIGHT)
                self.assertAlmostEqual(on_face.signed_distance, -0.05 - deeper, delta=1e-4)
                beside = self.ask(name, triangle, (1.9, 1.9, 0.95), UPRIGHT)
                self.assertEqual(beside.status, "contact" if "physx" in name else "none")
        for name in ("mujoco3", "mujoco3-single"):
            self.assertEqual(self.ask(name, triangle, (0, -0.5, 0.95), UPRIGHT).status, "unsupported")

    def test_jolt_rounds_a_tip_and_havok_too(self):
        tip = {"shape": "convex", "vertices": [[-1, -1, 0], [1, -1, 0], [0, 1.5, 0], [0, 0, 1]]}
        for name, missing in (("jolt", 0.0108), ("jolt-margin-0", 0), ("rapier", 0), ("physx", 0),
                              ("havok", 0.0026), ("mujoco3", 0)):
            answer = self.ask(name, tip, (0.1, 0.05, 1.95), UPRIGHT)
            self.assertAlmostEqual(answer.signed_distance, missing - 0.05, delta=1e-4)

    def test_a_cylinder_of_havok_has_sixteen_sides(self):
        for eighths, missing in ((0, 0), (0.5, 1 - math.cos(math.pi / 16)), (1, 0)):
            angle = eighths * math.pi / 8
            at = [0.78 * math.cos(angle), 0.78 * math.sin(angle), 0]
            answer = self.ask("havok", SPHERE, (0, 0, 0), UPRIGHT, (UPRIGHT, at))
            self.assertAlmostEqual(answer.signed_distance, -0.02 + 0.5 * missing, delta=5e-4)

    def test_seams_of_floors_turn_normals(self):
        """Degrees between a point's normal and the plane's: of a can beside a seam, where an edge is as
        deep in its side as its cap is in the floor, and of a log that lies along a seam."""
        ground = {"shape": "plane", "normal": [0, 0, 1], "displacement": 0}
        half_side = 5 * math.hypot(0.5, 1) / 4  # of a square of 2 by 2
        for name, can, log in (("jolt-floor", 0, 0), ("rapier-floor", 0, 0.39),
                               ("rapier-floor-edges", 0, 0), ("physx-floor", 90, 2.09),
                               ("havok-floor", 0, 0)):
            for angle, z, orientation in ((can, 0.99, UPRIGHT), (log, 0.49, TO_X)):
                with self.subTest(engine=name, z=z):
                    answer = self.ask(name, ground, (half_side, 0, z), orientation, parameter=8)
                    self.assertAlmostEqual(answer.signed_distance, -0.01, delta=5e-4)
                    worst = max(math.degrees(math.acos(min(1, point[5]))) for point in answer.points)
                    self.assertAlmostEqual(worst, angle, delta=0.1)


if __name__ == "__main__":
    os.environ["TOUCHSTONE_NPM"] = sys.argv.pop(1)
    unittest.main()
