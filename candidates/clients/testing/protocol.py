"""Touchstone's side of the protocol of candidates/host/protocol.md, for tests of its clients."""

from __future__ import annotations

import json
import math
import struct
import subprocess
import tempfile
from typing import Any, NamedTuple

SHAPES = ("cylinder", "plane", "sphere", "capsule", "box", "convex")
STATUSES = ("contact", "none", "unsupported", "failed")
PREPARE, QUERY, TIME, RELEASE, CAST = 1, 2, 3, 4, 5
CAST_STATUSES = ("touch", "never", "unsupported", "failed")
OPERATIONS = {PREPARE: "prepare", QUERY: "query", TIME: "time", RELEASE: "release"}


class Answer(NamedTuple):
    status: str
    signed_distance: float = 0.0
    normal: tuple[float, ...] = ()
    points: tuple[tuple[float, ...], ...] = ()
    """Position, normal and depth of each."""
    model_distance: float = math.nan

    def bits(self) -> bytes:
        """All that is to be compared, NaN included."""
        numbers = [self.signed_distance, *self.normal, *(x for p in self.points for x in p)]
        # A NaN may have any sign and payload.
        numbers = [math.nan if math.isnan(x) else x for x in [*numbers, self.model_distance]]
        return self.status.encode() + struct.pack(f"<{len(numbers)}d", *numbers)


class Child:
    """A candidate's process, asked by shapes and poses in the form of a configuration."""

    def __init__(self, command: list[str], hello: bytes = b'{"touchstone": 1}\n') -> None:
        self.log = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.log)
        self.ticket = 2**52
        try:
            self.send(hello)
            self.hello = json.loads(self.line())
        except BaseException:
            self.__exit__()
            raise

    def __enter__(self) -> Child:
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
        self.log.close()

    def end(self) -> int:
        """The exit code after the end of input."""
        self.process.stdin.close()
        rest = self.process.stdout.read()
        assert rest == b"", rest
        return self.process.wait()

    def messages(self) -> str:
        self.log.seek(0)
        return self.log.read()

    def prepare(self, entries: list[tuple[int, dict, dict, float, float]]) -> list[bool]:
        """Entries: handle, shapes, threshold, parameter."""
        if self.in_lines:
            return self.ask_line(PREPARE, [
                {"handle": handle, "threshold": threshold, "parameter": parameter, "a": a, "b": b}
                for handle, a, b, threshold, parameter in entries])["supported"]
        packed = [struct.pack("<II2d", handle, 0, threshold, parameter)
                  + pack_shape(a) + pack_shape(b) for handle, a, b, threshold, parameter in entries]
        vertices = b"".join(struct.pack("<3d", *vertex) for _, _, b, _, _ in entries
                            for vertex in b.get("vertices", ()))
        if self.hello.get("roundings"):
            vertices += b"".join(struct.pack("<2d", a.get("rounding", 0), b.get("rounding", 0))
                                 for _, a, b, _, _ in entries)
        flags = self.ask_frame(PREPARE, packed, rest=vertices)[:4 * len(entries)]
        return [flag == 1 for (flag,) in struct.iter_unpack("<I", flags)]

    def query(self, questions: list[tuple[int, dict, dict, tuple | None]]) -> list[Answer]:
        """Questions: handle, poses, hint."""
        if self.in_lines:
            return [read_answer(a) for a in self.ask_line(QUERY, describe(questions))["answers"]]
        answers = self.ask_frame(QUERY, pack(questions))
        assert len(answers) == 944 * len(questions)
        return [unpack_answer(answers[at:at + 944]) for at in range(0, len(answers), 944)]

    def cast(self, questions: list[tuple[int, dict, dict, tuple]]) -> list[tuple[str, float, tuple]]:
        """Questions: handle, poses, sweep. Status, fraction and normal of each, in frames alone."""
        answers = self.ask_frame(CAST, pack(questions))
        return [(CAST_STATUSES[status], fraction, tuple(normal))
                for status, _, fraction, *normal in struct.iter_unpack("<II4d", answers)]

    def time(self, passes: int, questions: list[tuple[int, dict, dict, tuple | None]]) -> float:
        if self.in_lines:
            return self.ask_line(TIME, describe(questions), passes)["nanoseconds"]
        (nanoseconds,) = struct.unpack("<d", self.ask_frame(TIME, pack(questions), passes))
        return nanoseconds

    def release(self, handles: list[int]) -> None:
        if self.in_lines:
            assert len(self.ask_line(RELEASE, handles)) == 1
        else:
            assert self.ask_frame(RELEASE, [struct.pack("<I", h) for h in handles]) == b""

    @property
    def in_lines(self) -> bool:
        return self.hello["format"] == "lines"

    def ask_line(self, operation: int, entries: list[Any], passes: int | None = None) -> dict:
        self.ticket += 1
        request = {"op": OPERATIONS[operation], "ticket": self.ticket, "entries": entries}
        if passes is not None:
            request["passes"] = passes
        self.send(json.dumps(request).encode() + b"\n")
        answer = json.loads(self.line())
        assert answer["ticket"] == self.ticket
        return answer

    def ask_frame(self, operation: int, entries: list[bytes], passes: int = 0,
                  rest: bytes = b"") -> bytes:
        self.ticket += 2**40
        body = b"".join(entries) + rest
        header = (20 + len(body), operation, self.ticket, len(entries), passes)
        self.send(struct.pack("<IIQII", *header) + body)
        size, *rest = struct.unpack("<IIQII", self.receive(24))
        assert rest == [operation, self.ticket, len(entries), passes], rest
        return self.receive(size - 20)

    def send(self, data: bytes) -> None:
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def receive(self, size: int) -> bytes:
        data = self.process.stdout.read(size)
        if len(data) < size:
            raise EOFError(self.messages())
        return data

    def line(self) -> bytes:
        line = self.process.stdout.readline()
        if not line.endswith(b"\n"):
            raise EOFError(self.messages())
        return line


def pack_shape(shape: dict) -> bytes:
    size = [*shape.get("normal", ()), *shape.get("half_extents", ()),
            *(shape[key] for key in ("radius", "half_length", "displacement") if key in shape)]
    return struct.pack("<II4d", SHAPES.index(shape["shape"]), len(shape.get("vertices", ())), *size,
                       *[0.0] * (4 - len(size)))


def pack(questions: list[tuple[int, dict, dict, tuple | None]]) -> list[bytes]:
    return [struct.pack("<II17d", handle, hint is not None, *a["position"], *a["orientation"],
                        *b["position"], *b["orientation"], *(hint or (0, 0, 0)))
            for handle, a, b, hint in questions]


def describe(questions: list[tuple[int, dict, dict, tuple | None]]) -> list[dict]:
    return [{"handle": handle, "pose_a": a, "pose_b": b, "hint": hint}
            for handle, a, b, hint in questions]


def unpack_answer(data: bytes) -> Answer:
    status, count, *numbers = struct.unpack("<II5d112d", data)
    if status != 0:
        return Answer(STATUSES[status], model_distance=numbers[4])
    points = tuple(tuple(numbers[5 + 7 * i:12 + 7 * i]) for i in range(count))
    return Answer("contact", numbers[0], tuple(numbers[1:4]), points, numbers[4])


def read_answer(answer: dict) -> Answer:
    def floats(values: list) -> tuple[float, ...]:
        return tuple(map(float, values))

    model_distance = float(answer.get("model_distance", math.nan))
    if answer["status"] != "contact":
        return Answer(answer["status"], model_distance=model_distance)
    points = tuple((*floats(p["position"]), *floats(p["normal"]), float(p["depth"]))
                   for p in answer["points"])
    return Answer("contact", float(answer["signed_distance"]), floats(answer["normal"]), points,
                  model_distance)
