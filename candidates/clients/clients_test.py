#!/usr/bin/env python3
"""Plays Touchstone's side of the protocol with both clients in both formats, and their examples."""

import json
import math
import random
import struct
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE / "testing"))
from protocol import Answer, Child

CLIENTS = {"Python": [sys.executable, str(HERE / "testing/echo.py")],
           "JavaScript": ["node", str(HERE / "testing/echo.mjs")]}
FORMATS = ("frames", "lines")
CYLINDER = {"shape": "cylinder", "radius": 0.1, "half_length": 1 / 3}
BOX = {"shape": "box", "half_extents": [1, 2, 1e-300]}
PLANE = {"shape": "plane", "normal": [0.6, 0, -0.8], "displacement": -0.25}
SPHERE = {"shape": "sphere", "radius": 0.5}
CAPSULE = {"shape": "capsule", "radius": 0.5, "half_length": 1}


def pose(x, y=0.0, z=0.0, orientation=(1.0, 0.0, 0.0, 0.0)):
    return {"position": [x, y, z], "orientation": list(orientation)}


def every_client(test):
    """Runs a test with each client in each format."""
    def all_of_them(self):
        for language, command in CLIENTS.items():
            for form in FORMATS:
                with self.subTest(client=language, format=form), Child([*command, form]) as child:
                    test(self, child)
    return all_of_them


class Clients(unittest.TestCase):
    @every_client
    def test_hello_says_what_the_candidate_is(self, child):
        self.assertEqual(child.hello, {
            "touchstone": 1, "name": "echo", "version": "1", "settings": "none",
            "precision": "double", "runs": "script", "format": child.hello["format"],
            "pairs": ["cylinder-plane", "cylinder-box", "cylinder-cylinder", "cylinder-convex"],
            "parameter": {"meaning": "number", "min": 0, "max": 9, "usual": 3, "whole": True},
            "models": "nothing at all"})

    @every_client
    def test_the_end_of_input_ends_the_child(self, child):
        child.prepare([(0, CYLINDER, BOX, 0, 0)])
        self.assertEqual(child.end(), 0)

    @every_client
    def test_a_request_that_breaks_off_ends_the_child(self, child):
        half_a_frame = struct.pack("<IIQII", 164, 2, 1, 1, 0) + b"half"
        child.process.stdin.write(b"{" if child.in_lines else half_a_frame)
        child.process.stdin.flush()
        child.process.stdin.close()
        self.assertEqual(child.process.stdout.read(), b"")
        child.process.wait()

    @every_client
    def test_an_answer_has_the_numbers_of_the_question(self, child):
        self.assertEqual(child.prepare([(7, CYLINDER, PLANE, 0.125, 3)]), [True])
        tiny, last = 5e-324, math.nextafter(1, 0)
        a = pose(tiny, -0.0, 1e300, (0.1, 0.2, 0.3, last))
        b = pose(1 / 3, -1e-17, 2.0**53, (0.7, 0.5, -0.0, 0.4))
        (answer,) = child.query([(7, a, b, (0.36, 0.48, -0.8))])
        sizes = [0.1, 1 / 3, 0.6, 0, -0.8, -0.25, 0.125, 3]
        points = [(*a["position"], *b["position"], sizes[i % 8]) for i in range(16)]
        points[0] = (math.nan, math.inf, -math.inf, 0.36, 0.48, -0.8, -0.0)
        right = Answer("contact", 0.1, (0.5, -0.0, 0.4), tuple(points), 0.7)
        self.assertEqual(answer.bits(), right.bits())

    @every_client
    def test_every_convex_body_has_its_vertices(self, child):
        triangle = {"shape": "convex", "vertices": [[1, 2, 3], [4, 5, 6], [-0.0, 5e-324, 1 / 3]]}
        tetrahedron = {"shape": "convex",
                       "vertices": [[0.1, 0, 0], [0, 0.2, 0], [0, 0, 0.3], [-1, -1, -1]]}
        bodies = [triangle, BOX, tetrahedron, triangle]
        self.assertEqual(child.prepare([(i, CYLINDER, b, 0, 0) for i, b in enumerate(bodies)]),
                         [True] * len(bodies))
        answers = child.query([(i, pose(0), pose(0), None) for i in range(len(bodies))])
        for answer, body in zip(answers, bodies):
            # What was prepared: the cylinder's two sizes, and then B's.
            given = [point[6] for point in answer.points[2:]]
            sizes = [x for vertex in body.get("vertices", ()) for x in vertex] or BOX["half_extents"]
            right = (sizes + [0, 0, 0.1, 1 / 3])[:len(given)]
            self.assertEqual(struct.pack(f"<{len(right)}d", *given[:len(right)]),
                             struct.pack(f"<{len(right)}d", *right))

    @every_client
    def test_an_absent_hint_is_absent(self, child):
        child.prepare([(0, CYLINDER, BOX, 0, 0)])
        (answer,) = child.query([(0, pose(0), pose(0), None)])
        self.assertEqual(struct.pack("<3d", *answer.points[0][3:6]),
                         struct.pack("<3d", -0.0, 0.0, 5e-324))

    @every_client
    def test_shapes_may_be_unsupported_and_fail_to_be_prepared(self, child):
        self.assertEqual(child.prepare([(0, CYLINDER, BOX, 0, 0), (1, CYLINDER, SPHERE, 0, 0),
                                        (2, CYLINDER, CAPSULE, 0, 0)]), [True, False, True])
        answers = child.query([(handle, pose(0), pose(0), None) for handle in (2, 0, 1)])
        self.assertEqual([answer.status for answer in answers],
                         ["failed", "contact", "unsupported"])
        self.assertIn("no capsules today", child.messages())
        questions = [(handle, pose(0), pose(0), None) for handle in range(3)]
        self.assertEqual(child.time(2, questions), 2)  # for the first alone
        child.release([2, 1, 0])
        self.assertEqual(child.messages().count("released"), 1)

    @every_client
    def test_an_exception_fails_its_question_alone(self, child):
        child.prepare([(0, CYLINDER, BOX, 0, 0)])
        asked = (0, 1, 2, 3, 5, 6)
        answers = child.query([(0, pose(x), pose(0), None) for x in asked])
        self.assertEqual([answer.status for answer in answers],
                         ["contact", "failed", "failed", "none", "failed", "contact"])
        messages = child.messages()
        self.assertIn("one is too much", messages)
        self.assertIn("17 contact points, more than 16", messages)
        child.query([(0, pose(1), pose(0), None)])
        self.assertIn("one is too much", child.messages().rstrip().splitlines()[-1])

    @every_client
    def test_what_the_engine_prints_goes_to_standard_error(self, child):
        child.prepare([(0, CYLINDER, BOX, 0, 0)])
        (answer,) = child.query([(0, pose(4), pose(0), None)])
        self.assertEqual(answer.status, "contact")
        self.assertEqual(child.end(), 0)  # and nothing else was written
        for text in ("this is no hello", "printed", "written to the descriptor", "by a child"):
            self.assertIn(text, child.messages())

    @every_client
    def test_a_request_has_as_many_entries_as_may_be(self, child):
        count = 4096
        child.prepare([(handle, CYLINDER, BOX, handle, 0) for handle in range(count)])
        order = random.Random(1).sample(range(count), count)
        answers = child.query([(handle, pose(0.5), pose(handle), None) for handle in order])
        self.assertEqual([answer.points[1][3] for answer in answers], order)
        self.assertEqual([answer.points[5][6] for answer in answers], order)  # the thresholds
        child.release(order)
        child.prepare([(handle, CYLINDER, PLANE, 0, 0) for handle in order])
        self.assertEqual(child.query([(9, pose(0), pose(0), None)])[0].points[2][6], 0.6)

    @every_client
    def test_time_is_that_of_the_queries_alone(self, child):
        """By the clock of echo.py, which moves with queries and with whatever is read."""
        child.prepare([(0, CYLINDER, BOX, 0, 0)])
        questions = [(0, pose(x % 2), pose(0), None) for x in range(512)]  # half of them fail
        for passes in (1, 8):
            self.assertEqual(child.time(passes, questions), passes * len(questions))

    def test_another_protocol_is_refused(self):
        for command in CLIENTS.values():
            with self.subTest(command=command), self.assertRaises((EOFError, ValueError)) as caught:
                with Child([*command, "frames"], hello=b'{"touchstone": 2}\n'):
                    pass
            self.assertIn("protocol 1", str(caught.exception))


class Examples(unittest.TestCase):
    def test_examples_agree_with_closed_forms(self):
        """A cylinder of radius 0.5 and half length 1, and bodies at it."""
        half = math.sqrt(0.5)
        cylinder = {"shape": "cylinder", "radius": 0.5, "half_length": 1}
        sphere = {"shape": "sphere", "radius": 0.25}
        plane = {"shape": "plane", "normal": [0, 0, 1], "displacement": 0.5}
        box = {"shape": "box", "half_extents": [1, 1, 1]}
        capsule = {"shape": "capsule", "radius": 0.25, "half_length": 1}
        roof = {"shape": "convex",
                "vertices": [[-1, -2, 0], [-1, 2, 0], [1, -2, 0], [1, 2, 0], [0, -2, 1], [0, 2, 1]]}
        lying = (half, half, 0, 0)
        cases = [
            (sphere, pose(0), pose(0.7), -0.05, (-1, 0, 0)),
            (sphere, pose(0), pose(0, 0, -1.2), -0.05, (0, 0, 1)),
            (sphere, pose(0), pose(0.6, 0, 1.1), 0.1 * math.sqrt(2) - 0.25, (-half, 0, -half)),
            (sphere, pose(0), pose(0.8), None, None),
            (plane, pose(0, 0, 1.4), pose(0), -0.1, (0, 0, 1)),
            (plane, pose(0, 0, 0.9, lying), pose(0), -0.1, (0, 0, 1)),
            (plane, pose(0, 0, 1.4), pose(0, 0, 0.2), -0.3, (0, 0, 1)),
            (plane, pose(0, 0, 1.6), pose(0), None, None),
            (cylinder, pose(0), pose(0.3, 0, 1.9), -0.1, (0, 0, -1)),
            (cylinder, pose(0), pose(0, 0.9, 0, (half, 0, half, 0)), -0.1, (0, -1, 0)),
            (box, pose(0, 0, 1.45, lying), pose(0), -0.05, (0, 0, 1)),
            (box, pose(0, 0, 2.05), pose(0), None, None),
            (capsule, pose(0), pose(-0.7), -0.05, (1, 0, 0)),
            (roof, pose(0, 0, 1.45, lying), pose(0), -0.05, (0, 0, 1)),
            (roof, pose(0.8, 0, 0.8, lying), pose(0), 0.6 * half - 0.5, (half, 0, half)),
            (roof, pose(0.9, 0, 0.9, lying), pose(0), None, None),
        ]
        for program, script in ((sys.executable, "example.py"), ("node", "example.mjs")):
            with Child([program, str(HERE / script)]) as child:
                for i, (b, pose_a, pose_b, distance, normal) in enumerate(cases):
                    with self.subTest(script=script, case=i):
                        supported = child.prepare([(i, cylinder, b, 0, 0)])[0]
                        pair = f"cylinder-{b['shape']}"
                        self.assertEqual(supported, pair in child.hello["pairs"])
                        (answer,) = child.query([(i, pose_a, pose_b, None)])
                        if not supported:
                            self.assertEqual(answer.status, "unsupported")
                        elif distance is None:
                            self.assertEqual(answer.status, "none")
                        else:
                            self.assert_contact(answer, distance, normal)

    def assert_contact(self, answer, distance, normal):
        self.assertAlmostEqual(answer.signed_distance, distance, delta=1e-8)
        self.assertLess(math.dist(answer.normal, normal), 1e-4)
        self.assertAlmostEqual(max(point[6] for point in answer.points), -distance, delta=1e-8)


if __name__ == "__main__":
    unittest.main()
