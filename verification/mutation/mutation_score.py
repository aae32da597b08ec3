#!/usr/bin/env python3
"""How good is the net? Plants faults in our own routines, one at a time, and counts who finds them.

  verification/mutation/mutation_score.py --build build/release

A fault is a forced condition, another operator, a call, sign or limit left out, a tolerance a
hundred times too large or too small, a loop that ends early, … (mutants.py). They are drawn evenly
over the lines of reference/ that hold code, seeded; a fault keeps its name and is drawn again as
long as its line stays the same. All are built into one library behind switches (planted.hpp), in
which TOUCHSTONE_FAULT says which one is active.

Four nets are held under each fault, at most 60 s of processor time each (tests: 300 s):
  classes  the pose classes of the default report
  hostile  the hostile class, and many more of it without truths, on which the routines must agree
  tests    the unit tests beside the routines, for faults that the first two do not find
  laws     `touchstone check`, for faults that none of these finds
The first two are mutation_probe's: every answer against the exact truth, and batches and single
precision against single answers (judge.hpp), but for what is wrong without a fault. What no net finds is either listed in equivalent.json, with the reason why no
answer can change, or survives.

Exit code: 0 done; 1 the score is below --bar, or equivalent.json is out of date; 2 bad usage or a
failed build.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

import mutants

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
REFERENCE = ROOT / "reference"
LIMIT = 60  # seconds of each net
TESTS_LIMIT = 5 * LIMIT  # of all tests
CHECK_COUNT = "3"  # configurations of each pair, pose class and law
C_INTERFACE = "touchstone_contacts.cpp"  # hands on; has a test of its own in C
NOT_ROUTINES = ("_test.cpp", "_test.hpp", C_INTERFACE)
FLAGS = ["-std=c++20", "-O1", "-D_GLIBCXX_ASSERTIONS", "-fPIC", "-fno-math-errno", "-fvisibility=hidden", "-w",
         # What a fault leaves unset is the same in every run, and no valid value.
         "-ftrivial-auto-var-init=pattern",
         "-isystem", "/usr/include/eigen3", "-include", str(HERE / "planted.hpp")]
HULLS = 5
# Which pair a file is of, where it is of one only.
PAIRS = {"cylinder_plane": 0, "cylinder_sphere": 1, "cylinder_capsule": 2, "cylinder_cylinder": 3,
         "rim_rim": 3, "rims": 3, "cylinder_box": 4, "box_sides": 4, "cylinder_convex": HULLS,
         "convex_proofs": HULLS, "convex_tables": HULLS, "cap_on_polygon": HULLS, "line_in_polygon": HULLS}


def routine_files():
    return sorted(p for p in REFERENCE.glob("*.[ch]pp") if not p.name.endswith(NOT_ROUTINES))


def digest(*parts):
    total = hashlib.sha256()
    for part in parts:
        total.update(part.read_bytes() if isinstance(part, pathlib.Path) else str(part).encode())
        total.update(b"\0")
    return total.hexdigest()[:16]


def run(*words, **options):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True, **options)


class BuildFailed(Exception):
    pass


class Library:
    """The routines with the drawn faults behind switches, numbered from 1."""

    def __init__(self, drawn, work, jobs, rest=None):
        """`rest` is an archive of the routines: then only files with faults are compiled."""
        self.faults = dict(enumerate(drawn, 1))
        self.refused = []  # by the compiler
        self.tree = work / "planted"
        self.objects = work / "objects"
        (self.tree / "reference").mkdir(parents=True, exist_ok=True)
        self.objects.mkdir(parents=True, exist_ok=True)
        self.sources = {p.name: p.read_text() for p in routine_files()}
        self.file = work / "libplanted.so"
        self.rest = [rest] if rest else []
        units = [n for n in self.sources if n.endswith(".cpp") and
                 (not rest or any(m.file == n for m in drawn))]
        for name in sorted(self.sources, key=lambda n: n.endswith(".cpp")):
            self.write(name)
        for header in REFERENCE.glob("*_test.hpp"):
            (self.tree / "reference" / header.name).write_text(header.read_text())
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            while True:
                results = list(pool.map(self.compile, units))
                errors = [text for text in results if text]
                if not errors:
                    break
                self.drop("\n".join(errors))
        self.link(units)

    def write(self, name):
        of_file = [(k, m) for k, m in self.faults.items() if m.file == name]
        text = mutants.planted(self.sources[name], of_file)
        path = self.tree / "reference" / name
        if not path.exists() or path.read_text() != text:
            path.write_text(text)

    def compile(self, name, flags=()):
        """The errors of one file, empty if there are none."""
        source = self.tree / "reference" / name
        return self.compile_to(self.objects / (name + ".o"), source, ["-I", self.tree, *flags])

    def compile_to(self, target, source, flags):
        # With every header of the tree: which of them a file includes is not asked.
        headers = sorted((self.tree / "reference").glob("*.hpp"))
        stamp = target.with_suffix(".stamp")
        key = digest(*FLAGS, source, HERE / "planted.hpp", HERE / "routines.hpp", *headers)
        if target.exists() and stamp.exists() and stamp.read_text() == key:
            return ""
        done = run("g++", *FLAGS, *flags, "-c", source, "-o", target)
        if done.returncode == 0:
            stamp.write_text(key)
            return ""
        return done.stderr or f"{source}: the compiler failed"

    def drop(self, errors):
        """Takes out the faults on the lines that an error speaks of."""
        places = set(re.findall(r"reference/(\w+\.[ch]pp):(\d+)", errors))
        bad = [k for k, m in self.faults.items() if (m.file, str(m.line)) in places]
        if not bad:
            raise BuildFailed(errors)
        files = set()
        for k in bad:
            files.add(self.faults[k].file)
            self.refused.append(self.faults.pop(k))
        for name in files:
            self.write(name)

    def link(self, units):
        self.routine_objects = [self.objects / (name + ".o") for name in units]
        objects = list(self.routine_objects)
        # The plug-in of our own routines, under a name that is not taken.
        plugin = self.tree / "planted.cpp"
        text = (ROOT / "candidates" / "reference.cpp").read_text()
        named = 'name = "reference"'
        if named not in text:
            raise BuildFailed(f"candidates/reference.cpp: has no {named}")
        plugin.write_text(text.replace(named, 'name = "planted"'))
        for source in [HERE / "routines.cpp"] + ([] if self.rest else [plugin]):
            target = self.objects / f"{source.parent.name}-{source.name}.o"
            errors = self.compile_to(target, source, [
                "-I", self.tree, "-I", ROOT, '-DTOUCHSTONE_VERSION="0"'])
            if errors:
                raise BuildFailed(errors)
            objects.append(target)
        done = run("g++", "-shared", "-Wl,-Bsymbolic", *objects, *self.rest, "-o", self.file)
        if done.returncode != 0:
            raise BuildFailed(done.stderr)


class UnitTests:
    """`reference_test` on a planted library. What it needs of other rooms is the build's; the linker
    takes the first of several copies of an inline function, and that is the planted one."""

    def __init__(self, library, build, work, jobs):
        commands = json.loads((build / "compile_commands.json").read_text())
        built = next(c for c in commands if "reference_test.dir/" in c["command"])["command"]
        words = shlex.split(built)
        flags = [w for before, w in zip([""] + words, words)
                 if w.startswith(("-D", "-I", "-isystem")) or before == "-isystem"]
        files = sorted(REFERENCE.glob("*_test.cpp"))
        for p in files:
            (library.tree / "reference" / p.name).write_text(p.read_text())
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            errors = [text for text in pool.map(
                lambda p: library.compile(p.name, flags), files) if text]
        if errors:
            raise BuildFailed("\n".join(errors))
        self.file = work / "planted_tests"
        objects = [library.objects / (p.name + ".o") for p in files]
        link = run("ninja", "-C", build, "-t", "commands", "reference_test").stdout.splitlines()[-1]
        libraries = [build / word if word.endswith(".a") else word for word in shlex.split(link)
                     if re.search(r"\.a$|\.so|^-l", word) and "touchstone_reference" not in word]
        done = run("g++", *objects, *library.routine_objects, *library.rest, *libraries,
                   "-lpthread", "-o", self.file)
        if done.returncode != 0:
            raise BuildFailed(done.stderr)

    def finding(self, number):
        environment = dict(os.environ, TOUCHSTONE_FAULT=str(number), RC_PARAMS="seed=1")
        try:
            done = run(self.file, "--gtest_brief=1", "--gtest_fail_fast", env=environment,
                       timeout=20 * TESTS_LIMIT,
                       preexec_fn=lambda: limit_processor_time(TESTS_LIMIT))
        except subprocess.TimeoutExpired:
            return "does not end"
        if done.returncode < 0:
            return "does not end" if -done.returncode in (24, 26) else f"signal {-done.returncode}"
        if done.returncode == 0:
            return None
        return next((line.split()[3].rstrip(",") for line in done.stdout.splitlines()
                     if line.startswith("[  FAILED  ] ")), "a test")


class Probe:
    """mutation_probe with the cases and truths of one net."""

    def __init__(self, program, net, count, more, work):
        self.program, self.net, self.more = program, net, more
        makers = [p for room in ("properties", "oracle", "oracle/patch")
                  for p in sorted((ROOT / room).glob("*.[ch]pp")) if "test" not in p.name]
        makers += [HERE / "cases.cpp", HERE / "cases.hpp", *REFERENCE.glob("random_*_test.hpp")]
        self.cases = work / f"{net}-{digest(count, *makers)}.cases"
        self.known = work / f"{net}.known"
        if not self.cases.exists():
            part = self.cases.with_suffix(".part")
            done = run(program, "cases", net, count, part)
            if done.returncode != 0:
                raise BuildFailed(done.stderr)
            part.rename(self.cases)

    def baseline(self, library):
        done = run(self.program, "baseline", library.file, self.cases, self.known,
                   self.more)
        if done.returncode != 0:
            raise BuildFailed(f"baseline: {done.stderr}{done.stdout}")
        return done.stdout.strip()

    def finding(self, library, number, pair):
        environment = dict(os.environ, TOUCHSTONE_FAULT=str(number))
        words = [self.program, "ask", library.file, self.cases, self.known, self.more,
                 -1 if pair is None else pair]
        try:
            done = run(*words, env=environment, timeout=20 * LIMIT,
                       preexec_fn=limit_processor_time)
        except subprocess.TimeoutExpired:
            return "does not end"
        if done.returncode < 0:
            return "does not end" if -done.returncode in (24, 26) else f"signal {-done.returncode}"
        if done.returncode == 2:
            raise BuildFailed(done.stderr)
        return done.stdout.strip() or None


def limit_processor_time(seconds=LIMIT):
    import resource
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def law_finding(touchstone, library, number, pair):
    if pair == HULLS:
        return None  # no law is asked of hulls
    names = ["cylinder-plane", "cylinder-sphere", "cylinder-capsule", "cylinder-cylinder",
             "cylinder-box"]
    environment = dict(os.environ, TOUCHSTONE_FAULT=str(number))
    words = [touchstone, "check", "--candidate", library.file, "--count", CHECK_COUNT]
    if pair is not None:
        words += ["--pair", names[pair]]
    try:
        done = run(*words, env=environment, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return None  # nothing within its time
    if done.returncode == 0:
        return None
    if done.returncode != 1:
        raise BuildFailed(f"{' '.join(map(str, words))}: {done.stdout}{done.stderr}")
    return next((line for line in done.stdout.splitlines() if "/" in line), "a law").strip()


def parse_words():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    words.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release",
                       help="where mutation_probe and touchstone were built")
    words.add_argument("--work", type=pathlib.Path, help="where to write; default BUILD/mutation")
    words.add_argument("--count", type=int, default=220, help="faults to draw")
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", default="", help="of the faults drawn, those whose name has this")
    words.add_argument("--classes", type=int, default=200,
                       help="configurations of each pair and pose class")
    words.add_argument("--hostile", type=int, default=40000,
                       help="hostile configurations of each pair")
    words.add_argument("--more", type=int, default=250000,
                       help="hostile configurations of each pair that are asked without a truth")
    words.add_argument("--laws", choices=["yes", "no"], default="yes",
                       help="whether to ask the unit tests and `check`")
    words.add_argument("--bar", type=float, default=0.98, help="the lowest score that passes")
    words.add_argument("--jobs", type=int, default=1)
    words.add_argument("--handful", action="store_true",
                       help="only faults in .cpp files, the rest from the build, without laws")
    words.add_argument("--list", action="store_true", help="only list the faults")
    words.add_argument("--table", type=pathlib.Path,
                       help="add one line a fault there; faults that it has are not tried again")
    return words.parse_args()


class Table:
    """What was found of each fault: a file of lines that a run which was stopped goes on with."""
    NETS = ("classes", "hostile", "tests", "laws")

    def __init__(self, file):
        self.file, self.found = file, {}
        if file and file.exists():
            for line in file.read_text().splitlines():
                place, operator, column, text, *found = line.split("\t")
                name = mutants.Mutant(place.split(":")[0], 0, operator, text, int(column), ()).name
                self.found[name] = {n: None if f == "-" else f for n, f in zip(self.NETS, found)}

    def add(self, mutant, found):
        if self.file:
            cells = [mutant.place, mutant.operator, str(mutant.column), mutant.text]
            cells += [found[net] or "-" for net in self.NETS]
            with self.file.open("a") as file:
                file.write("\t".join(cells) + "\n")


def draw(words):
    every = []
    for path in routine_files():
        every += mutants.mutants_of(path.name, path.read_text())
    if words.handful:
        every = [m for m in every if m.file.endswith(".cpp")]
    return [m for m in mutants.draw(every, words.count, words.seed) if words.only in m.name]


def main():
    words = parse_words()
    if words.count < 1:
        print(f"--count is {words.count}: must be at least 1", file=sys.stderr)
        return 2
    drawn = draw(words)
    if words.list:
        for m in drawn:
            print(m.place, m.name)
        return 0
    if words.handful:
        words.laws = "no"
    reasons = json.loads((HERE / "equivalent.json").read_text())
    work = (words.work or words.build / "mutation").resolve()
    work.mkdir(parents=True, exist_ok=True)
    program = words.build.resolve() / "verification" / "mutation" / "mutation_probe"
    touchstone = words.build.resolve() / "touchstone"
    tests = words.build.resolve() / "reference" / "reference_test"
    for needed in [program] + ([touchstone, tests] if words.laws == "yes" else []):
        if not needed.exists():
            print(f"{needed} is missing: cmake --build {words.build} --target {needed.name}",
                  file=sys.stderr)
            return 2
    try:
        return score(words, drawn, reasons, work, program, touchstone)
    except BuildFailed as error:
        print(error, file=sys.stderr)
        return 2


def score(words, drawn, reasons, work, program, touchstone):
    rest = words.build.resolve() / "reference" / "libtouchstone_reference.a"
    library = Library(drawn, work, words.jobs, rest if words.handful else None)
    print(f"{len(drawn)} faults drawn, {len(library.refused)} of them refused by the compiler")
    probes = [Probe(program, "classes", words.classes, 0, work),
              Probe(program, "hostile", words.hostile, words.more, work)]
    for probe in probes:
        print(f"{probe.net}: {probe.baseline(library)}", flush=True)

    tests = UnitTests(library, words.build.resolve(), work, words.jobs) if words.laws == "yes" else None
    if tests and (broken := tests.finding(0)):
        raise BuildFailed(f"a test fails without a fault: {broken}")
    if words.laws == "yes" and (broken := law_finding(touchstone, library, 0, None)):
        raise BuildFailed(f"laws are broken without a fault: {broken}")

    table = Table(words.table)

    def findings(item):
        number, mutant = item
        if mutant.name in table.found:
            return mutant, table.found[mutant.name]
        pair = PAIRS.get(mutant.file.split(".")[0])
        found = {p.net: p.finding(library, number, pair) for p in probes}
        found["tests"] = tests.finding(number) if tests and not any(found.values()) else None
        found["laws"] = None
        if words.laws == "yes" and not any(found.values()) and mutant.name not in reasons:
            found["laws"] = law_finding(touchstone, library, number, pair)
        return mutant, found

    with concurrent.futures.ThreadPoolExecutor(words.jobs) as pool:
        results = []
        for mutant, found in pool.map(findings, sorted(library.faults.items())):
            results.append((mutant, found))
            if mutant.name not in table.found:
                table.add(mutant, found)
            text = "; ".join(f"{net}: {f}" for net, f in found.items() if f)
            if not text:
                text = "equivalent: " + reasons[mutant.name] if mutant.name in reasons else "SURVIVES"
            print(f"{mutant.place} {mutant.operator} | {mutant.text} | {text}", flush=True)
    return summary(words, results, reasons)


def summary(words, results, reasons):
    by_net = collections.Counter()
    killed, equivalent, surviving, wrong = [], [], [], []
    for mutant, found in results:
        nets = [net for net, f in found.items() if f]
        for net in nets:
            by_net[net] += 1
        if nets:
            killed.append(mutant)
            by_net["first " + nets[0]] += 1
            if mutant.name in reasons:
                wrong.append(f"is found, so it is not equivalent: {mutant.name}")
        elif mutant.name in reasons:
            equivalent.append(mutant)
        else:
            surviving.append(mutant)
    if not words.only and not words.handful:
        names = {m.name for m, _ in results}
        everything = {m.name for p in routine_files()
                      for m in mutants.mutants_of(p.name, p.read_text())}
        wrong += [f"is no fault of the present source: {n}" for n in reasons if n not in everything]
    relevant = len(results) - len(equivalent)
    value = len(killed) / relevant if relevant else 1
    print(f"\n{len(results)} faults: {len(killed)} found (classes {by_net['classes']}, hostile "
          f"{by_net['hostile']}, both or either {by_net['first classes'] + by_net['first hostile']}, "
          f"only tests {by_net['first tests']}, only laws {by_net['first laws']}), {len(equivalent)} equivalent, "
          f"{len(surviving)} surviving")
    print(f"mutation score {100 * value:.1f}% = {len(killed)} of {relevant}")
    for mutant in surviving:
        print(f"  survives: {mutant.place} {mutant.name}")
    for text in wrong:
        print(f"  equivalent.json: {text}")
    return 0 if value >= words.bar and not wrong else 1


if __name__ == "__main__":
    sys.exit(main())
