"""The module's values, routines, truth, configurations and scores, and its stubs."""
import ast
import math
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import tracemalloc
import unittest
from fractions import Fraction

import numpy
import touchstone
from touchstone import (Box, Capsule, Configuration, Contact, Convex, Cylinder, Plane, Point, Pose,
                        Sphere)

CAN = Cylinder(0.5, 1)
FLOOR = Plane((0, 0, 1), 0)
LYING = (math.sqrt(0.5), math.sqrt(0.5), 0, 0)
OTHERS = [FLOOR, Sphere(0.75), Capsule(0.25, 0.5), Cylinder(0.3, 0.7), Box((0.5, 0.25, 0.125))]


def random_poses(count, seed, reach=1.5):
    """Of shape (count, 7), orientations of any length."""
    random = numpy.random.default_rng(seed)
    return numpy.hstack([random.uniform(-reach, reach, (count, 3)), random.normal(size=(count, 4))])


def pose_of(row):
    return Pose(row[:3], row[3:])


ROOF = Convex([(-1, -2, 0), (-1, 2, 0), (1, -2, 0), (1, 2, 0), (0, -2, 1), (0, 2, 1)])
TRIANGLE = Convex([(0, 0, 0.1), (1, 0, 0), (0, 1, 0)])


class Values(unittest.TestCase):
    all = OTHERS + [ROOF, TRIANGLE, Configuration(CAN, Pose(), ROOF, Pose()), CAN, Pose(), Pose((1, 2, 3), LYING), Point((1, 2, 3), (0, 0, 1), 0.5),
                    Contact(-0.25, (0, 0, 1), [Point((1, 2, 3), (0, 0, 1), 0.25)]),
                    Configuration(CAN, Pose((1, 2, 3)), Sphere(1), Pose()),
                    Configuration.of("cylinder-box/rim-face/1/2")]

    def test_what_is_printed_makes_the_same_value(self):
        for value in self.all:
            self.assertEqual(eval(repr(value), vars(touchstone)), value)

    def test_pickling_keeps_the_value(self):
        for value in self.all:
            self.assertEqual(pickle.loads(pickle.dumps(value)), value)

    def test_equal_values_have_equal_hashes(self):
        self.assertEqual(len({Cylinder(0.5, 1), Cylinder(0.5, 1.0), Cylinder(1, 0.5)}), 2)

    def test_a_rounding_is_part_of_a_value_and_need_not_be_given(self):
        for sharp, rounded, text in [
                (Cylinder(0.5, 1), Cylinder(0.5, 1, 0.25), "Cylinder(radius=0.5, half_length=1.0, rounding=0.25)"),
                (Box((1, 2, 3)), Box((1, 2, 3), rounding=0.25), "Box(half_extents=(1.0, 2.0, 3.0), rounding=0.25)"),
                (TRIANGLE, Convex(TRIANGLE.vertices, 0.25), repr(TRIANGLE)[:-1] + ", rounding=0.25)")]:
            self.assertEqual((sharp.rounding, rounded.rounding), (0, 0.25))
            self.assertNotEqual(sharp, rounded)
            self.assertEqual(repr(rounded), text)
            self.assertEqual(pickle.loads(pickle.dumps(rounded)), rounded)
        distance, normal = touchstone.signed_distance(Cylinder(2, 2, 1), Pose(), Sphere(4), Pose((4, 0, 5)))
        self.assertAlmostEqual(distance, 0, 14)  # 5 from the core's rim
        truth = touchstone.truth(Cylinder(2, 2, 1), Pose(), Sphere(4), Pose((4, 0, 5)))
        self.assertEqual((truth.lower, truth.upper), (0, 0))

    def test_different_values_and_types_differ(self):
        for i, value in enumerate(self.all):
            for other in self.all[:i]:
                self.assertNotEqual(value, other)
        self.assertNotEqual(Capsule(1, 2), Cylinder(1, 2))
        self.assertNotEqual(Pose(), None)

    def test_orientations_are_kept_as_given(self):
        self.assertEqual(Pose((0, 0, 0), (0, 0, 0, 2)).orientation.tolist(), [0, 0, 0, 2])
        self.assertNotEqual(Pose((0, 0, 0), (2, 0, 0, 0)), Pose())

    def test_a_rotation_or_an_axis_stands_in_place_of_the_orientation(self):
        quarter = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
        self.assertEqual(Pose((0, 0, 1), rotation=quarter), Pose((0, 0, 1), (1, -1, 0, 0)))
        self.assertEqual(Pose(rotation=numpy.array(quarter)).rotation.tolist(), quarter)
        self.assertEqual(Pose(axis=(0, 4, 0)), Pose((0, 0, 0), (1, -1, 0, 0)))
        for make, text in [(lambda: Pose(rotation=2 * numpy.eye(3)), "rotation is .*: must be a rotation"),
                           (lambda: Pose(axis=(0, 0, 0)), "axis is .*: must not be the zero vector"),
                           (lambda: Pose(axis=(0, 0, 1), rotation=quarter), "axis is given: must stand"),
                           (lambda: Pose((0, 0, 0), LYING, axis=(0, 0, 1)), "axis is given: must stand")]:
            with self.assertRaisesRegex(ValueError, text):
                make()

    def test_arrays_of_values_cannot_be_written_to(self):
        for array in (Pose().position, Pose().orientation, Pose().rotation, FLOOR.normal,
                      Box((1, 2, 3)).half_extents, TRIANGLE.vertices[0]):
            with self.assertRaises(ValueError):
                array[0] = 1

    def test_of_a_convex_body_corners_are_kept_in_their_order(self):
        corners = [(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        inner = [(0.25, 0.25, 0.25), (0.5, 0, 0), (0.25, 0.25, 0), (1, 0, 0)]
        body = Convex(corners[:2] + inner + corners[2:])
        self.assertEqual(body.vertices.tolist(), [list(c) for c in corners])
        self.assertEqual(body, Convex(numpy.array(corners)))
        self.assertNotEqual(body, Convex(corners[::-1]))
        tenth = math.nextafter(0.1, 1)  # no rounding decides what is outside
        self.assertEqual(len(Convex([(0, 0, 0), (1, 0, 0.1), (0, 1, 0.1), (0.5, 0.5, tenth)]).vertices), 4)

    def test_bad_sizes_are_refused_with_field_value_and_remedy(self):
        for make, text in [(lambda: Cylinder(-1, 1), "radius is -1: must be positive and finite"),
                           (lambda: Capsule(1, math.nan), "half_length is nan: must be"),
                           (lambda: Cylinder(1, 2, 1.5), "rounding is 1.5: must be 0 to the smallest half extent, 1"),
                           (lambda: Convex(TRIANGLE.vertices, -1), "rounding is -1: must not be negative"),
                           (lambda: Box((1, 0, 1)), r"half_extents\[1\] is 0: must be"),
                           (lambda: Plane((0, 0, 0), 1), "normal is .*: must"),
                           (lambda: Sphere(math.inf), "radius is inf: must be"),
                           (lambda: Convex([(0, 0, 0), (1, 1, 1)]), "vertices is .*: must"),
                           (lambda: Convex([(0, 0, 0), (1, 1, 1), (2, 2, 2)]), "vertices is .*: must"),
                           (lambda: Convex([(0, 0, 0), (1, 0, 0), (0, math.nan, 0)]), "vertices.*: must be finite"),
                           (lambda: Pose((0, math.nan, 0)), "position.* is nan: must be"),
                           (lambda: Pose((0, 0, 0), (0, 0, 0, 0)), "orientation is .*: must")]:
            with self.assertRaisesRegex(ValueError, text):
                make()

    def test_more_than_16_points_are_refused(self):
        point = Point((0, 0, 0), (0, 0, 1), 0)
        self.assertEqual(len(Contact(0, (0, 0, 1), [point] * 16).points), 16)
        with self.assertRaisesRegex(ValueError, "points is a sequence of 17: must be at most 16"):
            Contact(0, (0, 0, 1), [point] * 17)

    def test_other_types_are_refused(self):
        with self.assertRaisesRegex(TypeError, "b is 'ball': must be a Cylinder, Plane, Sphere"):
            touchstone.overlaps(CAN, Pose(), "ball", Pose())

    def test_masked_arrays_are_refused_by_name(self):
        three, four = numpy.ma.zeros(3), numpy.ma.zeros(4)
        three[1] = numpy.ma.masked
        for make, name in [(lambda: Pose(three), "position"),
                           (lambda: Pose((0, 0, 0), four), "orientation"),
                           (lambda: Plane(three, 1), "normal"),
                           (lambda: Box(numpy.ma.ones(3)), "half_extents"),
                           (lambda: Convex(numpy.ma.ones((3, 3))), "vertices"),
                           (lambda: Point(three, (0, 0, 1), 0), "position"),
                           (lambda: Point((0, 0, 0), three, 0), "normal"),
                           (lambda: Contact(0, three), "normal")]:
            with self.assertRaisesRegex(TypeError, f"(?s){name} is masked_array.*must be .* numbers, none of them"):
                make()

    def test_vectors_of_other_lengths_are_refused_by_name(self):
        for make, text in [(lambda: Pose((0, 0)), r"position is \(0, 0\): must be three numbers"),
                           (lambda: Box("abc"), "half_extents is 'abc': must be three numbers"),
                           (lambda: Convex([(0, 0), (1, 0), (0, 1)]), r"vertices is .*: must be rows of three"),
                           (lambda: Pose((0, 0, 0), None), "orientation is None: must be four")]:
            with self.assertRaisesRegex(TypeError, text):
                make()


class OnePairOfPoses(unittest.TestCase):
    def test_a_standing_cylinder_touches_the_floor_along_its_rim(self):
        contact = touchstone.contact(CAN, Pose((0, 0, 0.75)), FLOOR, Pose())
        self.assertEqual(contact.signed_distance, -0.25)
        self.assertEqual(contact.normal.tolist(), [0, 0, 1])
        self.assertGreaterEqual(len(contact.points), 3)
        for point in contact.points:
            self.assertEqual(point.depth, 0.25)
            self.assertAlmostEqual(math.hypot(*point.position[:2]), 0.5, delta=1e-15)
            self.assertEqual(point.position[2], -0.125)

    def test_a_cylinder_on_a_box_overlaps_as_deep_as_it_was_let_down(self):
        self.assertTrue(touchstone.overlaps(CAN, Pose((0, 0, 1.5)), Box((1, 1, 0.75)), Pose()))
        self.assertFalse(touchstone.overlaps(CAN, Pose((0, 0, 2)), Box((1, 1, 0.75)), Pose()))

    def test_points_are_given_up_to_the_threshold(self):
        bodies = CAN, Pose((0, 0, 1.5)), FLOOR, Pose()
        self.assertIsNone(touchstone.contact(*bodies))
        self.assertEqual(touchstone.contact(*bodies, threshold=0.5).points[0].depth, -0.5)
        for threshold in (-1, math.nan, math.inf):
            with self.assertRaisesRegex(ValueError, "threshold is .*: must be finite and not neg"):
                touchstone.contact(*bodies, threshold)


class Batches(unittest.TestCase):
    def test_they_are_single_answers_to_the_bit(self):
        of_a, of_b = random_poses(200, 1), random_poses(200, 2)
        for b in OTHERS:
            distances, normals = touchstone.signed_distance(CAN, of_a, b, of_b)
            overlap = touchstone.overlaps(CAN, of_a, b, of_b)
            contacts = touchstone.contact(CAN, of_a, b, of_b, 0.1)
            self.assertEqual(len(contacts), 200)
            self.assertTrue(0 < overlap.sum() < 200)
            for i, rows in enumerate(zip(of_a, of_b)):
                bodies = CAN, pose_of(rows[0]), b, pose_of(rows[1])
                distance, normal = touchstone.signed_distance(*bodies)
                self.assertEqual(distances[i].tobytes(), numpy.float64(distance).tobytes())
                self.assertEqual(normals[i].tobytes(), normal.tobytes())
                self.assertEqual(overlap[i], touchstone.overlaps(*bodies))
                contact = touchstone.contact(*bodies, 0.1)
                count = contacts.counts[i]
                self.assertTrue(numpy.isnan(contacts.positions[i, count:]).all())
                self.assertTrue(numpy.isnan(contacts.depths[i, count:]).all())
                self.assertEqual(contact is None, distance > 0.1)
                if contact is None:
                    self.assertEqual(count, 0)
                    continue
                self.assertEqual(contacts.signed_distances[i], contact.signed_distance)
                self.assertEqual(contacts.normals[i].tobytes(), contact.normal.tobytes())
                self.assertEqual(count, len(contact.points))
                for k, point in enumerate(contact.points):
                    self.assertEqual(contacts.positions[i, k].tobytes(), point.position.tobytes())
                    self.assertEqual(contacts.depths[i, k], point.depth)

    def test_one_pose_stands_for_all_rows(self):
        poses, one = random_poses(50, 3), random_poses(1, 4)
        repeated = numpy.ascontiguousarray(numpy.repeat(one, 50, axis=0))
        for of_one, of_many in [((poses, pose_of(one[0])), (poses, repeated)),
                                ((pose_of(one[0]), poses), (repeated, poses))]:
            values = [touchstone.signed_distance(CAN, a, OTHERS[1], b)[0]
                      for a, b in (of_one, of_many)]
            numpy.testing.assert_array_equal(*values)

    def test_arrays_are_read_where_they_lie(self):
        poses = random_poses(200000, 5)
        poses.flags.writeable = False
        tracemalloc.start()
        result = touchstone.overlaps(CAN, poses, OTHERS[1], Pose())
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        self.assertLess(peak, result.nbytes + poses.nbytes // 10)

    def test_an_empty_batch_has_empty_results(self):
        none = numpy.empty((0, 7))
        self.assertEqual(touchstone.overlaps(CAN, none, FLOOR, Pose()).shape, (0,))
        self.assertEqual(touchstone.signed_distance(CAN, none, FLOOR, none)[1].shape, (0, 3))
        self.assertEqual(touchstone.contact(CAN, none, FLOOR, none).positions.shape, (0, 8, 3))

    def test_arrays_of_other_kinds_are_refused(self):
        poses = random_poses(4, 6)
        for bad, text in [(poses.astype(numpy.float32), "pose_a is an array of float32: must be a"),
                          (poses.astype(">f8"), "pose_a is an array of >f8: must be"),
                          (poses.astype(int), "pose_a is an array of int64: must be"),
                          (poses[:, :6], r"pose_a is an array of shape \(4, 6\): must be"),
                          (poses[0], r"pose_a is an array of shape \(7,\): must be"),
                          (numpy.asfortranarray(poses), "use numpy.ascontiguousarray: must be"),
                          (poses[::2], "use numpy.ascontiguousarray: must be"),
                          (numpy.ma.masked_array(poses), "pose_a is a masked array, whose mask"),
                          (poses.tolist(), "pose_a is a list: must be")]:
            for question in (touchstone.overlaps, touchstone.signed_distance, touchstone.contact):
                with self.assertRaisesRegex(TypeError, text):
                    question(CAN, bad, FLOOR, Pose())

    def test_different_numbers_of_rows_are_refused(self):
        with self.assertRaisesRegex(ValueError, "pose_b is an array of 3 rows: must have as many"):
            touchstone.overlaps(CAN, random_poses(4, 7), FLOOR, random_poses(3, 7))

    def test_a_bad_row_is_named(self):
        poses = random_poses(5, 8)
        poses[3, 3:] = 0
        with self.assertRaisesRegex(ValueError, r"pose_b\[3\]\.orientation is .*: must"):
            touchstone.overlaps(CAN, Pose(), FLOOR, poses)

    def test_other_threads_run_meanwhile(self):
        poses, counts, seen = random_poses(1000000, 9), [0], []

        def ask():
            before = counts[0]
            touchstone.signed_distance(CAN, poses, OTHERS[3], Pose())
            seen.append((before, counts[0]))

        interval = sys.getswitchinterval()
        sys.setswitchinterval(60)  # a thread goes on only once the other one gives up the lock
        try:
            thread = threading.Thread(target=ask)
            thread.start()
            while thread.is_alive():
                counts[0] += 1
                time.sleep(0)
        finally:
            sys.setswitchinterval(interval)
        self.assertGreater(seen[0][1], seen[0][0] + 1)  # one: the lock is given up on the way in


class ACast(unittest.TestCase):
    """A can of 1 m half length is let down onto a unit sphere from 5 m: it touches after 3 m."""

    def setUp(self):
        self.can, self.above, self.ball = Cylinder(0.5, 1), Pose((0, 0, 5)), Sphere(1)

    def test_touches_never_or_from_the_start(self):
        def cast(height, down):
            return touchstone.cast(self.can, Pose((0, 0, height)), (0, 0, -down), self.ball, Pose())
        status, fraction, normal = cast(5, 4)
        self.assertEqual((status, fraction, tuple(normal)), ("touch", 0.75, (0, 0, 1)))
        self.assertEqual(cast(5, 2.5)[:2], ("never", 1))
        self.assertEqual(cast(1.5, 2)[:2], ("from-start", 0))

    def test_a_batch_is_single_casts(self):
        poses = numpy.array([[0, 0, 5, 1, 0, 0, 0], [0, 0, 3, 1, 0, 0, 0]], dtype=float)
        sweeps = numpy.array([[0, 0, -4], [0, 0, -0.5]])
        statuses, fractions, normals = touchstone.cast(self.can, poses, sweeps, self.ball, Pose())
        self.assertEqual(statuses, ["touch", "never"])
        self.assertEqual(list(fractions), [0.75, 1])
        self.assertEqual(normals.shape, (2, 3))
        with self.assertRaisesRegex(ValueError, "sweep is an array of 1 rows: must have as many"):
            touchstone.cast(self.can, poses, sweeps[:1], self.ball, Pose())

    def test_what_is_no_sweep_is_refused(self):
        for sweep in ("down", (1, 2), numpy.zeros((2, 2))):
            with self.assertRaisesRegex(TypeError, "(?s)sweep is .*must be three numbers"):
                touchstone.cast(self.can, self.above, sweep, self.ball, Pose())
        with self.assertRaisesRegex(ValueError, "sweep is not finite"):
            touchstone.cast(self.can, self.above, (0, 0, numpy.inf), self.ball, Pose())

    def test_the_first_touch_is_proven(self):
        touch = touchstone.first_touch(self.can, self.above, (0, 0, -9), self.ball, Pose())
        self.assertEqual(touch.status, "touch")
        self.assertTrue(touch.lower <= Fraction(1, 3) <= touch.upper)
        self.assertLessEqual(touch.upper - touch.lower, Fraction(1e-20))
        self.assertEqual(touch.truth.normals.tolist(), [[0, 0, 1]])
        away = touchstone.first_touch(self.can, self.above, (0, 0, 9), self.ball, Pose())
        self.assertEqual((away.status, away.fraction, away.truth), ("never", 1, None))

    def test_a_body_that_tips_over_touches_on_its_way(self):
        near = touchstone.first_touch(self.can, Pose((0, 0, 1.1)), (0, 0, 0),
                                      touchstone.Plane((0, 0, 1), 0), Pose(), spin=(1.5, 0, 0))
        self.assertEqual(near.status, "touch")
        angle = math.asin(1.1 / math.sqrt(1.25)) - math.atan(2)
        self.assertAlmostEqual(near.fraction, angle / 1.5, places=11)


class TheTruth(unittest.TestCase):
    def test_a_rational_distance_is_enclosed(self):
        for width in (1e-3, 1e-15, 1e-60):
            truth = touchstone.truth(Cylinder(1, 1), Pose(), Sphere(1), Pose((4, 0, 5)), width)
            self.assertIsInstance(truth.lower, Fraction)
            self.assertTrue(truth.lower <= 4 <= truth.upper)
            self.assertLessEqual(truth.upper - truth.lower, Fraction(width))
        self.assertEqual(truth.signed_distance, 4.0)
        numpy.testing.assert_allclose(truth.normals, [[-0.6, 0, -0.8]], atol=1e-15)

    def test_ties_are_told(self):
        inside = touchstone.truth(Cylinder(0.5, 8), Pose(), Sphere(0.25), Pose())
        self.assertEqual(inside.ties, "continuum")
        cube = touchstone.truth(Cylinder(0.5, 1), Pose(), Box((4, 4, 1)), Pose())
        self.assertEqual(cube.ties, "finite")
        self.assertEqual(sorted(cube.normals.tolist()), [[0, 0, -1], [0, 0, 1]])
        self.assertEqual(touchstone.truth(CAN, Pose(), FLOOR, Pose()).ties, "unique")

    def test_patches_are_what_the_bodies_share(self):
        [disc] = touchstone.truth(CAN, Pose((0, 0, 1)), FLOOR, Pose()).patches
        self.assertEqual(disc.kind, "region")
        self.assertAlmostEqual(disc.area, math.pi / 4, delta=1e-15)
        numpy.testing.assert_allclose(disc.centroid, [0, 0, 0], atol=1e-15)
        self.assertEqual(disc.outline.shape[1], 3)
        [line] = touchstone.truth(CAN, Pose((0, 0, 0.5), (1, 1, 0, 0)), FLOOR, Pose()).patches
        self.assertEqual((line.kind, line.perimeter, line.area), ("segment", 2, 0))
        [point] = touchstone.truth(CAN, Pose((0, 0, 2)), Sphere(1), Pose()).patches
        self.assertEqual(point.kind, "point")

    def test_a_batch_has_the_truth_of_each_row(self):
        of_a, of_b = random_poses(6, 10), random_poses(6, 11)

        def row(poses, i):
            return poses if isinstance(poses, Pose) else pose_of(poses[i])

        for b in OTHERS:
            for pose_a, pose_b in [(of_a, of_b), (of_a, Pose()), (Pose(), of_b)]:
                truths = touchstone.truth(CAN, pose_a, b, pose_b, width=1e-20)
                self.assertEqual(len(truths), 6)
                for i, truth in enumerate(truths):
                    alone = touchstone.truth(CAN, row(pose_a, i), b, row(pose_b, i), width=1e-20)
                    for member in ("lower", "upper", "ties"):
                        self.assertEqual(getattr(truth, member), getattr(alone, member))
                    numpy.testing.assert_array_equal(truth.normals, alone.normals)
        self.assertEqual(touchstone.truth(CAN, numpy.empty((0, 7)), FLOOR, Pose()), [])
        with self.assertRaisesRegex(TypeError, "pose_a is an array of float32: must be a Pose, or"):
            touchstone.truth(CAN, of_a.astype(numpy.float32), FLOOR, Pose())

    def test_a_width_that_is_not_positive_is_refused(self):
        with self.assertRaisesRegex(ValueError, "width is 0"):
            touchstone.truth(CAN, Pose(), FLOOR, Pose(), 0)


class Configurations(unittest.TestCase):
    def test_an_identity_gives_the_same_configuration(self):
        for pair in touchstone.PAIRS:
            for drawn in touchstone.configurations(pair, seed=7, count=1)[:5]:
                self.assertEqual(Configuration.of(drawn.identity), drawn)
                self.assertEqual(drawn.pair, pair)
                self.assertTrue(drawn.identity.startswith(pair))

    def test_as_many_as_asked_for_of_each_class(self):
        pair = "cylinder-sphere"
        self.assertEqual(len(touchstone.configurations(pair, count=2)),
                         2 * len(touchstone.classes(pair)))
        self.assertEqual(len(touchstone.configurations(pair, ["general-shallow"])), 10)
        for count in (0, 10**12, 10**8 + 1):
            with self.assertRaisesRegex(ValueError, f"count is {count}: must be from 1 to as many"):
                touchstone.configurations(pair, ["general-shallow"], count=count)

    def test_ctrl_c_ends_a_long_drawing(self):
        alarm = signal.signal(signal.SIGALRM, signal.default_int_handler)
        try:
            with self.assertRaises(KeyboardInterrupt):
                signal.setitimer(signal.ITIMER_REAL, 0.05)
                touchstone.configurations("cylinder-sphere", ["general-shallow"], count=10**7)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, alarm)

    def test_your_own_have_no_identity(self):
        own = Configuration(CAN, Pose((0, 0, 1)), Sphere(1), Pose())
        self.assertEqual((own.identity, own.pair), ("", "cylinder-sphere"))
        self.assertIn("Sphere(radius=1.0)", repr(own))

    def test_unknown_names_are_refused_by_what_there_is(self):
        with self.assertRaisesRegex(ValueError, "pair is .*cylinder-cone.*: must be one of"):
            touchstone.classes("cylinder-cone")
        with self.assertRaisesRegex(ValueError, "classes is .*lyng.*lying"):
            touchstone.configurations("cylinder-plane", ["lyng"])
        with self.assertRaises(TypeError):  # not a list of letters
            touchstone.configurations("cylinder-plane", "lying")
        with self.assertRaisesRegex(ValueError, "identity"):
            Configuration.of("nowhere")


class Scores(unittest.TestCase):
    deep = Configuration(CAN, Pose((0, 0, 0.75)), FLOOR, Pose())

    def outcome(self, answer):
        return touchstone.score(self.deep, answer).outcome

    def test_right_and_wrong_answers_are_told_apart(self):
        right = touchstone.contact(CAN, self.deep.pose_a, FLOOR, Pose())
        score = touchstone.score(self.deep, right)
        self.assertEqual((score.outcome, score.severity, score.reason), ("agree", 0, ""))
        self.assertEqual((score.depth_error, score.normal_regret), (0, 0))
        up, point = (0, 0, 1), right.points[0]
        self.assertEqual(self.outcome(Contact(-0.125, up, [point])), "shallow")
        self.assertEqual(touchstone.score(self.deep, Contact(-0.125, up)).depth_error, 0.25)
        self.assertEqual(self.outcome(Contact(-0.5, up, [point])), "overdeep")
        self.assertEqual(self.outcome(Contact(-0.25, (1, 0, 0), [point])), "wrong-normal")
        self.assertEqual(self.outcome(Contact(-0.25, up)), "no-points")
        self.assertEqual(self.outcome(None), "missed")
        self.assertEqual(self.outcome(NotImplemented), "unsupported")

    def test_what_is_not_finite_is_told(self):
        point = Point((0, 0, math.inf), (0, 0, 1), 0.25)
        for answer in (Contact(math.nan, (0, 0, 1)), Contact(-0.25, (0, math.nan, 1)),
                       Contact(-0.25, (0, 0, 1), [point])):
            self.assertEqual(self.outcome(answer), "not-finite")

    def test_nonsense_has_failed_and_says_why(self):
        score = touchstone.score(self.deep, -0.25)
        self.assertEqual(score.outcome, "failed")
        self.assertIn("returned float: must be touchstone.Contact", score.reason)
        self.assertIsNone(score.depth_error)

    def test_many_are_scored_in_order(self):
        scores = touchstone.scores([self.deep] * 2, [None, NotImplemented])
        self.assertEqual([s.outcome for s in scores], ["missed", "unsupported"])
        with self.assertRaisesRegex(ValueError, "answers is a sequence of 1: must be as many"):
            touchstone.scores([self.deep] * 2, [None])


STUB = ast.parse(pathlib.Path(touchstone.__file__).with_suffix(".pyi").read_text())


class Arguments(unittest.TestCase):
    """What is wrong is named, with what would be right, whatever is called."""

    good = {"radius": 1, "rounding": 0, "half_length": 1, "normal": (0, 0, 1), "displacement": 0,
            "half_extents": (1, 1, 1), "vertices": TRIANGLE.vertices, "position": (0, 0, 0), "orientation": (1, 0, 0, 0),
            "depth": 0, "signed_distance": 0, "points": (), "a": CAN, "pose_a": Pose(), "b": FLOOR,
            "pose_b": Pose(), "threshold": 0, "sweep": (0, 0, 1), "spin": (0, 0, 0), "width": 1e-3, "pair": "cylinder-plane",
            "classes": ["lying"], "seed": 1, "count": 1, "tolerance": 1e-4,
            "configuration": Configuration(CAN, Pose(), FLOOR, Pose()), "answer": None,
            "configurations": [], "answers": [], "identity": "cylinder-plane/lying/1/0",
            "function": touchstone.contact, "name": "f", "pairs": ["cylinder-plane"],
            "groups": None, "candidates": [], "seconds": 1, "workers": 1, "version": "",
            "settings": "", "rotation": None, "axis": None}

    @classmethod
    def calls(cls):
        """Functions and constructors, their names, and good arguments by their names."""
        def named(function, skipped=0):
            return {a.arg: cls.good[a.arg] for a in function.args.args[skipped:]}

        yield Configuration.of, "Configuration.of", {"identity": cls.good["identity"]}
        for node in STUB.body:
            if isinstance(node, ast.FunctionDef):
                yield getattr(touchstone, node.name), node.name, named(node)
            for member in node.body if isinstance(node, ast.ClassDef) else []:
                if getattr(member, "name", "") == "__init__":
                    yield getattr(touchstone, node.name), node.name, named(member, 1)

    def error_of(self, call, *given, **named):
        with self.assertRaises(TypeError, msg=(call, given, named)) as raised:
            call(*given, **named)
        return str(raised.exception)

    def test_an_argument_of_another_type_is_named(self):
        count = 0
        for call, name, arguments in self.calls():
            for parameter, value in arguments.items():
                if parameter == "answer":
                    continue  # whatever a function returns can be scored
                bad = [object()]
                if parameter not in ("configurations", "answers"):  # as many of which are asked for
                    bad += [[object()]] + ([] if isinstance(value, str) else ["x" * 10000])
                for other in bad:
                    told = self.error_of(call, **{**arguments, parameter: other})
                    self.assertRegex(told, rf"^{parameter}(\[0\])? is .*: must be .", name)
                    self.assertLess(len(told), 400, name)
                    count += 1
        self.assertGreater(count, 150)

    def test_missing_unknown_and_too_many_arguments_are_named(self):
        for call, name, arguments in self.calls():
            names, first = ", ".join(arguments), next(iter(arguments))
            self.assertEqual(self.error_of(call, **arguments, colour=1),
                             f"colour is no argument of {name}: must be one of {names}")
            most = f"must be at most {len(arguments)}: {names}"
            self.assertEqual(self.error_of(call, *[0] * 20), f"{name} is given 20 arguments: {most}")
            self.assertEqual(self.error_of(call, arguments[first], **arguments),
                             f"{first} is given twice: must be given once")
            if name != "Pose":  # which has defaults for all
                self.assertEqual(self.error_of(call), f"{first} is missing: {name} takes {names}")

    def test_elements_of_sequences_are_named(self):
        own, point = self.good["configuration"], Point((0, 0, 0), (0, 0, 1), 0)
        self.assertEqual(self.error_of(touchstone.scores, [own, 7], [None, None]),
                         "configurations[1] is 7: must be a Configuration of touchstone")
        self.assertEqual(self.error_of(Contact, 0, (0, 0, 1), [point, None]),
                         "points[1] is None: must be a Point of touchstone")

    def test_without_numpy_the_module_says_that_it_needs_it(self):
        code = "import sys; sys.modules['numpy'] = None; import touchstone"
        told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stderr
        self.assertIn("ImportError: touchstone needs numpy (Debian: python3-numpy)", told)


class Stubs(unittest.TestCase):
    """The stubs say what the module has; of functions, what the first line of a docstring says."""

    @staticmethod
    def parameters(function):
        """Names, and defaults as text where the stubs give them."""
        names = [argument.arg for argument in function.args.args]
        return names, [ast.unparse(default) for default in function.args.defaults]

    def test_names_and_members_are_the_modules(self):
        classes = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
        functions = {n.name for n in STUB.body if isinstance(n, ast.FunctionDef)}
        self.assertEqual(functions | classes.keys() | {"PAIRS"}, set(touchstone.__all__))
        for name, node in classes.items():
            names = [m.target.id if isinstance(m, ast.AnnAssign) else m.name for m in node.body]
            members = {name for name in names if not name.startswith("_")}
            actual = {m for m in vars(getattr(touchstone, name)) if not m.startswith("_")}
            self.assertEqual(members, actual, name)

    def test_parameters_are_those_of_the_docstrings(self):
        for node in STUB.body:
            if isinstance(node, ast.FunctionDef):
                signature = getattr(touchstone, node.name).__doc__.split("\n\n")[0]
                [documented] = ast.parse(f"def {signature}: ...").body
                names, defaults = self.parameters(documented)
                self.assertEqual(self.parameters(node)[0], names)
                self.assertEqual(self.parameters(node)[1], defaults)


if __name__ == "__main__":
    unittest.main()
