#!/usr/bin/env python3
"""seed_check.py against a made-up `choose`, and the real one: seed_check_test.py PROGRAM"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = sys.argv.pop()

EXACT = {"models": ["reference"], "points_per_step": 4, "microseconds_per_step": 1, "error": 0.5,
         "trials": 17, "held": 17}
RUNS = [  # as they differ from the exact one
    {},
    {"models": ["capsule"], "points_per_step": 2},
    {"models": ["spheres:1"], "microseconds_per_step": 0.5},
    {"models": ["spheres:2"], "points_per_step": 5},
    {"models": ["spheres:4"], "points_per_step": 2, "error": 2.5, "trials": 1, "held": 0},
    {"models": ["prism:8"], "points_per_step": 2, "error": 2.5, "trials": 5, "held": 4},
    {"models": ["prism:16"], "points_per_step": 2, "error": 2.5, "trials": 5, "held": 3},
    {"models": ["box-capsules:1"], "points_per_step": 2, "error": 1.4, "trials": 1, "held": 0},
    {"models": ["box-capsules:2"], "points_per_step": 2, "error": None, "trials": 1, "held": 0},
    {"models": ["bullet"], "points_per_step": 2},
]

# Writes what it was asked, and an answer that another seed may change.
MADE_UP = """#!/usr/bin/env python3
import json, pathlib, sys
options = dict(zip(sys.argv[3::2], sys.argv[4::2]))
folder = pathlib.Path(__file__).parent
with open(folder / "asked", "a") as asked:
    print(json.dumps(options), file=asked)
choice = json.loads((folder / "choice.json").read_text())
choice["answer"] = json.loads((folder / "answers.json").read_text())[int(options["--seed"]) - 1]
if choice["answer"] == "refused":
    print("error: refused", file=sys.stderr)
    sys.exit(2)
pathlib.Path(options["--out"], "choose.json").write_text(json.dumps(choice))
"""


class SeedCheck(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def check(self, answers, *options):
        runs = [{**EXACT, **run} for run in RUNS]
        choice = {"schema": "touchstone-choice-1", "scene": {"name": "made-up"}, "possible": True,
                  "step_saved": 0.1, "runs": runs, "kinds": [{"name": "can on table"}]}
        return self.check_choice(choice, answers, *options)

    def check_in_engine(self, answers, *options):
        settings = [{"name": "cylinder", "step_microseconds": 9.5},
                    {"name": "cylinder + touchstone", "step_microseconds": None},
                    {"name": "capsule; box", "step_microseconds": 8.25}]
        choice = {"schema": "touchstone-engine-choice-1", "scene": {"name": "made-up"},
                  "engine": {"name": "ode"}, "settings": settings}
        return self.check_choice(choice, answers, "--engine", "ode", *options)

    def check_choice(self, choice, answers, *options):
        (self.folder / "choice.json").write_text(json.dumps(choice))
        (self.folder / "answers.json").write_text(json.dumps(answers))
        program = self.folder / "choose"
        program.write_text(MADE_UP)
        program.chmod(0o755)
        return self.run_check(program, "made-up.json", "--seeds", str(len(answers)), *options)

    @staticmethod
    def run_check(program, scene, *options):
        return subprocess.run([sys.executable, HERE / "seed_check.py", program, scene, *options],
                              capture_output=True, text=True)

    def asked(self):
        return [json.loads(line) for line in (self.folder / "asked").read_text().splitlines()]

    def test_the_exit_code_is_0_for_the_same_answer_of_all_seeds(self):
        for check, answers, code, told in (
                (self.check, [1, 1, 1], 0, r"seed 3: can on table: capsule \(10.0% of a step; tried in \d+ s\)"),
                (self.check, [1, 1, 0], 1, "seed 2: "), (self.check, [1, "refused"], 2, "error: refused"),
                (self.check_in_engine, [2, 2, 2], 0, r"seed 3: capsule; box \(in ode, 8.2 µs a step; "),
                (self.check_in_engine, [2, 0], 1, "seed 2: "), (self.check_in_engine, [0, None], 1, "seed 2: "),
                (self.check_in_engine, [None, None], 0, r"seed 1: none \(in ode; ")):
            with self.subTest(answers=answers):
                done = check(answers)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertRegex(done.stdout + done.stderr, told)

    def test_a_program_that_is_not_there(self):
        done = self.run_check(self.folder / "none", "made-up.json")
        self.assertEqual(done.returncode, 2)
        self.assertIn("cannot be run: No such file", done.stderr)

    def test_later_seeds_try_what_may_serve(self):
        self.check([0, 0, 0], "--drive", "wheel=1")
        first, second, third = self.asked()
        self.assertNotIn("--candidates", first)
        self.assertEqual(second["--candidates"],
                         "box-capsules:1,capsule,prism:8,reference,spheres:1")
        self.assertEqual(third["--candidates"], second["--candidates"])
        self.assertEqual({asked["--drive"] for asked in (first, second, third)}, {"wheel=1"})
        (self.folder / "asked").unlink()
        self.check_in_engine([2, 2])
        for asked in self.asked():
            self.assertEqual(asked["--engine"], "ode")
            self.assertNotIn("--candidates", asked)

    def test_a_scene_of_ours_in_an_engine(self):
        done = self.run_check(PROGRAM, HERE / "rod-on-table.json", "--seeds", "2", "--engine",
                              "bullet", "--disturbances", "1")
        self.assertIn("rod-on-table, seed 2: ", done.stdout + done.stderr)
        self.assertIn(" (in bullet, ", done.stdout)

    def test_a_scene_of_ours(self):
        done = self.run_check(PROGRAM, HERE / "rod-on-table.json", "--seeds", "2",
                              "--disturbances", "1")
        # Among models that hold, the answer is a matter of the machine's times.
        answers = re.findall(r"^rod-on-table, seed [12]: (exact|.*: \S+) \([-0-9.]+% of a step; ",
                             done.stdout, re.MULTILINE)
        self.assertEqual(len(answers), 2, done.stdout + done.stderr)
        self.assertEqual(done.returncode, len(set(answers)) - 1)


if __name__ == "__main__":
    unittest.main()
