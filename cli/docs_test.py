#!/usr/bin/env python3
"""The pages say what is so: docs_test.py SOURCE-FOLDER PROGRAM

Runs every command of the pages: the blocks marked `sh`, the `run:` of blocks marked `yaml`, and
what begins with `./touchstone` within a sentence. A block has a folder of its own, which looks like
a clone after its build. An unmarked block that follows holds lines which its commands print; other
blocks are not read. A block that is a scheduler's job file (Slurm's array, Kubernetes' indexed job)
runs as three of its jobs, the last one first, and what they did is merged: it must be what one
command makes. Commands that take long are shortened (SHORTER); the few that cannot run here
are named with what does run them (ELSEWHERE). Links, names of source files and options must exist.
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import textwrap
import time

PAGES = ["README.md", "CONTRIBUTING.md", "docs/*.md", "oracle/README.md", "oracle/audit/README.md",
         "reference/README.md", "reference/proofs.md", "suite/README.md"]

# Options of the subcommands that take long; one that the page gives itself stays, but
# for --count and --disturbances, which become small.
SHORTER = {
    "report": {"--pair": "cylinder-plane", "--class": "lying", "--count": "1",
               "--candidates": "reference,bullet"},
    "check": {"--law": "agreement", "--pair": "cylinder-plane", "--count": "1"},
    "campaign": {"--pair": "cylinder-plane", "--class": "lying", "--count": "1600",
                 "--candidates": "reference"},
    "search": {"--pair": "cylinder-plane", "--class": "general-shallow", "--count": "8"},
    "stability": {"--part": "amplification", "--count": "1", "--candidates": "reference"},
    "simulate": {"--step": "0.016", "--candidates": "reference"},
    "choose": {"--candidates": "capsule"},
    "render": {"--every": "1"},
}

SCENES = (".json", ".urdf", ".sdf", ".xml")

# Beginnings of commands that do not run here, with what does run them.
ELSEWHERE = {
    "./touchstone test": "touchstone_script_test.sh",
    "cmake --preset": ".ci/run and candidates/example/example_test.sh",
    "cpack ": "cmake/package_test.sh",
    "touchstone --version": "cli/tests/usage_test.sh",
    "cmake -S reference": "ReferenceAlone.BuildsAndInstalls",
    "parallel ": "reports/campaigns/campaign_test.sh, one shard after the other",
    "python3 oracle/check_certificate_test.py": "check_certificate",
    "python3 oracle/forge_certificates.py": "forge_certificates",
    "apt-get install": "nothing: it needs the network",
    "cd out/render": "simulation/scenes/povray_test.cpp, which writes what POV-Ray reads",
}

# Commands that may find what they look for, or have to.
EXIT_CODES = {
    "./reproducer": {1},
    "./touchstone check": {0, 1},
    "./touchstone search": {0, 1},
    "./touchstone compare": {0, 1},
    "./touchstone choose": {0, 1},
    "python3 suite/judge.py": {1},
    "node suite/judge.js": {1},
}

# Words in a command, and how the file that it supposes is made.
KNOWN_FAILURE = "ode-cylinder-sphere-agreement-wrong-normal"
SUPPOSED = {
    "my_engine": "cp candidates/example/cylinder_plane.c my_engine.c && "
                 "cc -shared -fPIC -I build/release/include my_engine.c -o my_engine.so -lm",
    # Of a routine that never finds a contact.
    "answers.jsonl": """python3 -Bc '
import sys; sys.path.insert(0, "suite")
import json, judge
for case in judge.read("suite/touchstone-suite-1.csv.gz"):
    print(json.dumps({"id": case["id"], "status": "none"}))' > answers.jsonl""",
    "poses.jsonl": "./touchstone replay cylinder-plane/lying/1/0 | grep '^{' | tail -n 1 "
                   "> poses.jsonl",
    "mine.jsonl": """sed -i 's/^{/{"id":"p1",/' poses.jsonl &&
        echo '{"id":"p1","status":"none"}' > mine.jsonl""",
    "robot.urdf": "cp simulation/scenes/gripper.urdf robot.urdf",
    "world.sdf": "cp simulation/scenes/warehouse.sdf world.sdf",
    "failures": f"mkdir failures && grep -m 1 {KNOWN_FAILURE} properties/known_failures.jsonl "
                f"> failures/{KNOWN_FAILURE}.json",
    "merge run": "./touchstone campaign --out run",
    "before/report.json": "./touchstone report --out before && ./touchstone report",
    "tests/touchstone.json": "./touchstone report --seed 1 --out old && mkdir tests && "
                             "cp old/report.json tests/touchstone.json",
}


def shortened(arguments):
    """The arguments that the program is given in place of a page's."""
    command = next((a for a in arguments if a in SHORTER), None)
    if command is None or "--help" in arguments or "--engine" in arguments:
        return arguments
    for option, value in SHORTER[command].items():
        if option == "--class" and "--group" in arguments:
            continue  # the group may have no such class
        if option == "--step" and any(a.endswith(SCENES) for a in arguments):
            continue  # a scene has its own
        if option not in arguments:
            arguments = [*arguments, option, value]
        elif option == "--count":
            arguments[arguments.index(option) + 1] = value
    if "--disturbances" in arguments:
        arguments[arguments.index("--disturbances") + 1] = "4"
    return arguments


def commands_of(block):
    """One string for each command, without comments and with its lines joined."""
    lines = re.sub(r"\\\n\s*", "", block).splitlines()
    return [c for c in (re.sub(r"(^|\s+)#.*", "", line).strip() for line in lines) if c]


FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
JOBS = 3  # of a job file that says how many by itself


def is_job_file(text):
    return "#SBATCH" in text or "kind: Job" in text


def job_of(text):
    """A job file's script, and the environment of each of its jobs."""
    if "#SBATCH" in text:
        return text, [{"SLURM_ARRAY_TASK_ID": str(i + 1), "SLURM_ARRAY_TASK_COUNT": str(JOBS),
                       "SLURM_CPUS_PER_TASK": "1"} for i in range(JOBS)]
    script = re.search(r"^( *)- \|\n((?:\1 .*\n|\n)+)", text, re.MULTILINE)
    named = dict(re.findall(r'name: (\w+), value: "(\d+)"', text))
    completions = re.search(r"^ *completions: (\d+)$", text, re.MULTILINE)
    if not script or "completionMode: Indexed" not in text or not completions:
        raise ValueError("is no indexed job with a script")
    if named != {"SHARDS": completions[1]}:
        raise ValueError("has another number of completions than of shards")
    return textwrap.dedent(script[2]), [{"JOB_COMPLETION_INDEX": str(i), "SHARDS": str(JOBS)}
                                        for i in range(JOBS)]


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
    code, printed = clone.run(f"touchstone merge {folder} --out merged && {alone}\n"
                              "cmp alone/campaign.json merged/campaign.json")
    return [] if code == 0 else [f"merged, its jobs make something else: {printed[-500:]}"]


def blocks_of(page):
    """Pairs of commands and the lines that they print, from a page's text."""
    blocks = []
    for mark, text in FENCE.findall(page):
        if is_job_file(text):
            continue
        if mark == "sh":
            blocks.append((commands_of(text), []))
        elif mark == "yaml":
            blocks.append((commands_of(text.split("run: |\n")[1]), []))
        elif mark == "":
            blocks[-1][1].extend(text.splitlines())
    within_sentences = re.findall(r"`(\./touchstone [^`]*)`", FENCE.sub("", page))
    return blocks + [([c], []) for c in dict.fromkeys(within_sentences)]


class Clone:
    """A folder that looks like a clone after its build; its ./touchstone shortens commands."""

    def __init__(self, source, program, folder):
        self.folder = folder
        folder.mkdir()
        for entry in source.iterdir():
            if entry.name not in ("touchstone", "build", "out", ".git"):
                (folder / entry.name).symlink_to(entry)
        (folder / "build").mkdir()
        (folder / "build" / "release").symlink_to(program.parent)
        script = folder / "touchstone"
        this = pathlib.Path(__file__).resolve()
        script.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{this}" --as "{program}" "$@"\n')
        script.chmod(0o755)

    def run(self, command, of_job=None):
        """Exit code and what was printed. `of_job`: more of the environment."""
        command = re.sub(r"^mpirun -n \d+", "mpirun --oversubscribe -n 2", command)
        environment = dict(os.environ, PATH=f"{self.folder}:{os.environ['PATH']}",
                           OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           **(of_job or {}))
        result = subprocess.run(["timeout", "60", "bash", "-o", "pipefail", "-c", command],
                                cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return result.returncode, result.stdout


def faults_of_block(clone, commands, expected_lines, elsewhere_used):
    """What is wrong with a block, a sentence each."""
    # Where Touchstone's clone is a folder of an engine's.
    commands = [re.sub(r"\btouchstone/(?=touchstone |build/)", "./", c) for c in commands]
    for word, preparation in SUPPOSED.items():
        if any(word in command for command in commands):
            code, printed = clone.run(preparation)
            if code != 0:
                return [f"{preparation}: exit code {code}: {printed[-500:]}"]
    faults, output = [], ""
    for command in commands:
        elsewhere = next((start for start in ELSEWHERE if command.startswith(start)), None)
        built = re.match(r'(?:[A-Z_]+=(?:"[^"]*"|\S+) )*(build/release/\S+)', command)
        if elsewhere:
            elsewhere_used.add(elsewhere)
        elif built:  # a test, which CTest runs, or a benchmark
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


def missing_files(page, files):
    """Targets of links, and names of source files, that do not exist."""
    text = page.read_text()
    for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
        if not (page.parent / link).exists():
            yield link
    for name in re.findall(r"`([\w./-]+\.(?:cpp|hpp|h|c|py|sh|cmake|js|urdf|sdf|in))`", text):
        made_up = "NAME" in name or name in ("my_engine.c", "reproducer.cpp")
        if not made_up and not any(("/" + f).endswith("/" + name) for f in files):
            yield name


def unknown_options(page, program):
    """Options that a page names and no subcommand has."""
    completion = subprocess.run([program, "--completion", "bash"], stdout=subprocess.PIPE,
                                text=True)
    known = {"--oversubscribe", *re.findall(r"--[a-z-]+", completion.stdout)}  # one is Open MPI's
    return sorted(set(re.findall(r"`(--[a-z-]+)", page.read_text())) - known)


def main(source, program):
    files = [str(f.relative_to(source)) for f in source.rglob("*")
             if f.relative_to(source).parts[0] != "build"]
    files += [str(f) for f in program.parent.glob("include/**/*.h")]
    faults, elsewhere_used, job_files = [], set(), 0
    with tempfile.TemporaryDirectory() as scratch:
        for page in [page for pattern in PAGES for page in sorted(source.glob(pattern))]:
            name = page.relative_to(source)
            faults += [f"{name}: there is no {missing}" for missing in missing_files(page, files)]
            faults += [f"{name}: there is no {option}" for option in unknown_options(page, program)]
            new_clone = lambda: Clone(source, program,
                                      pathlib.Path(tempfile.mkdtemp(dir=scratch)) / "clone")
            for _, text in FENCE.findall(page.read_text()):
                if is_job_file(text):
                    faults += [f"{name}: {fault}"
                               for fault in faults_of_job_file(new_clone(), text)]
                    job_files += 1
            for commands, expected_lines in blocks_of(page.read_text()):
                clone = new_clone()
                start = time.monotonic()
                faults += [f"{name}: {fault}" for fault in faults_of_block(
                    clone, commands, expected_lines, elsewhere_used)]
                print(f"{time.monotonic() - start:5.1f} s  {name}: {commands[0]}", flush=True)
    faults += [f"no page has \"{start}\"" for start in ELSEWHERE if start not in elsewhere_used]
    if job_files != 2:
        faults.append(f"the pages have {job_files} job files: one of Slurm and one of Kubernetes")
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    if sys.argv[1] == "--as":
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # which Python ignores
        if sys.argv[3:4] == ["python"]:
            python = "/usr/bin/python3" if os.access("/usr/bin/python3", os.X_OK) else "python3"
            os.environ["PYTHONPATH"] = str(pathlib.Path(sys.argv[2]).parent / "python")
            os.execvp(python, [python, *sys.argv[4:]])
        os.execv(sys.argv[2], [sys.argv[2], *shortened(sys.argv[3:])])
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:3])))
