#!/usr/bin/python3
"""What the program writes is what docs/*.schema.json say: schema_test.py SOURCE-FOLDER PROGRAM

Each kind of output is validated as it is; then with faults planted, one at a time, in a short version of it (lists cut
to their first entries of each form): every member is left out, is of another type, and has one beside it that no schema
knows. A schema that does not see a fault is too weak; a fault within a member of the whole is shown to what the schema
says of that member. The Python of the pages that describe the output reads it.
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

try:
    warnings.simplefilter("ignore", DeprecationWarning)  # RefResolver, of which Debian's jsonschema has no successor
    import jsonschema
except ImportError:
    sys.exit("python3-jsonschema is missing (packages-test.txt)")

program = pathlib.Path(sys.argv.pop(2)).resolve()
source = pathlib.Path(sys.argv.pop(1)).resolve()
docs = source / "docs"

# Members that may be absent.
OPTIONAL = {"reason", "audit", "given", "stability", "experiments", "engines", "amplification", "maps", "sequences",
            "digest", "id", "cast", "casts", "there"}
OPTIONAL_OF = {("score", "model_error"), ("score", "solver_error")}
# Objects whose members are names or numbers.
MAPS = {"answers", "outcomes", "wrong_by_motion", "points", "details", "letters"}


def validator(name):
    schema = json.loads((docs / f"{name}.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(
        schema, resolver=jsonschema.RefResolver(docs.as_uri() + "/", schema))


def form(value):
    """The members and types of a value, whatever its numbers: entries of one form are alike to a schema."""
    if isinstance(value, dict):
        return tuple(sorted((k, form(v)) for k, v in value.items()))
    if isinstance(value, list):
        return ("list", form(value[0]) if value else None)
    if isinstance(value, str) and len(value) < 12:
        return value  # a kind or a status
    return type(value).__name__


def shortened(value):
    """The same with only the first entry of each form in lists of objects, and of at most four forms."""
    if isinstance(value, dict):
        return {k: shortened(v) for k, v in value.items()}
    if not isinstance(value, list) or not all(isinstance(entry, dict) for entry in value):
        return value
    first = {}
    for entry in map(shortened, value):
        first.setdefault(form(entry), entry)
    return list(first.values())[:4]


def places(value, path=(), seen=None):
    """One path to each member of a kind: numbers of entries and names in maps count as one."""
    seen = set() if seen is None else seen
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in entries:
        here = path + (key,)
        kind = tuple("*" if isinstance(k, int) or i and here[i - 1] in MAPS else k for i, k in enumerate(here))
        if (kind, type(child)) in seen:
            # Objects of one place may differ in their members.
            if isinstance(child, (dict, list)):
                yield from places(child, here, seen)
            continue
        seen.add((kind, type(child)))
        yield here
        yield from places(child, here, seen)


def at(value, path):
    for key in path:
        value = value[key]
    return value


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_program(self, *arguments, codes=(0,), **more):
        done = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=self.path, **more)
        self.assertIn(done.returncode, codes, done.stderr)
        return done.stdout

    def check(self, name, value):
        schema = validator(name)
        errors = [f"{list(e.absolute_path)}: {e.message[:200]}" for e in schema.iter_errors(value)]
        self.assertEqual(errors[:5], [])
        short = shortened(value)
        self.assertTrue(schema.is_valid(short))
        missed, planted = [], 0
        for place in places(short):
            holder, key = place[:-1], place[-1]
            faults = []
            if isinstance(key, str) and not (holder and holder[-1] in MAPS) and not (
                    key in OPTIONAL or place[-2:] in OPTIONAL_OF):
                faults.append(lambda parent: parent.pop(key))
            faults.append(lambda parent: parent.__setitem__(key, {"planted": []}))
            if isinstance(at(short, place), dict):
                faults.append(lambda parent: parent[key].__setitem__("planted", {"planted": []}))
            for fault in faults:
                planted += 1
                part = schema.schema.get("properties", {}).get(place[0]) if holder else None
                faulty = copy.deepcopy(short if part is None else {place[0]: short[place[0]]})
                fault(at(faulty, holder))
                if schema.is_valid(faulty) if part is None else schema.evolve(schema=part).is_valid(faulty[place[0]]):
                    missed.append(place)
        self.assertFalse(schema.is_valid({**short, "planted": 1}))
        self.assertGreater(planted, 50)
        self.assertEqual(missed, [], name)

    def test_reports_stability_and_experiments(self):
        self.run_program("report", "--count", "1", "--pair", "cylinder-plane", "--candidates", "reference,capsule,bullet",
                         "--only", "scores,timing,casts,stability,experiments,engines", "--out", "whole")
        report = json.loads((self.path / "whole/report.json").read_text())
        text = self.run_example("report.md", {"out/report.json": report})
        self.assertRegex(text, r"standing agrees on \d+%, worst depth error \d")
        for member in ("casts", "stability", "experiments", "engines", "drake_protocol", "factors", "contrasts",
                       "trends", "recorded", "worst"):
            self.assertTrue(report[member], member)
        self.check("report", report)

    def test_a_report_of_one_class_with_a_command(self):
        # A command's times have more members that are numbers.
        self.run_program("--candidate-command", f"python3 {source}/candidates/clients/example.py",
                         "report", "--count", "2", "--pair", "cylinder-plane", "--class", "lying", "--out", "small", "--candidates",
                         "reference,fcl-distance,example-gjk-epa")
        report = json.loads((self.path / "small/report.json").read_text())
        self.assertNotIn("experiments", report)
        self.assertTrue(any(r["nanoseconds"] and r["nanoseconds"]["floor"] for r in report["results"]))
        self.check("report", report)

    def test_a_report_of_answers_from_elsewhere(self):
        (self.path / "given.jsonl").write_text('{"id": "cylinder-plane/lying/1/3", "status": "none"}\n')
        self.run_program("score", "given.jsonl", "--name", "mine", "--out", "given")
        report = json.loads((self.path / "given/report.json").read_text())
        self.assertIn("digest", report["classes"][0])
        self.check("report", report)

    def test_campaigns(self):
        self.run_program("campaign", "--pair", "cylinder-plane", "--group", "everyday,degenerate", "--candidates",
                         "bullet,prism:8", "--count", "40", "--out", "campaign")
        campaign = json.loads((self.path / "campaign/campaign.json").read_text())
        for member in ("factors", "contrasts", "worst"):
            self.assertTrue(campaign[member], member)
        self.check("campaign", campaign)

    def test_lines_of_solve(self):
        cylinder = {"shape": "cylinder", "radius": 0.5, "half_length": 1}
        def pose(*position):
            return {"position": position}
        lines = [
            {"id": "box", "a": cylinder, "pose_a": pose(0, 0, 1.9), "b": {"shape": "box", "half_extents": [1, 1, 1]}},
            {"a": cylinder, "b": {"shape": "plane", "normal": [0, 0, 1], "displacement": 0}},
            {"id": 3, "a": {"shape": "sphere", "radius": 1}, "b": cylinder},  # a circle of normals
            {"id": None, "a": cylinder, "pose_a": pose(0, 0, 9),
             "b": {"shape": "capsule", "radius": 1, "half_length": 2}},
            {"id": "cast", "a": cylinder, "pose_a": pose(0, 0, 9), "b": {"shape": "sphere", "radius": 1},
             "sweep": [0, 0, -9]},
            {"id": "wrong", "a": {"shape": "cylinder", "radius": -1, "half_length": 1}, "b": cylinder},
            {"a": cylinder},
        ]
        for options in ([], ["--audit"]):
            answers = self.run_program("solve", *options, codes=(2,), input="\n".join(map(json.dumps, lines)) + "\n")
            answers = [json.loads(line) for line in answers.splitlines()]
            self.assertEqual(["error" in a for a in answers], [False] * 5 + [True] * 2)
            self.assertEqual([a.get("cast", {}).get("truth", {}).get("status") for a in answers],
                             [None] * 4 + ["touch"] + [None] * 2)
            self.assertEqual(answers[2]["truth"]["ties"], "continuum")
            self.assertIn("box reference agree", self.run_example("your-poses.md", {"answers.jsonl": [answers[0]]}))
            for answer in answers:
                self.check_line(answer, bool(options))

    def check_line(self, answer, audited):
        if "error" in answer:
            self.assertTrue(validator("solve").is_valid(answer))
            for member in ("line", "field", "error"):
                self.assertFalse(validator("solve").is_valid({k: v for k, v in answer.items() if k != member}))
            self.assertFalse(validator("solve").is_valid({**answer, "answers": {}}))
            return
        self.assertEqual("audit" in answer, audited)
        # Two of the candidates are enough for planted faults.
        self.assertTrue(validator("solve").is_valid(answer))
        self.check("solve", {**answer, "answers": {k: answer["answers"][k] for k in ("reference", "ode")}})

    def run_example(self, page, files):
        """Runs the Python of a page of docs in a folder with these files; what it prints."""
        (block,) = [b for b in re.findall(r"```python\n(.*?)```", (docs / page).read_text(), re.DOTALL) if "json" in b]
        with tempfile.TemporaryDirectory() as folder:
            for name, values in files.items():
                file = pathlib.Path(folder) / name
                file.parent.mkdir(exist_ok=True)
                file.write_text("\n".join(map(json.dumps, values if isinstance(values, list) else [values])))
            return subprocess.run([sys.executable, "-c", block], cwd=folder, check=True,
                                  capture_output=True, text=True).stdout

    def test_comparisons(self):
        self.run_program("report", "--count", "3", "--pair", "cylinder-plane", "--class",
                         "standing,lying,general-shallow", "--candidates", "reference,bullet,ode", "--out", "before")
        report = json.loads((self.path / "before/report.json").read_text())
        changed = report["classes"][0]  # and the groups that it counts in
        for row in report["results"] + report["summary"]:
            if row["candidate"] == "ode" and row["class"] in (changed["class"], changed["group"]):
                row["outcomes"]["agree"] -= 1
                row["outcomes"]["missed"] = 1
        (self.path / "after.json").write_text(json.dumps(report))
        for options in ([], ["--fail-on", "time"]):
            text = self.run_program("compare", "before/report.json", "after.json", "--json",
                                    "--max-error-factor", "1.01", *options, codes=(0, 1))
            comparison = json.loads(text)
            self.assertTrue(comparison["changes"])
            self.check("comparison", comparison)

    def test_choices(self):
        scenes = source / "cli/tests/scenes"
        for options in (["can.json", "--candidates", "capsule", "--disturbances", "1"],
                        ["can.json", "--engine", "bullet", "--disturbances", "1"],
                        ["cart.urdf", "--candidates", "capsule", "--count", "5"]):
            text = self.run_program("choose", scenes / options[0], *options[1:], "--json", "--out", "choice", codes=(0, 1))
            self.check("choose", json.loads(text))

    def test_stability_and_experiments_alone(self):
        self.run_program("stability", "--count", "1", "--pair", "cylinder-plane", "--candidates", "reference,bullet", "--part",
                         "amplification,sequences", "--out", "stability")
        self.check("stability", json.loads((self.path / "stability/stability.json").read_text()))
        text = self.run_program("simulate", "standing", "--candidates", "reference,fcl-distance",
                                "--step", "0.016", "--json")
        self.check("experiments", json.loads(text))
        text = self.run_program("simulate", "small-log", "--engine", "bullet,ode", "--json")
        self.check("engines", json.loads(text))


if __name__ == "__main__":
    unittest.main()
