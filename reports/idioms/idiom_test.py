#!/usr/bin/env python3
"""A file of tests does what it says: idiom_test.py PROGRAM SOURCE-FOLDER IDIOM ENGINE [OPTION…]

Writes the file, runs it by the command in its comment, and all its tests pass. With every expected
verdict struck out ("right" in its place) just those tests fail whose case the engine gets wrong. And
with our own routine in the engine's place all of these pass; with a fault in its answers those fail in
which the bodies overlap. OPTIONs are those of `touchstone export`.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

EXPECTED = {"gtest": r'(EXPECT_EQ\(verdict\(\), )"([a-z-]+)"', "boost": r'(BOOST_CHECK_EQUAL\(verdict\(\), )"([a-z-]+)"',
            "unittest": r'( expected=)"([a-z-]+)"', "rust": r'(assert_eq!\(verdict\(&c\), )"([a-z-]+)"', "mjcf": r'(\.verdict" data=)"([a-z-]+)"', "js": r"(\), |reachOf\w+\), )'([a-z-]+)'(?=\);)"}
NAMES = {"gtest": r"^TEST_F\((\w+), (\w+)\)", "boost": r"^BOOST_FIXTURE_TEST_CASE\((\w+?)_(\w+), ",
         "unittest": r"^(?:class (\w+)\(CylinderContact\)|    def test_(\w+)\()", "js": r"^test\('(\S+) (\S+)'",
         "rust": r"^fn cylinder_([a-z]+)_(\w+)\(\)", "mjcf": r'<pair name="(\S+)/(\S+)"'}
FAILED = {"gtest": r"^\[  FAILED  \] (\w+\.\w+)", "boost": r'error: in "(\w+)"',
          "unittest": r"^FAIL: test_(\w+) \(\w+\.(\w+)", "js": r"^not ok \d+ - (\S+ \S+)",
          "rust": r"^test cylinder_(\w+) \.\.\. FAILED", "mjcf": r"^FAILED (\S+):"}

# The module that a file of unittest imports: the engine of candidates/clients with half of its depths, so that it is
# wrong wherever bodies overlap; or our routine. As a program it is the candidate.
MODULE = """
import json, os, subprocess, sys
sys.path.append("@clients@")
from example import Example
from touchstone_candidate import Box, Capsule, Convex, Cylinder, Plane, Pose, Sphere, run

class Shallow(Example):
    name = "shallow"
    def contact(self, distance, *rest):
        return super().contact(distance / 2, *rest)

KINDS = {"plane": Plane, "sphere": Sphere, "capsule": Capsule, "cylinder": Cylinder, "box": Box, "convex": Convex}

def contact(a, pose_a, b, pose_b, threshold):
    if os.environ.get("RIGHT"):
        line = json.dumps({"a": a, "pose_a": pose_a, "b": b, "pose_b": pose_b})
        printed = subprocess.run([os.environ["TOUCHSTONE"], "solve", "--candidates", "reference"], input=line,
                                 check=True, capture_output=True, text=True).stdout
        found = json.loads(printed)["answers"]["reference"]
        fault = os.environ["RIGHT"]
        if found["status"] == "none" or fault == "missed":
            return None
        deeper, moved = 1e-3 * (fault == "deeper"), 9 * (fault == "moved")
        points = [([x + moved, y, z], p["depth"] + deeper) for p in found["points"] for x, y, z in [p["position"]]]
        normal = [-u if fault == "reversed" else u for u in found["normal"]]
        return found["signed_distance"] - deeper, normal, points
    shapes = [KINDS[s["shape"]](*[v for k, v in s.items() if k != "shape"]) for s in (a, b)]
    poses = [Pose(p["position"], p["orientation"]) for p in (pose_a, pose_b)]
    engine = Shallow()
    found = engine.query(engine.prepare(*shapes, threshold, 0), *poses, None)
    return found and (found.signed_distance, found.normal, [(p.position, p.depth) for p in found.points])

if __name__ == "__main__":
    run(Shallow)
"""

# Our routine in the place of the engine's answer.
HEADERS_CPP = '#include "reference/touchstone.hpp"\n#include <cstdlib>\n\n'
RIGHT_CPP = """touchstone::Vec3 vec3(const double* v) { return {v[0], v[1], v[2]}; }
touchstone::Pose pose(const double* p, const double* q) { return {vec3(p), {q[0], q[1], q[2], q[3]}}; }
template <class Case>
auto shape_of_b(const Case& c) {
  if constexpr (requires { c.half_b; }) return touchstone::Box(vec3(c.half_b));
  else if constexpr (requires { c.normal_b; }) return touchstone::Plane(vec3(c.normal_b), c.displacement_b);
  else if constexpr (requires { c.faces_b; }) {
    std::vector<touchstone::Vec3> vertices;
    for (const auto& v : c.vertices_b) vertices.push_back(vec3(v));
    return touchstone::Convex(vertices, c.faces_b);
  } else if constexpr (Case::is_capsule) return touchstone::Capsule(c.radius_b, c.half_length_b);
  else if constexpr (requires { c.half_length_b; }) return touchstone::Cylinder(c.radius_b, c.half_length_b);
  else return touchstone::Sphere(c.radius_b);
}
template <class Case>
Answer right_answer(const Case& c) {
  const touchstone::Contact found =
      touchstone::contact(touchstone::Cylinder(c.radius_a, c.half_length_a), pose(c.position_a, c.orientation_a),
                          shape_of_b(c), pose(c.position_b, c.orientation_b), 0);
  Answer answer;
  const std::string fault = std::getenv("RIGHT");
  const touchstone::Vec3 n = (fault == "reversed" ? -1 : 1) * found.normal;
  const double deeper = fault == "deeper" ? 1e-3 : 0, moved = fault == "moved" ? 9 : 0;
  for (const touchstone::ContactPoint& p : found.points()) {
    if (fault == "missed") continue;
    add(answer, -p.depth - deeper, {n.x(), n.y(), n.z()}, {p.position.x() + moved, p.position.y(), p.position.z()});
  }
  return answer;
}

"""

# Likewise, by the program: the world is the engine's, and a cylinder's axis that of its own frame.
RIGHT_JS = """
import { execFileSync } from 'node:child_process';
function rightAnswer(c, name) {
  const orientation = ([@order@]) => [w, x, y, z], b = name.slice(3).toLowerCase();
  const size = { radius: c.radiusB, half_length: c.halfLengthB, half_extents: c.halfB, normal: c.normalB,
    displacement: c.displacementB };
  const round = b === 'cylinder' || b === 'capsule';
  const line = { a: { shape: 'cylinder', radius: c.radiusA, half_length: c.halfLengthA },
    pose_a: { position: c.positionA, axis: axisOf(c.orientationA) }, b: { shape: b, ...size },
    pose_b: { position: c.positionB, ...(round ? { axis: axisOf(c.orientationB) } : { orientation: orientation(c.orientationB) }) } };
  const printed = execFileSync(process.env.TOUCHSTONE, ['solve', '--candidates', 'reference'], { input: JSON.stringify(line) });
  const { reference } = JSON.parse(printed).answers;
  const fault = process.env.RIGHT;
  if (reference.status === 'none' || fault === 'missed') return null;
  const deeper = fault === 'deeper' ? 1e-3 : 0, moved = fault === 'moved' ? 9 : 0;
  const points = reference.points.map(({ position: [x, y, z], depth }) =>
    ({ position: [x + moved, y, z], depth: depth + deeper }));
  return { distance: reference.signed_distance - deeper, points,
    normal: reference.normal.map((u) => fault === 'reversed' ? -u : u) };
}
"""


class File:
    def __init__(self, program, source, idiom, engine, options, folder):
        self.program, self.source, self.idiom, self.folder = program, source, idiom, folder
        command = []
        if idiom == "unittest":
            module = folder / f"{engine}.py"
            module.write_text(MODULE.replace("@clients@", os.path.join(os.path.abspath(source), "candidates/clients")))
            command = ["--candidate-command", f"{sys.executable} {module}"]
        self.text = subprocess.run([program, *command, "export", "--as", idiom, "--engine", engine, *options],
                                   check=True, capture_output=True, text=True).stdout
        self.names, parent = [], ""
        for of, name in re.findall(NAMES[idiom], self.text, re.MULTILINE):
            parent = of or parent
            if name:
                self.names.append(f"{parent}.{name}")
        verdicts = [m[2] for m in re.finditer(EXPECTED[idiom], self.text)]
        assert len(verdicts) == len(self.names) > 0, (len(verdicts), self.names)
        self.wrong = {name for name, verdict in zip(self.names, verdicts) if verdict != "right"}

    def struck_out(self):
        """Every case is expected to be right, and our routine may answer instead."""
        quote = "'" if self.idiom == "js" else '"'
        text = re.sub(EXPECTED[self.idiom], rf"\1{quote}right{quote}", self.text)
        if self.idiom in ("unittest", "mjcf", "rust"):
            return text  # what its module, its reader or the crate beside it answers by our routine
        if self.idiom != "js":
            text = text.replace("namespace {\n", HEADERS_CPP + "namespace {\n", 1)
            text = text.replace(" protected:\n", " public:\n")
            text = text.replace("template <int count>", RIGHT_CPP + "template <int count>", 1)
            return text.replace("  Answer ask() override {",
                                "  static constexpr bool is_capsule = IS_CAPSULE;\n"
                                "  Answer ask() override {\n    if (std::getenv(\"RIGHT\")) return right_answer(*this);")
        order = re.search(r"axisOf = \(\[(.*?)\]\)", text)[1]
        text = text.replace("import test from", RIGHT_JS.replace("@order@", order) + "import test from", 1)
        return text.replace("answer = ask(c);",
                            "answer = process.env.RIGHT ? rightAnswer(c, ask.name) : ask(c);")

    def made(self, text):
        """The command that runs a file of this text."""
        if self.idiom == "js":
            program, package = re.search(r"npm install (\S+)@\S+ && node (\S+)", self.text).group(2, 1)
            link = self.folder / "node_modules" / package
            link.parent.mkdir(parents=True, exist_ok=True)
            if not link.exists():
                link.symlink_to(pathlib.Path(os.environ["TOUCHSTONE_NPM"]) / "node_modules" / package)
            (self.folder / program).write_text(text)
            return ["node", "--test-reporter=tap", program]
        if self.idiom == "unittest":
            program = re.search(r"python3 -m unittest -v (\S+)", self.text)[1]
            (self.folder / program).write_text(text)
            return [sys.executable, "-Bm", "unittest", "-v", program]
        if self.idiom == "rust":
            name = re.search(r"tests/(\S+\.rs)", self.text)[1]
            (self.folder / name).write_text(text)
            for stand_in in ("parry3d.rs", "parry.mjs"):
                shutil.copy(pathlib.Path(__file__).with_name(stand_in), self.folder)
            packages = self.folder / "node_modules"
            if not packages.exists():
                packages.symlink_to(pathlib.Path(os.environ["TOUCHSTONE_NPM"]) / "node_modules")
            for command in (["--crate-type=rlib", "parry3d.rs"], ["--test", name, "--extern=parry3d=libparry3d.rlib"]):
                subprocess.run(["rustc", "--edition=2021", "-Dwarnings", *command], check=True, cwd=self.folder)
            return ["./" + name.removesuffix(".rs")]
        if self.idiom == "mjcf":
            (self.folder / "contacts.xml").write_text(text)
            return [pathlib.Path(self.program).parent / "reports/idioms/mjcf_reader", "contacts.xml"]
        command = re.search(r"^// Compile  (.*)", self.text, re.MULTILINE)[1]
        name = re.search(r"g\+\+ -O2 (\S+)", command)[1]
        classes = re.split(r"(?=^class Cylinder)", text, flags=re.MULTILINE)
        text = "".join(c.replace("IS_CAPSULE", str(c.startswith("class CylinderCapsule")).lower()) for c in classes)
        (self.folder / name).write_text(text)
        command = command.replace("-O2", "-O0")
        if text != self.text:
            library = pathlib.Path(self.program).parent / "reference/libtouchstone_reference.a"
            command += f" -std=c++20 -I {self.source} -isystem /usr/include/eigen3 {library}"
        subprocess.run(command, shell=True, check=True, cwd=self.folder)
        every = ["--log_level=test_suite"] if self.idiom == "boost" else []  # names those that pass
        return ["./" + name.removesuffix(".cpp"), *every]

    def failures(self, command, **environment):
        """Names of the tests that fail."""
        environment = {**os.environ, "TOUCHSTONE": self.program, **environment}
        result = subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, env=environment)
        found = re.findall(FAILED[self.idiom], result.stdout, re.MULTILINE)
        if self.idiom == "unittest":
            failed = {f"{of}.{name}" for name, of in found}
        else:
            failed = {re.sub("[_ /]", ".", name, count=1) for name in found}
        assert (result.returncode != 0) == bool(failed), result.stdout
        assert all(name in result.stdout for name in map(self.printed, self.names)), result.stdout
        return failed

    def printed(self, name):
        separator = {"gtest": ".", "boost": "_", "rust": "_", "js": " ", "mjcf": "/"}
        return name.replace(".", separator[self.idiom]) if self.idiom in separator else "test_" + name.split(".")[1]


def main(program, source, idiom, engine, *options):
    with tempfile.TemporaryDirectory() as folder:
        file = File(os.path.abspath(program), source, idiom, engine, options, pathlib.Path(folder))
        assert not (failed := file.failures(file.made(file.text))), f"as it is written: {failed}"
        command = file.made(file.struck_out())
        assert file.wrong, f"{engine} gets none of these wrong: {file.names}"
        assert (failed := file.failures(command)) == file.wrong, (failed, file.wrong)
        assert not (failed := file.failures(command, RIGHT="1")), f"our routine: {failed}"
        if idiom in ("unittest", "js", "rust") and len(file.names) < 10:
            return  # each answer is a program's: the long test goes on
        missed = file.failures(command, RIGHT="missed")
        assert missed, "no case wants a contact"
        for fault in ("deeper", "reversed", "moved"):
            unseen = missed - file.failures(command, RIGHT=fault)
            if fault == "reversed":  # bodies about one centre may part either way
                unseen = {name for name in unseen if not re.search("concentric|coaxial", name, re.IGNORECASE)}
            assert not unseen, f"{fault}: {unseen}"


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
