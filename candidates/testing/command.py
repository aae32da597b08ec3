"""A candidate that is a command, for tests: command.py FORMAT [DEED].

Its answers are made of the question, so that a test sees that all numbers arrive: the signed
distance is minus the sum of the poses' numbers, the sizes and the threshold. A question whose body B
lies at x = 666 is answered with the DEED.
"""
import json
import os
import struct
import subprocess
import sys
import time

FORMAT = sys.argv[1]
DEED = sys.argv[2] if len(sys.argv) > 2 else "none"
INPUT, OUTPUT = os.fdopen(0, "rb"), os.fdopen(os.dup(1), "wb")
MARK = 666.0
prepared = {}
asked = 0


def put(data):
    OUTPUT.write(data)
    OUTPUT.flush()


def take(size):
    data = INPUT.read(size)
    if len(data) < size:
        sys.exit(0)
    return data


def misbehave(ticket, count):
    """Does the deed instead of answering a query."""
    if DEED == "exit":
        print("a word to explain it", file=sys.stderr, flush=True)
        os._exit(3)
    if DEED == "abort":
        os.abort()
    if DEED == "spin":
        while True:
            pass
    if DEED == "sleep":
        time.sleep(1000)
    if DEED == "close":
        os.close(1)
        OUTPUT.close()
        time.sleep(1000)
    if DEED == "garbage":
        put(b"\x89PNG\r\n\x1a\n" * 200 + b"\n")
        time.sleep(1000)
    if DEED == "partial":
        put(b'{"ticket": ' if FORMAT == "lines" else struct.pack("<IIQ", 20 + 944 * count, 2, ticket))
        os._exit(0)
    if DEED == "stall":
        put(b'{"ticket": ' if FORMAT == "lines" else struct.pack("<IIQ", 20 + 944 * count, 2, ticket))
        time.sleep(1000)
    if DEED == "memory":
        hoard = b"x" * (1 << 30)
        time.sleep(1000)
        print(len(hoard), file=sys.stderr)
    if DEED == "leave":
        subprocess.Popen(["sleep", "1234"])
        os._exit(1)


def tamper(data, count):
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
        if DEED == "more":
            return data + b"{}\n"
        return json.dumps(answer).encode() + b"\n"
    data = bytearray(data)
    if DEED == "ticket":
        data[8] ^= 1
    if DEED == "count":
        data[16:20] = struct.pack("<I", count + 1)
    if DEED == "status":
        data[24:28] = struct.pack("<I", 4)
    if DEED == "points":
        data[28:32] = struct.pack("<I", 17)
    if DEED == "type":
        data[4] ^= 1
    if DEED == "more":
        data += b"\0"
    return bytes(data)


def numbers_in(value):
    return [x for each in value for x in numbers_in(each)] if isinstance(value, list) else [value]


def answer_of(handle, pose_a, pose_b):
    total = -sum(pose_a) - sum(pose_b) - sum(prepared[handle])
    point = list(pose_a[:3]), [0.0, 0.0, 1.0], -total
    return total, [0.0, 0.0, 1.0], point


def spend(passes, entries):
    start = time.monotonic_ns()
    for _ in range(passes):
        for handle, pose_a, pose_b, _ in entries:
            answer_of(handle, pose_a, pose_b)
    return float(time.monotonic_ns() - start)


def marked(entries):
    return DEED != "none" and any(pose_b[0] == MARK for _, _, pose_b, _ in entries)


def serve_lines():
    for line in INPUT:
        request = json.loads(line)
        ticket, op = request["ticket"], request["op"]
        if op == "prepare":
            for e in request["entries"]:
                sizes = [x for shape in (e["a"], e["b"]) for value in shape.values()
                         if not isinstance(value, str) for x in numbers_in(value)]
                prepared[e["handle"]] = sizes + [e["threshold"], e["parameter"]]
            reply = {"supported": [True] * len(request["entries"])}
        elif op == "release":
            for handle in request["entries"]:
                del prepared[handle]
            reply = {}
        else:
            entries = [(e["handle"], e["pose_a"]["position"] + e["pose_a"]["orientation"],
                        e["pose_b"]["position"] + e["pose_b"]["orientation"], e["hint"])
                       for e in request["entries"]]
            if op == "time":
                reply = {"nanoseconds": spend(request["passes"], entries)}
            else:
                if marked(entries):
                    misbehave(ticket, len(entries))
                answers = []
                for handle, pose_a, pose_b, _ in entries:
                    distance, normal, (position, up, depth) = answer_of(handle, pose_a, pose_b)
                    answers.append({"status": "contact", "signed_distance": distance, "normal": normal,
                                    "points": [{"position": position, "normal": up, "depth": depth}]})
                reply = {"answers": answers}
                data = json.dumps({"ticket": ticket} | reply).encode() + b"\n"
                put(tamper(data, len(entries)) if marked(entries) else data)
                continue
        put(json.dumps({"ticket": ticket} | reply).encode() + b"\n")


def serve_frames():
    while True:
        length, op, ticket, count, passes = struct.unpack("<IIQII", take(24))
        data = take(length - 20)
        if op == 1:
            after = 104 * count
            for i in range(count):
                handle, _, threshold, parameter = struct.unpack_from("<IIdd", data, 104 * i)
                sizes = struct.unpack_from("<4d", data, 104 * i + 32) + struct.unpack_from(
                    "<4d", data, 104 * i + 72)
                (vertices,) = struct.unpack_from("<I", data, 104 * i + 68)
                sizes += struct.unpack_from(f"<{3 * vertices}d", data, after)
                after += 24 * vertices
                prepared[handle] = list(sizes) + [threshold, parameter]
            reply = struct.pack("<" + "I" * count, *([1] * count))
        elif op == 4:
            for handle in struct.unpack(f"<{count}I", data):
                del prepared[handle]
            reply = b""
        else:
            entries = []
            for i in range(count):
                handle, hint = struct.unpack_from("<II", data, 144 * i)
                numbers = struct.unpack_from("<17d", data, 144 * i + 8)
                entries.append((handle, numbers[:7], numbers[7:14], numbers[14:] if hint else None))
            if op == 3:
                reply = struct.pack("<d", spend(passes, entries))
            else:
                if marked(entries):
                    misbehave(ticket, count)
                reply = b""
                for handle, pose_a, pose_b, _ in entries:
                    distance, normal, (position, up, depth) = answer_of(handle, pose_a, pose_b)
                    reply += struct.pack("<II5d7d", 0, 1, distance, *normal, float("nan"), *position, *up,
                                         depth).ljust(944, b"\0")
        frame = struct.pack("<IIQII", 20 + len(reply), op, ticket, count, 0) + reply
        put(tamper(frame, count) if op == 2 and marked(entries) else frame)


def main():
    if DEED == "silent":
        time.sleep(1000)
    if DEED == "ends":
        print("no such engine", file=sys.stderr, flush=True)
        sys.exit(4)
    line = INPUT.readline()
    assert json.loads(line)["touchstone"] == 1
    hello = {"touchstone": 1, "name": "told", "version": "0.1", "settings": "for tests",
             "precision": "double", "runs": "script", "format": FORMAT,
             "pairs": ["cylinder-sphere", "cylinder-box", "cylinder-convex"],
             "parameter": {"meaning": "number", "min": 0, "max": 9, "usual": 2}}
    if DEED.startswith("hello "):
        hello |= json.loads(DEED[len("hello "):])
    if DEED == "chatter":
        put(b"Welcome to my engine!\n")
    put(json.dumps(hello).encode() + b"\n")
    if FORMAT == "lines":
        serve_lines()
    else:
        serve_frames()


main()
