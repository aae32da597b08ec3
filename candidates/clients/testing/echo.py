"""Answers what clients_test.py expects: numbers of the question, or a misbehaviour that the first
coordinate of A asks for. The argument is the format."""

import math
import os
import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))
import touchstone_candidate
from touchstone_candidate import Candidate, Capsule, Contact, Convex, Point, Pose, Sphere, run

print("this is no hello")

# The clock moves by one with every query and with every pose that the client reads, not by itself: what the client
# measures is exact, and tells whether it measures anything but queries.
clock = 0


def read_pose(*fields):
    global clock
    clock += 1
    return Pose(*fields)


touchstone_candidate.Pose = read_pose
time.perf_counter_ns = lambda: clock


class Echo(Candidate):
    name, version, settings = "echo", "1", "none"
    pairs = ("cylinder-plane", "cylinder-box", "cylinder-cylinder", "cylinder-convex")
    format = sys.argv[1]
    parameter = {"meaning": "number", "min": 0, "max": 9, "usual": 3, "whole": True}
    models = "nothing at all"

    def prepare(self, a, b, threshold, parameter):
        if isinstance(b, Sphere):
            return None
        if isinstance(b, Capsule):
            raise ValueError("no capsules today")
        if isinstance(b, Convex):
            sizes = [x for vertex in b.vertices for x in vertex]
        else:
            sizes = [*b.half_extents] if hasattr(b, "half_extents") else [*b.normal, b.displacement]
        return [a.radius, a.half_length, *sizes, threshold, parameter]

    def query(self, prepared, pose_a, pose_b, hint):
        global clock
        clock += 1
        asked = pose_a.position[0]
        if asked == 1:
            raise ValueError("one is too much")
        if asked == 2:
            return Contact(0.0, (0, 0, 1), [Point((0, 0, 0), (0, 0, 1), 0.0)] * 17)
        if asked == 3:
            return None
        if asked == 4:
            print("printed")
            os.write(1, b"written to the descriptor\n")
            os.system("echo by a child")
            assert sys.stdin.read() == ""
        if asked == 5:
            return Contact("far", (0, 0, 1))
        points = [Point(pose_a.position, pose_b.position, prepared[i % len(prepared)])
                  for i in range(16)]
        points[0] = Point((math.nan, math.inf, -math.inf), hint or (-0.0, 0.0, 5e-324), -0.0)
        return Contact(pose_a.orientation[0], pose_b.orientation[1:], points)

    def model_distance(self, prepared, pose_a, pose_b):
        return pose_b.orientation[0] if pose_a.position[0] != 3 else math.nan

    def release(self, prepared):
        print("released", prepared[0])


run(Echo)
