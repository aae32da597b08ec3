"""Reads touchstone-suite-1 and judges answers: judge.py SUITE.csv[.gz] ANSWERS.jsonl

Or from Python: for case in read("touchstone-suite-1.csv.gz"): verdict(case, answer), where an answer
is {"status": "contact", "signed_distance": d, "normal": [x, y, z], "points": [{"position": …,
"depth": …}, …]} or {"status": "none"}. README.md has the format. CC0: do with it what you like."""
import csv, gzip, json, sys
from math import hypot, isfinite, nan
def read(file):
    texts = ("id", "group", "shape_b", "contact", "ties", "normal", "patch_kind")
    with (gzip.open if str(file).endswith(".gz") else open)(file, "rt", newline="") as rows:
        for row in csv.DictReader(rows):
            yield {name: cell if name in texts else float(cell) for name, cell in row.items()}
def numbers(case, name, letters="xyz"): return [case[f"{name}_{letter}"] for letter in letters]
def in_frame(q, v):  # q may have any length
    (w, x, y, z), s = q, 2 / sum(e * e for e in q)
    return (v[0] + s * (v[1] * (x * y + w * z) + v[2] * (x * z - w * y) - v[0] * (y * y + z * z)),
            v[1] + s * (v[2] * (y * z + w * x) + v[0] * (x * y - w * z) - v[1] * (x * x + z * z)),
            v[2] + s * (v[0] * (x * z + w * y) + v[1] * (y * z - w * x) - v[2] * (x * x + y * y)))
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def gap(case, n):  # g(n): clearance along the unit vector n
    r, h, size, shape = case["radius_a"], case["half_length_a"], numbers(case, "size_b", "1234"), case["shape_b"]
    a, q_b = in_frame(numbers(case, "orientation_a", "wxyz"), n), numbers(case, "orientation_b", "wxyz")
    b, d = in_frame(q_b, n), [p - q for p, q in zip(numbers(case, "position_a"), numbers(case, "position_b"))]
    half_a = h * abs(a[2]) + r * hypot(a[0], a[1])
    if shape == "plane":  # against the column of the half-space beneath the cylinder's circumsphere
        length, rho = hypot(*size[:3]), hypot(r, h)
        up = [e / length for e in size[:3]]
        cosine, height = dot(b, up), dot(in_frame(q_b, d), up) - size[3] / length
        sine = hypot(*(x - cosine * y for x, y in zip(b, up)))
        return height * cosine - half_a - rho * sine - 2 * rho * max(0, -cosine)
    half_b = {"sphere": size[0], "capsule": size[0] + size[1] * abs(b[2]), "box": dot(size, map(abs, b)),
              "cylinder": size[1] * abs(b[2]) + size[0] * hypot(b[0], b[1])}[shape]
    return dot(d, n) - half_a - half_b

def verdict(case, answer):
    number, required = lambda x: nan if x is None else float(x), case["contact"] == "required"
    if answer["status"] == "none": return "missed" if required else "agree"
    if answer["status"] != "contact": return answer["status"]
    n, distance, points = [number(x) for x in answer["normal"]], number(answer["signed_distance"]), answer["points"]
    depths, places = [number(p["depth"]) for p in points], [number(x) for p in points for x in p["position"]]
    if not all(map(isfinite, [*n, distance, *depths, *places])): return "not-finite"
    if case["contact"] == "forbidden": return "phantom"
    if distance > case["max_distance"]: return "shallow"
    if distance < case["min_distance"]: return "overdeep"
    if abs(hypot(*n) - 1) > 1e-6: return "wrong-normal"
    if case["signed_distance"] - gap(case, [x / hypot(*n) for x in n]) > case["max_regret"]: return "wrong-normal"
    if not depths: return "shallow-points" if required else "agree"
    if max(depths) < -case["max_distance"]: return "shallow-points"
    if max(depths) > -case["min_distance"]: return "overdeep-points"
    return "phantom-points" if min(depths) < case["min_point_depth"] else "agree"
def right(case):
    return "contact {contact}, signed distance {min_distance} to {max_distance}, normal {normal}".format(**case)

if __name__ == "__main__":
    cases, wrong = {case["id"]: case for case in read(sys.argv[1])}, False
    for answer in (line for line in map(json.loads, open(sys.argv[2])) if "id" in line):
        case, judged = cases[answer["id"]], verdict(cases[answer["id"]], answer)
        print(case["id"], judged, "" if judged == "agree" else "right: " + right(case))
        wrong |= judged != "agree"
    sys.exit(wrong)
