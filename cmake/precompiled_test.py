#!/usr/bin/env python3
"""precompiled_test.py COMPILE_COMMANDS.JSON: no source has options of code generation that differ from
those of the precompiled header that it includes, for g++ forgets the source's own without a word."""
import json
import pathlib
import re
import sys


def options(command):
    """Options of code generation, in their order: a later one overrides an earlier one, and one that
    is said twice (-fPIC, of a module) is the same."""
    given = re.findall(r" (-(?:O|f|m)\S*)", command)
    return [option for option, before in zip(given, [None, *given]) if option != before]


def precompiled(command):
    """The header that it includes or makes; None without one."""
    found = re.search(r"\S+/cmake_pch\.hxx\b", command)
    return found and found[0]


def main():
    commands = [entry["command"] for entry in json.loads(pathlib.Path(sys.argv[1]).read_text())]
    made = {precompiled(c): options(c) for c in commands if " -x c++-header " in c}
    users = [c for c in commands if precompiled(c) and precompiled(c) in made and " -x c++-header " not in c]
    if not users:
        print("no source includes a precompiled header: has CMake another way to say it?", file=sys.stderr)
        return 1
    different = [c for c in users if options(c) != made[precompiled(c)]]
    for command in different:
        print(f"{command}\n  does not have the options {made[precompiled(command)]} of its header",
              file=sys.stderr)
    return 1 if different else 0


sys.exit(main())
