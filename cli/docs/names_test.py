#!/usr/bin/env python3
"""What the pages name is there: names_test.py SOURCE-FOLDER PROGRAM PAGE…

Links, names of source files, options and commands must exist, and numbers of configurations must be
the defaults; what runs elsewhere must be on a page.
"""
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
from pages import ELSEWHERE, blocks_of, elsewhere_of, job_files_of  # noqa: E402


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


def known_options(program):
    """Those of all subcommands, also those that --help hides, and one of Open MPI's."""
    completion = subprocess.run([program, "--completion", "bash"], stdout=subprocess.PIPE,
                                text=True, check=True)
    hidden = {"--cells", "--checkpoint", "--hostile", "--memory-limit", "--of-version"}
    return {"--oversubscribe", *hidden, *re.findall(r"--[a-z-]+", completion.stdout)}


def wrong_counts(text, program):
    """Of configurations, where a page says how many a command takes of each class."""
    paragraphs = " ".join(p for p in re.split(r"\n\n", text) if "of each class" in p)
    said = re.findall(r"`(report|check|campaign)` (?:takes |scores )?([\d,]*\d)\b",
                      " ".join(paragraphs.split()))
    for command, number in said:
        told = subprocess.run([program, command, "--help"], stdout=subprocess.PIPE, text=True,
                              check=True).stdout
        usual = re.search(r"--count UINT=(\d+)", told)[1]
        if number.replace(",", "") != usual:
            yield f"`{command}` takes {usual} configurations of each class, not {number}"


def commands_without_help(text, program):
    """Of the commands in a table of them, unless the page says that they are the clone's alone."""
    rows = re.findall(r"^\| ((?:`[a-z]+`(?:, )?)+) \|", text, re.MULTILINE)
    for command in re.findall(r"`([a-z]+)`", " ".join(rows)):
        if re.search(rf"`{command}` is of a clone's `./touchstone` alone", " ".join(text.split())):
            continue
        if subprocess.run([program, command, "--help"], capture_output=True).returncode != 0:
            yield f"`{command} --help` is refused"


def main(source, program, *pages):
    files = [str(f.relative_to(source)) for f in source.rglob("*")
             if f.relative_to(source).parts[0] != "build"]
    files += [str(f) for f in program.parent.glob("include/**/*.h")]
    options = known_options(program)
    faults, commands, job_files = [], [], 0
    for page in pages:
        name, text = page.relative_to(source), page.read_text()
        faults += [f"{name}: there is no {missing}" for missing in missing_files(page, files)]
        faults += [f"{name}: there is no {option}"
                   for option in sorted(set(re.findall(r"`(--[a-z-]+)", text)) - options)]
        faults += [f"{name}: {fault}" for fault in wrong_counts(text, program)]
        if "| command | does |" in text:
            faults += [f"{name}: {fault}" for fault in commands_without_help(text, program)]
        commands += [c for block, _ in blocks_of(text) for c in block]
        job_files += len(job_files_of(text))
    faults += [f"no page has \"{start}\""
               for start in ELSEWHERE.keys() - set(map(elsewhere_of, commands))]
    if job_files != 2:
        faults.append(f"the pages have {job_files} job files: one of Slurm and one of Kubernetes")
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:])))
