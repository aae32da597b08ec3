"""Makes an engine in Python a candidate of Touchstone (candidates/host/protocol.md).

    from touchstone_candidate import Candidate, Contact, Point, run

    class Mine(Candidate):
        name, version, settings = "mine", "0.1", "closed form, double precision"
        pairs = ("cylinder-sphere",)

        def query(self, prepared, pose_a, pose_b, hint):
            return Contact(signed_distance, normal, [Point(position, normal, depth)])

    run(Mine)

    touchstone --candidate-command "python3 mine.py" report --count 2

Import this module before any other: from then on, what the process prints goes to standard error,
for standard output belongs to the protocol, and reads of standard input find its end. Needs Python
3.11 and nothing else. Lengths are in metres, body A is the cylinder, normals are unit vectors from
B to A in the world's frame.
"""

from __future__ import annotations

import json
import math
import os
import struct
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple, TypeAlias

Vector: TypeAlias = tuple[float, float, float]
MAX_POINTS = 16


class Cylinder(NamedTuple):
    """About the origin, along z."""

    radius: float
    half_length: float


class Plane(NamedTuple):
    """Solid where normal . x <= displacement."""

    normal: Vector
    displacement: float


class Sphere(NamedTuple):
    radius: float


class Capsule(NamedTuple):
    """About the origin, along z; `half_length` is that of the segment, without the round ends."""

    radius: float
    half_length: float


class Box(NamedTuple):
    half_extents: Vector


class Convex(NamedTuple):
    """The hull of its vertices, each of them a corner; flat where they lie in one plane."""

    vertices: tuple[Vector, ...]


Shape: TypeAlias = Cylinder | Plane | Sphere | Capsule | Box | Convex


class Pose(NamedTuple):
    """Maps a body's frame to the world's."""

    position: Vector
    orientation: tuple[float, float, float, float]
    """Unit quaternion w, x, y, z."""

    def rotate(self, v: Sequence[float]) -> Vector:
        """Turns a direction of the body's frame into the world's."""
        return _rotate(*self.orientation, v)

    def rotate_back(self, v: Sequence[float]) -> Vector:
        """Turns a direction of the world's frame into the body's."""
        w, x, y, z = self.orientation
        return _rotate(w, -x, -y, -z, v)


def _rotate(w: float, x: float, y: float, z: float, v: Sequence[float]) -> Vector:
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (v[0] + w * tx + y * tz - z * ty,
            v[1] + w * ty + z * tx - x * tz,
            v[2] + w * tz + x * ty - y * tx)


class Point(NamedTuple):
    position: Sequence[float]
    """By the engine's own convention; Touchstone's are halfway between the two surfaces."""
    normal: Sequence[float]
    depth: float
    """Positive inside, negative apart."""


class Contact(NamedTuple):
    signed_distance: float
    """Negative inside."""
    normal: Sequence[float]
    points: Sequence[Point] = ()
    """At most MAX_POINTS."""


class Candidate:
    """An engine. A subclass sets `name` to `pairs` and defines `query`; the rest is optional."""

    name: str
    """As on the command line: printable ASCII without colon, comma, slash or space, not "-…"."""
    version: str
    settings: str
    """How the engine is called: algorithm, margin, tolerance, where its contact points lie."""
    pairs: Sequence[str]
    """Of cylinder-plane, cylinder-sphere, cylinder-capsule, cylinder-cylinder, cylinder-box,
    cylinder-convex."""

    precision = "double"
    """Or "float"."""
    runs = "script"
    """Or "native", for bindings of a compiled engine."""
    format = "frames"
    """Or "lines": requests and answers as text, for debugging."""
    parameter: dict[str, Any] | None = None
    """For a family: {"meaning": "margin, metres", "min": 0, "max": 1, "usual": 0.01}."""
    models: str | None = None
    """What replaces the shapes, in a simplified model."""

    def prepare(self, a: Cylinder, b: Shape, threshold: float, parameter: float) -> Any:
        """Makes two shapes ready, untimed, and returns what `query` needs; None: unsupported.

        Contacts up to `threshold` apart are to be reported."""
        return a, b

    def query(self, prepared: Any, pose_a: Pose, pose_b: Pose,
              hint: Vector | None) -> Contact | None:
        """Returns the contact; None: the bodies are further apart than the threshold.

        The answer depends on the arguments alone. `hint`, the normal of the previous frame, may
        only decide between normals that are equally good. An exception counts as a failure of this
        question; its text goes to standard error."""
        raise NotImplementedError

    def release(self, prepared: Any) -> None:
        """Frees what `prepare` returned."""

    def model_distance(self, prepared: Any, pose_a: Pose, pose_b: Pose) -> float:
        """Returns the exact signed distance of what `models` names; NaN: unknown."""
        return math.nan


def run(make: Callable[[], Candidate]) -> None:
    """Answers Touchstone until standard input ends. `make` is the subclass, or makes one of it."""
    candidate = make()
    hello = json.loads(_requests.readline() or b"{}")
    if hello.get("touchstone") != 1:
        sys.exit(f"expected the hello of Touchstone's protocol 1, got {hello}")
    if candidate.format not in ("frames", "lines"):
        sys.exit(f'format must be "frames" or "lines", not {candidate.format!r}')
    names = ("name", "version", "settings", "precision", "runs", "format", "parameter", "models")
    members = {name: getattr(candidate, name) for name in names}
    _write_line({"touchstone": 1, "pairs": list(candidate.pairs)}
                | {name: value for name, value in members.items() if value is not None})
    if candidate.format == "frames":
        _answer_frames(_Engine(candidate))
    else:
        _answer_lines(_Engine(candidate))


# The private standard input and output: whatever else the process reads finds the end, whatever
# else it or its children print goes to standard error.
_requests = os.fdopen(os.dup(0), "rb")
_answers = os.fdopen(os.dup(1), "wb")
with open(os.devnull, "rb") as _nothing:
    os.dup2(_nothing.fileno(), 0)
os.dup2(2, 1)


class _Question(NamedTuple):
    handle: int
    pose_a: Pose
    pose_b: Pose
    hint: Vector | None


class _Answer(NamedTuple):
    status: str
    contact: Contact | None = None
    model_distance: float = math.nan


class _Failed(NamedTuple):
    """Takes the place of what `prepare` would have returned, had it not raised."""

    error: Exception


class _Engine:
    """The candidate with what it has prepared, by handle."""

    def __init__(self, candidate: Candidate) -> None:
        self.candidate = candidate
        self.prepared: dict[int, Any] = {}

    def prepare(self, handle: int, a: Cylinder, b: Shape, threshold: float,
                parameter: float) -> bool:
        try:
            self.prepared[handle] = self.candidate.prepare(a, b, threshold, parameter)
        except Exception as error:
            self.prepared[handle] = _Failed(error)
        return self.prepared[handle] is not None

    def query(self, question: _Question, encode: Callable[[_Answer], Any]) -> Any:
        """The encoded answer; what cannot be encoded is a failure as well."""
        handle, pose_a, pose_b, hint = question
        prepared = self.prepared[handle]
        if prepared is None:
            return encode(_Answer("unsupported"))
        try:
            if isinstance(prepared, _Failed):
                raise prepared.error
            distance = math.nan
            if self.candidate.models is not None:
                distance = self.candidate.model_distance(prepared, pose_a, pose_b)
            contact = self.candidate.query(prepared, pose_a, pose_b, hint)
            return encode(_Answer("none" if contact is None else "contact", contact, distance))
        except Exception:
            traceback.print_exc()
            sys.stderr.flush()
            return encode(_Answer("failed"))

    def time(self, passes: int, questions: Sequence[_Question]) -> int:
        """Nanoseconds for all passes over all questions; a failure takes what it takes."""
        asked = [(self.prepared[q.handle], q.pose_a, q.pose_b, q.hint) for q in questions]
        asked = [q for q in asked if q[0] is not None and not isinstance(q[0], _Failed)]
        query = self.candidate.query
        begin = time.perf_counter_ns()
        for _ in range(passes):
            for prepared, pose_a, pose_b, hint in asked:
                try:
                    query(prepared, pose_a, pose_b, hint)
                except Exception:
                    pass
        return time.perf_counter_ns() - begin

    def release(self, handle: int) -> None:
        prepared = self.prepared.pop(handle)
        if prepared is None or isinstance(prepared, _Failed):
            return
        try:
            self.candidate.release(prepared)
        except Exception:
            traceback.print_exc()


_HEADER = struct.Struct("<IIQII")  # bytes that follow, operation, ticket, count, passes
_SHAPES = struct.Struct("<II2d" + 2 * "II4d")
_QUESTION = struct.Struct("<II17d")
_ANSWER = struct.Struct("<II5d")
_POINT = struct.Struct("<7d")
_VERTEX = struct.Struct("<3d")
_HANDLE = struct.Struct("<I")
_PREPARE, _QUERY, _TIME, _RELEASE = 1, 2, 3, 4
_STATUSES = {"contact": 0, "none": 1, "unsupported": 2, "failed": 3}


def _answer_frames(engine: _Engine) -> None:
    while len(header := _requests.read(_HEADER.size)) == _HEADER.size:
        size, operation, ticket, count, passes = _HEADER.unpack(header)
        if len(entries := _requests.read(size - 20)) < size - 20:
            return
        if operation == _PREPARE:
            fixed = count * _SHAPES.size
            vertices = _VERTEX.iter_unpack(entries[fixed:])
            answer = b"".join(
                _HANDLE.pack(engine.prepare(fields[0], _shape(fields[4:10], vertices),
                                            _shape(fields[10:], vertices), fields[2], fields[3]))
                for fields in _SHAPES.iter_unpack(entries[:fixed]))
        elif operation == _RELEASE:
            for (handle,) in _HANDLE.iter_unpack(entries):
                engine.release(handle)
            answer = b""
        else:
            questions = [_Question(f[0], Pose(f[2:5], f[5:9]), Pose(f[9:12], f[12:16]),
                                   f[16:19] if f[1] else None)
                         for f in _QUESTION.iter_unpack(entries)]
            if operation == _QUERY:
                answer = b"".join(engine.query(question, _pack) for question in questions)
            else:
                answer = struct.pack("<d", engine.time(passes, questions))
        _answers.write(_HEADER.pack(20 + len(answer), operation, ticket, count, passes) + answer)
        _answers.flush()


def _shape(fields: Sequence[Any], vertices: Iterator[Vector]) -> Any:
    """`vertices` gives those of the convex bodies in turn."""
    kind, count, *size = fields
    return [lambda: Cylinder(size[0], size[1]), lambda: Plane(tuple(size[:3]), size[3]),
            lambda: Sphere(size[0]), lambda: Capsule(size[0], size[1]),
            lambda: Box(tuple(size[:3])),
            lambda: Convex(tuple(islice(vertices, count)))][kind]()


def _pack(answer: _Answer) -> bytes:
    distance, normal, points = answer.contact or (0.0, (0.0, 0.0, 0.0), ())
    _check_count(points)
    packed = [_ANSWER.pack(_STATUSES[answer.status], len(points), distance, *normal,
                           answer.model_distance)]
    packed += [_POINT.pack(*position, *of_point, depth) for position, of_point, depth in points]
    return b"".join(packed).ljust(_ANSWER.size + MAX_POINTS * _POINT.size, b"\0")


def _check_count(points: Sequence[Point]) -> None:
    if len(points) > MAX_POINTS:
        raise ValueError(f"{len(points)} contact points, more than {MAX_POINTS}")


def _answer_lines(engine: _Engine) -> None:
    while (line := _requests.readline()).endswith(b"\n"):
        request = json.loads(line)
        entries = request["entries"]
        answer: dict[str, Any] = {"ticket": request["ticket"]}
        if request["op"] == "prepare":
            answer["supported"] = [
                engine.prepare(entry["handle"], _read_shape(entry["a"]), _read_shape(entry["b"]),
                               float(entry["threshold"]), float(entry["parameter"]))
                for entry in entries]
        elif request["op"] == "release":
            for handle in entries:
                engine.release(handle)
        else:
            questions = [_Question(entry["handle"], _read_pose(entry["pose_a"]),
                                   _read_pose(entry["pose_b"]),
                                   _floats(entry["hint"]) if entry["hint"] is not None else None)
                         for entry in entries]
            if request["op"] == "query":
                answer["answers"] = [engine.query(question, _describe) for question in questions]
            else:
                answer["nanoseconds"] = engine.time(request["passes"], questions)
        _write_line(answer)


def _floats(values: Sequence[Any]) -> Any:
    return tuple(float(value) for value in values)


def _read_pose(pose: dict[str, Any]) -> Pose:
    return Pose(_floats(pose["position"]), _floats(pose["orientation"]))


def _read_shape(shape: dict[str, Any]) -> Any:
    if shape["shape"] == "convex":
        return Convex(tuple(_floats(vertex) for vertex in shape["vertices"]))
    kinds = {"cylinder": Cylinder, "plane": Plane, "sphere": Sphere, "capsule": Capsule, "box": Box}
    kind = kinds[shape["shape"]]
    sizes = (shape[field] for field in kind._fields)
    return kind(*(_floats(size) if isinstance(size, list) else float(size) for size in sizes))


def _describe(answer: _Answer) -> dict[str, Any]:
    described: dict[str, Any] = {"status": answer.status}
    if not math.isnan(answer.model_distance):
        described["model_distance"] = _number(answer.model_distance)
    if answer.contact is not None:
        distance, normal, points = answer.contact
        _check_count(points)
        described |= {"signed_distance": _number(distance), "normal": _numbers(normal),
                      "points": [{"position": _numbers(point.position),
                                  "normal": _numbers(point.normal),
                                  "depth": _number(point.depth)} for point in points]}
    return described


def _numbers(vector: Sequence[float]) -> list[float | str]:
    x, y, z = vector
    return [_number(x), _number(y), _number(z)]


def _number(value: float) -> float | str:
    """JSON has no NaN and no infinity."""
    value = float(value)
    return value if math.isfinite(value) else str(value)


def _write_line(message: dict[str, Any]) -> None:
    _answers.write(json.dumps(message, allow_nan=False).encode() + b"\n")
    _answers.flush()
