"""Reads touchstone-suite-1 or -2 and judges answers: judge.py [--float] SUITE.csv[.gz] ANSWERS.jsonl

Or from Python: for case in read("touchstone-suite-1.csv.gz"): verdict(case, answer), where an answer
is {"status": "contact", "signed_distance": d, "normal": [x, y, z], "points": [{"position": …,
"depth": …}, …]} or {"status": "none"}; to a cast {"status": "touch", "fraction": t, "normal": [x, y, z]},
{"status": "from-start", "normal": [x, y, z]} or {"status": "never"}. README.md has the format.
SPDX-License-Identifier: CC0-1.0"""
import gzip, json, sys
from math import hypot, isfinite, nan
from zlib import error as ZlibError
ROW_COUNT = 5106  # of touchstone-suite-1; other test data have further columns, suite-2's files a last line with it
BODIES = """id group radius_a half_length_a position_a_x position_a_y position_a_z orientation_a_w orientation_a_x
orientation_a_y orientation_a_z shape_b size_b_1 size_b_2 size_b_3 size_b_4 position_b_x position_b_y position_b_z
orientation_b_w orientation_b_x orientation_b_y orientation_b_z """
COLUMNS = (BODIES + """signed_distance signed_distance_error signed_distance_low
signed_distance_high contact min_distance max_distance max_regret min_point_depth ties normal patch_kind""").split()
CAST_COLUMNS = (BODIES + """sweep_x sweep_y sweep_z outcome fraction fraction_low fraction_high start_depth
touch tolerance min_fraction max_fraction ties normal vertices_b
float_touch float_tolerance float_min_fraction float_max_fraction about""").split()
TEXTS = "id group shape_b contact ties normal patch_kind outcome touch float_touch vertices_b about".split()
STATUSES = ('"contact", "none"', '"touch", "from-start", "never"')  # of answers to contacts and to casts
def text_of(file):
    try:
        with (gzip.open if str(file).endswith(".gz") else open)(file, "rb") as stream: return stream.read().decode()
    except (OSError, EOFError, ZlibError, UnicodeDecodeError) as e: raise ValueError(f"{file}: cannot be read: {e}")
def read(file):  # raises ValueError with the line and column of what is wrong
    lines = [(line, row.rstrip("\r")) for line, row in enumerate(text_of(file).rstrip().split("\n"), 1)]
    header, *rows = [row.split(",") for _, row in lines if not row.startswith("#")] or [[]]
    numbers_of_lines = [line for line, row in lines if not row.startswith("#")][1:]
    known = CAST_COLUMNS if header == CAST_COLUMNS else COLUMNS
    if header[:len(known)] != known:
        raise ValueError(f'{file}:1: must be the columns of touchstone-suite-1 or -2, "id,group,…"; a packed file ends in .gz')
    def value(line, name, cell):
        try: return cell if name in TEXTS or name not in known else float(cell)
        except ValueError: raise ValueError(f'{file}:{line}: {name} is "{cell}": must be a number')
    for line, row in zip(numbers_of_lines, rows):
        if len(row) != len(header):
            raise ValueError(f"{file}:{line}: has {len(row)} cells: must have {len(header)}; the file is cut off or damaged")
        yield {name: value(line, name, cell) for name, cell in zip(header, row)}
    if header == COLUMNS and len(rows) != ROW_COUNT:
        raise ValueError(f"{file}: has {len(rows)} configurations: must have {ROW_COUNT}; the file is cut off")
    if lines[0][1].startswith("#") and lines[-1][1] != f"# {len(rows)} configurations":
        raise ValueError(f'{file}:{lines[-1][0]}: must be "# {len(rows)} configurations"; the file is cut off')
def in_float(case):  # one of touchstone-suite-2, with the limits for a routine in single precision
    if "outcome" in case: return {**case, **{name[6:]: x for name, x in case.items() if name.startswith("float_")}}
    true, t = case["signed_distance"], float(case["float_tolerance"])
    return {**case, "contact": "required" if true < -t else "forbidden" if true > t else "optional",
            "min_distance": true - t, "max_distance": true + t, "max_regret": t, "min_point_depth": -t}
def read_answers(file, cases):  # by id; raises ValueError with the line and field of what is wrong
    number = lambda x: x is None or x in ("nan", "inf", "-inf") or type(x) is float
    vector = lambda v: isinstance(v, list) and len(v) == 3 and all(map(number, v))
    point = lambda p: isinstance(p, dict) and vector(p.get("position")) and number(p.get("depth", []))
    kinds = {"signed_distance": (number, "a number"), "normal": (vector, "[x, y, z]"),
             "points": (lambda v: isinstance(v, list) and all(map(point, v)), '[{"position": [x, y, z], "depth": d}, …]')}
    casts = any("outcome" in case for case in cases.values())
    turned = {"normal": kinds["normal"]}
    kinds_of = {"touch": {"fraction": (number, "a number"), **turned}, "from-start": turned} if casts else {"contact": kinds}
    statuses, others = STATUSES[::-1] if casts else STATUSES
    text = text_of(file).lstrip("\ufeff")  # a byte order mark, which some editors write
    answers = []
    for line, row in enumerate(text.split("\n"), 1):
        def wrong(what): return ValueError(f"{file}:{line}: {what}")
        if not row.strip(): continue
        try: answer = json.loads(row, parse_int=float)
        except (ValueError, RecursionError) as e: raise wrong(f"is not JSON ({e}): write an object on each line")
        if not isinstance(answer, dict): raise wrong('is no object: write {"id": …, "status": …}')
        if line == 1 and "id" not in answer and "candidate" in answer: continue
        if "id" not in answer: raise wrong("id is missing: must be that of a configuration")
        if not isinstance(answer["id"], str) or answer["id"] not in cases: raise wrong(f'id is {json.dumps(answer["id"])}: must be that of a configuration of the suite')
        if not isinstance(answer.get("status"), str): raise wrong(f"status is missing: must be {statuses} or why there is no answer")
        if json.dumps(answer["status"]) in others.split(", "): raise wrong(f'status is "{answer["status"]}": must be {statuses} or why there is no answer')
        for name, (is_right, right_form) in kinds_of.get(answer["status"], {}).items():
            if name not in answer: raise wrong(f"{name} is missing: must be {right_form}")
            if not is_right(answer[name]): raise wrong(f"{name} is not usable: must be {right_form}")
        answers.append(answer)
    if not answers: raise ValueError(f"{file}: has no answers: write an object on each line")
    return answers
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
    if shape == "convex":
        return dot(d, n) - half_a - max(dot(map(float, v.split()), b) for v in case["vertices_b"].split(";"))
    half_b = {"sphere": size[0], "capsule": size[0] + size[1] * abs(b[2]), "box": dot(size, map(abs, b)),
              "cylinder": size[1] * abs(b[2]) + size[0] * hypot(b[0], b[1])}[shape]
    return dot(d, n) - half_a - half_b

def number(x): return nan if x is None else float(x)
def cast_verdict(case, answer):
    if answer["status"] == "never": return "missed" if case["touch"] == "required" else "agree"
    if answer["status"] not in ("touch", "from-start"): return answer["status"]
    t, n = number(answer["fraction"]) if answer["status"] == "touch" else 0, [number(x) for x in answer["normal"]]
    if not all(map(isfinite, [t, *n])): return "not-finite"
    if not case["min_fraction"] <= t <= case["max_fraction"]:
        return "made-up" if case["outcome"] == "never" else "early" if t < case["min_fraction"] else "late"
    if not any(n): return "agree"  # a routine that has no normals
    if abs(hypot(*n) - 1) > 1e-6: return "wrong-normal"
    there = {**case, **{f"position_a_{e}": case[f"position_a_{e}"] + t * case[f"sweep_{e}"] for e in "xyz"}}
    best = [list(map(float, one.split())) for one in case["normal"].split(";") if one != "none"]
    distance = max([-max(case["start_depth"], case["tolerance"]), *(gap(there, one) for one in best)])
    return "wrong-normal" if distance - gap(there, [x / hypot(*n) for x in n]) > case["tolerance"] else "agree"
def verdict(case, answer):
    if "outcome" in case: return cast_verdict(case, answer)
    required = case["contact"] == "required"
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
    if case.get("touch") == "forbidden": return "touch forbidden"
    if "outcome" in case: return "touch {touch}, fraction {min_fraction} to {max_fraction}, normal {normal}".format(**case)
    return "contact {contact}, signed distance {min_distance} to {max_distance}, normal {normal}".format(**case)

if __name__ == "__main__":
    single, files = "--float" in sys.argv[1:], [word for word in sys.argv[1:] if word != "--float"]
    if len(files) != 2: sys.exit(print("usage: judge.py [--float] SUITE.csv[.gz] ANSWERS.jsonl", file=sys.stderr) or 2)
    try:
        cases = {case["id"]: case for case in read(files[0])}
        if single and not all("float_tolerance" in case for case in cases.values()):
            raise ValueError(f"{files[0]}: has no float_tolerance: --float needs a file of touchstone-suite-2")
        if single: cases = {name: in_float(case) for name, case in cases.items()}
        answers, wrong = read_answers(files[1], cases), False
    except ValueError as e: sys.exit(print(e, file=sys.stderr) or 2)
    for answer in answers:
        case, judged = cases[answer["id"]], verdict(cases[answer["id"]], answer)
        print(case["id"], judged, "" if judged == "agree" else "right: " + right(case))
        wrong |= judged != "agree"
    sys.exit(wrong)
