"""Cylinder contacts: the exact truth, Touchstone's own routines, and scores of yours.

A cylinder (body A) meets a plane, sphere, capsule, cylinder, box or convex body (body B). Lengths are
in metres; poses map a body's frame to the world's; normals are unit vectors from B to A in the
world's frame, along which A moves to come free; signed distances are positive apart and negative
inside.

>>> def mine(a, pose_a, b, pose_b, threshold):
...     return None  # there is never a contact
>>> r = touchstone.report(mine, "mine", pairs=["cylinder-plane"], classes=["lying"], count=1)
>>> r
<touchstone.Report: 1 configuration, 2 candidates>

`print(r)` shows a table, `r.save("out")` writes out/report.html. docs/your-poses.md explains it.
"""

try:
    import numpy
except ImportError as reason:
    raise ImportError("touchstone needs numpy (Debian: python3-numpy)") from reason
del numpy

from ._touchstone import (PAIRS, Box, Capsule, Configuration, Contact, Contacts, Convex, Cylinder,
                          FirstTouch, Patch, Plane, Point, Pose, Report, Score, Sphere, Truth,
                          __version__, cast, classes, configurations, contact, first_touch,
                          overlaps, report, score, scores, signed_distance, truth)

__all__ = ["PAIRS", "Box", "Capsule", "Configuration", "Contact", "Contacts", "Convex", "Cylinder",
           "FirstTouch", "Patch", "Plane", "Point", "Pose", "Report", "Score", "Sphere", "Truth",
           "cast", "classes", "configurations", "contact", "first_touch", "overlaps", "report",
           "score", "scores", "signed_distance", "truth"]
