#!/usr/bin/env python3
"""A page's commands do what it says: commands_test.py SOURCE-FOLDER PROGRAM PAGE

Runs every command of a page: the blocks marked `sh`, the `run:` of blocks marked `yaml`, and what
begins with `./touchstone` within a sentence. A block has a folder of its own, which looks like a
clone after its build. An unmarked block that follows holds lines which its commands print; other
blocks are not read. A workflow's file is a page of one block. A block that is a scheduler's job file (Slurm's array, Kubernetes' indexed job)
runs as three of its jobs, the last one first, and what they did is merged: it must be what one
command makes. Commands that take long are shortened (clone.py); the few that cannot run here are
named with what does run them (pages.py).
"""
import os
import pathlib
import re
import sys
import tempfile

sys.dont_write_bytecode = True
from clone import Clone  # noqa: E402
from pages import blocks_of, elsewhere_of, job_files_of, job_of  # noqa: E402

# Commands that may find what they look for, or have to.
EXIT_CODES = {
    "./reproducer": {1},
    "./touchstone check": {0, 1},
    "./touchstone compare": {0, 1},
    "./touchstone choose": {0, 1},
    "touchstone check": {0, 1},
    "python3 suite/judge.py": {1},
    "node suite/judge.js": {1},
}

# Words in a command, and how the file that it supposes is made.
KNOWN_FAILURE = "ode-cylinder-sphere-agreement-wrong-normal"
MODELS = "ln -sfn simulation/scenes/models models"
SUPPOSED = {
    "my_engine": "[ -e my_engine.c ] || cp candidates/example/cylinder_plane.c my_engine.c && "
                 "cc -shared -fPIC -I build/release/include my_engine.c -o my_engine.so -lm",
    # Of a routine that never finds a contact.
    "answers.jsonl": """python3 -Bc '
import sys; sys.path.insert(0, "suite")
import json, judge
for case in judge.read("suite/touchstone-suite-1.csv.gz"):
    print(json.dumps({"id": case["id"], "status": "none"}))' > answers.jsonl""",
    "poses.jsonl": "./touchstone replay cylinder-plane/lying/1/0 --candidates reference | "
                   """grep '^{' | tail -n 1 | sed 's/^{/{"id":"p1",/' > poses.jsonl""",
    "mine.jsonl": """echo '{"id":"p1","status":"none"}' > mine.jsonl""",
    "robot.urdf": f"cp simulation/scenes/gripper.urdf robot.urdf && {MODELS}",
    "world.sdf": f"cp simulation/scenes/warehouse.sdf world.sdf && {MODELS}",
    "failures": f"mkdir failures && grep -m 1 {KNOWN_FAILURE} properties/known_failures.jsonl "
                f"> failures/{KNOWN_FAILURE}.json",
    "--merge run": "./touchstone campaign --out run",
    "before/report.json": "./touchstone report --out before && ./touchstone report",
    "tests/touchstone.json": "./touchstone report --seed 1 --out old && mkdir tests && "
                             "cp old/report.json tests/touchstone.json",
}


def faults_of_job_file(clone, text):
    """What is wrong with a job file, a sentence each."""
    try:
        script, jobs = job_of(text)
    except ValueError as error:
        return [f"a job file {error}"]
    for environment in reversed(jobs):
        code, printed = clone.run(script, environment)
        if code != 0:
            return [f"{environment}: exit code {code}: {printed[-500:]}"]
    alone = re.sub(r'--(shard|workers) ("[^"]*"|\S+)|--resume', "", re.sub(r"\\\n\s*", "", script))
    folder = re.search(r"--out (\S+)", alone)[1]
    alone = alone.replace(f"--out {folder}", "--out alone")
    code, printed = clone.run(f"touchstone campaign --merge {folder} --out merged && {alone}\n"
                              "cmp alone/campaign.json merged/campaign.json")
    return [] if code == 0 else [f"merged, its jobs make something else: {printed[-500:]}"]


def faults_of_block(clone, commands, expected_lines):
    """What is wrong with a block, a sentence each."""
    # Where Touchstone's clone is a folder of an engine's.
    commands = [re.sub(r"\btouchstone/(?=touchstone |build/|candidates/)", "./", c) for c in commands]
    for word, preparation in SUPPOSED.items():
        if any(word in command for command in commands):
            code, printed = clone.run(preparation)
            if code != 0:
                return [f"{preparation}: exit code {code}: {printed[-500:]}"]
    faults, output = [], ""
    for command in commands:
        built = re.match(r'(?:[A-Z_]+=(?:"[^"]*"|\S+) )*(build/release/\S+)', command)
        if elsewhere_of(command):
            continue
        if built:  # a test, which CTest runs, or a benchmark
            if not os.access(clone.folder / built[1], os.X_OK):
                faults.append(f"{command}: there is no such program")
        else:
            allowed = next((c for start, c in EXIT_CODES.items() if command.startswith(start)), {0})
            code, printed = clone.run(command)
            output += printed
            if code not in allowed:
                faults.append(f"{command}: exit code {code}: {printed[-500:]}")
    return faults + [f"{commands[-1]} does not print \"{line}\""
                     for line in expected_lines if line not in output]


def main(source, program, page):
    text, faults = page.read_text(), []
    if page.suffix == ".yml":  # a workflow alone
        text = f"```yaml\n{text}```\n"
    my_engine = re.search(r"^```c\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)  # a page's plug-in
    with tempfile.TemporaryDirectory() as scratch:
        def new_clone():
            clone = Clone(source, program, pathlib.Path(tempfile.mkdtemp(dir=scratch)))
            if my_engine:
                (clone.folder / "my_engine.c").write_text(my_engine[1])
            return clone

        for job_file in job_files_of(text):
            faults += faults_of_job_file(new_clone(), job_file)
        for commands, expected_lines in blocks_of(text):
            print(commands[0], flush=True)
            faults += faults_of_block(new_clone(), commands, expected_lines)
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:4])))
