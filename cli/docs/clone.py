#!/usr/bin/env python3
"""A folder that looks like a clone after its build: its ./touchstone does what it is asked, in small.

clone.py PROGRAM ARGUMENTS… is that ./touchstone.
"""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys

# Options of the subcommands that take long; one that the page gives itself stays, but
# for --count and --disturbances, which become small.
SHORTER = {
    "report": {"--pair": "cylinder-plane", "--class": "lying", "--count": "1",
               "--candidates": "reference,bullet", "--workers": "1"},
    "check": {"--law": "agreement", "--pair": "cylinder-plane", "--count": "1"},
    "campaign": {"--pair": "cylinder-plane", "--class": "lying", "--count": "1600",
                 "--candidates": "reference"},
    "stability": {"--part": "amplification", "--count": "1", "--candidates": "reference"},
    "simulate": {"--step": "0.016", "--candidates": "reference", "--duration": "0.1",
                 "--every": "1"},
    "export": {"--count": "1"},
    "choose": {"--candidates": "capsule", "--disturbances": "1", "--duration": "0.1"},
}
REPLACED = {"--count", "--disturbances"}
SCENE_LASTS = 0.2  # seconds, of all scenes in the clone

ROBOTS = (".urdf", ".sdf", ".xml")


def has_no_place(option, arguments):
    """Would this option be refused, or leave nothing to do, beside those?"""
    of_robot = any(a.endswith(ROBOTS) for a in arguments)
    of_scene = of_robot or any(a.endswith(".json") for a in arguments)
    of_samples = any(a in arguments for a in ("--depth", "--angle", "--count"))
    of_file = "--configurations" in arguments
    return {"--class": of_file or "--group" in arguments,  # which may have no such class
            "--pair": of_file,
            "--count": of_file or "--as" in arguments,
            "--candidates": any(a in arguments for a in ("--engine", "--povray", "--record")),
            "--law": "--search" in arguments,
            "--every": "--povray" not in arguments,
            "--step": of_scene or "--engine" in arguments,
            "--duration": not of_robot or of_samples,
            "--disturbances": of_samples}.get(option, False)


def shortened(arguments):
    """The arguments that the program is given in place of a page's."""
    command = next((a for a in arguments if a in SHORTER), None)
    if command is None or "--help" in arguments or "--merge" in arguments:
        return arguments
    for option, value in SHORTER[command].items():
        if option not in arguments:
            if not has_no_place(option, arguments):
                arguments = [*arguments, option, value]
        elif option in REPLACED:
            arguments[arguments.index(option) + 1] = value
    return arguments


def brief(scene):
    """The beginning of a scene, without the needs of what comes later."""
    needs = [need for need in scene["needs"]
             if all(need.get(time, 0) <= SCENE_LASTS for time in ("from", "until", "by"))]
    return {**scene, "duration": SCENE_LASTS, "needs": needs}


class Clone:
    """Of a source folder and its built program."""

    def __init__(self, source, program, folder):
        self.folder = folder
        scenes = folder / "simulation" / "scenes"
        scenes.mkdir(parents=True)
        for part in (source, source / "simulation", source / "simulation" / "scenes"):
            for entry in part.iterdir():
                here = folder / entry.relative_to(source)
                if entry.name not in ("touchstone", "build", "out", ".git") and not here.exists():
                    here.symlink_to(entry)
        for file in scenes.glob("*.json"):
            scene = brief(json.loads(file.read_text()))
            file.unlink()
            file.write_text(json.dumps(scene))
        (folder / "build").mkdir()
        (folder / "build" / "release").symlink_to(program.parent)
        script = folder / "touchstone"
        this = pathlib.Path(__file__).resolve()
        script.write_text(f'#!/bin/sh\nexec "{sys.executable}" "{this}" "{program}" "$@"\n')
        script.chmod(0o755)
        (folder / "python3").symlink_to(sys.executable)

    def run(self, command, of_job=None):
        """Exit code and what was printed. `of_job`: more of the environment."""
        command = re.sub(r"^mpirun -n \d+", "mpirun --oversubscribe -n 2", command)
        environment = dict(os.environ, PATH=f"{self.folder}:{os.environ['PATH']}",
                           CPATH="build/release/include",  # as if it were installed
                           OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           **(of_job or {}))
        result = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=self.folder,
                                env=environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return result.returncode, result.stdout


def main(program, *arguments):
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # which Python ignores
    if arguments[:1] == ("python",):
        os.environ["PYTHONPATH"] = str(pathlib.Path(program).parent / "python")
        os.execv(sys.executable, [sys.executable, *arguments[1:]])
    os.execv(program, [program, *shortened(list(arguments))])


if __name__ == "__main__":
    main(*sys.argv[1:])
