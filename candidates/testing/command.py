"""A candidate that is a command, for tests: command.py FORMAT [DEED].

Its answers are made of the question, so that a test sees that all numbers arrive: the signed
distance is minus the sum of the poses' numbers, the sizes and the threshold. A question whose body B
lies at x = 666 is answered with the DEED; but for that it is a client as any other.
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import time

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "clients"))
import touchstone_candidate as client  # noqa: E402

FORMAT = sys.argv[1]
DEED = sys.argv[2] if len(sys.argv) > 2 else "none"
MARK = 666.0


def put(data):
    output.true.write(data)
    output.true.flush()


def misbehave():
    """Does the deed instead of answering a query."""
    if DEED == "exit":
        print("a word to explain it", file=sys.stderr, flush=True)
        os._exit(3)
    if DEED == "abort":
        os.abort()
    if DEED == "spin":
        while True:
            pass
    if DEED == "leave":
        subprocess.Popen(["sleep", "1234"], stdout=output.true)
        os._exit(1)
    if DEED == "close":
        output.true.close()
    if DEED == "garbage":
        put(b"\x89PNG\r\n\x1a\n" * 200 + b"\n")
    if DEED in ("partial", "stall"):
        put(b'{"ticket": ' if FORMAT == "lines" else struct.pack("<IIQ", 20 + 944, 2, 1))
    if DEED == "partial":
        os._exit(0)
    hoard = b"x" * (1 << 30) if DEED == "memory" else b""
    if DEED in ("sleep", "close", "garbage", "stall", "memory"):
        time.sleep(1000)
        print(len(hoard), file=sys.stderr)


def tampered(data):
    """A true answer in which the deed changes something."""
    if FORMAT == "lines":
        answer = json.loads(data)
        if DEED == "ticket":
            answer["ticket"] += 1
        if DEED == "count":
            answer["answers"].append(answer["answers"][0])
        if DEED == "status":
            answer["answers"][0]["status"] = "crashed"
        if DEED == "points":
            answer["answers"][0]["points"] *= 17
        if DEED == "type":
            answer["answers"][0]["normal"] = "up"
        return json.dumps(answer).encode() + (b"\n{}\n" if DEED == "more" else b"\n")
    data = bytearray(data)
    if DEED == "ticket":
        data[8] ^= 1
    if DEED == "count":
        data[16:20] = struct.pack("<I", struct.unpack_from("<I", data, 16)[0] + 1)
    if DEED == "status":
        data[24:28] = struct.pack("<I", 4)
    if DEED == "points":
        data[28:32] = struct.pack("<I", 17)
    if DEED == "type":
        data[4] ^= 1
    return bytes(data) + (b"\0" if DEED == "more" else b"")


class Output:
    """Where the client writes its answers: what has the mark is tampered with."""

    def __init__(self, true):
        self.true, self.is_marked = true, False

    def write(self, data):
        self.true.write(tampered(data) if self.is_marked else data)
        self.is_marked = False

    def flush(self):
        self.true.flush()


def total(value):
    return sum(map(total, value)) if isinstance(value, tuple) else value


class Told(client.Candidate):
    name, version, settings = "told", "0.1", "for tests"
    pairs = ("cylinder-sphere", "cylinder-box", "cylinder-convex")
    parameter = {"meaning": "number", "min": 0, "max": 9, "usual": 2}
    format = FORMAT

    def __init__(self):
        if DEED == "silent":
            time.sleep(1000)
        if DEED == "ends":
            print("no such engine", file=sys.stderr, flush=True)
            sys.exit(4)
        if DEED == "chatter":
            put(b"Welcome to my engine!\n")
        if DEED.startswith("hello "):
            vars(self).update(json.loads(DEED[len("hello "):]))

    def prepare(self, a, b, threshold, parameter):
        return total((a, b, threshold, parameter))

    def query(self, prepared, pose_a, pose_b, hint):
        if DEED != "none" and pose_b.position[0] == MARK:
            misbehave()
            output.is_marked = True
        depth = prepared + total((pose_a, pose_b))
        up = (0.0, 0.0, 1.0)
        return client.Contact(-depth, up, (client.Point(pose_a.position, up, depth),))


output = client._answers = Output(client._answers)
client.run(Told)
