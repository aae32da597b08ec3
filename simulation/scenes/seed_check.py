#!/usr/bin/env python3
"""Does `choose` give the same answer with other seeds? seed_check.py PROGRAM SCENE [OPTIONS]

  simulation/scenes/seed_check.py ./touchstone simulation/scenes/rod-on-table.json --seeds 20

The first seed tries every candidate. The others draw other disturbances of the same scene, so they
try again the models that may be the answer: those with a run that gives the solver fewer points or
has cheaper queries, and holds in four of five trials, or misses a limit by less than half of it. An
answer holds in 81 trials; a model that breaks one in five does so once in ten million seeds.
OPTIONS are those of `choose`, such as --drive. With --engine all seeds try every setting:

  simulation/scenes/seed_check.py ./touchstone simulation/scenes/three-logs.json --engine ode

Exit code: 0 the same answer for all seeds; 1 not; 2 `choose` failed or cannot be run.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time


MODELS = {"capsule", "capsule-circumscribed", "spheres", "prism", "box-spheres", "box-capsules"}


def give_up(reason):
    print(reason, file=sys.stderr)
    sys.exit(2)


def choose(program, scene, seed, options, folder):
    command = [program, "choose", scene, "--seed", str(seed), "--out", folder, *options]
    try:
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    except OSError as error:
        give_up(f"{program} cannot be run: {error.strerror}")
    if done.returncode not in (0, 1):
        give_up(done.stderr.strip())
    return json.loads((pathlib.Path(folder) / "choose.json").read_text())


def may_serve(run, exact):
    is_cheaper = (run["points_per_step"] < exact["points_per_step"]
                  or run["microseconds_per_step"] < exact["microseconds_per_step"])
    nearly_holds = run["error"] is not None and run["error"] < 1.5
    return is_cheaper and (run["held"] >= 0.8 * run["trials"] or nearly_holds)


def candidates_that_may_serve(choice):
    exact = choice["runs"][0]
    names = {name for run in choice["runs"] if may_serve(run, exact) for name in run["models"]}
    models = {name for name in names if name.split(":")[0] in MODELS}
    return ",".join(sorted(models | {exact["models"][0]}))


def is_of_engine(choice):
    return choice["schema"] == "touchstone-engine-choice-1"


def answer(choice):
    if is_of_engine(choice):
        return "none" if choice["answer"] is None else choice["settings"][choice["answer"]]["name"]
    if not choice["possible"]:
        return "impossible"
    models = choice["runs"][choice["answer"]]["models"]
    text = ", ".join(f"{kind['name']}: {model}" for kind, model in zip(choice["kinds"], models))
    return "exact" if choice["answer"] == 0 else text


def cost(choice):
    if not is_of_engine(choice):
        return f"{100 * choice['step_saved']:.1f}% of a step"
    if choice["answer"] is None:
        return f"in {choice['engine']['name']}"
    microseconds = choice["settings"][choice["answer"]]["step_microseconds"]
    return f"in {choice['engine']['name']}, {microseconds:.2g} µs a step"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--seeds", type=int, default=20)
    arguments, options = parser.parse_known_args()
    answers = []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(1, arguments.seeds + 1):
            start = time.monotonic()
            choice = choose(arguments.program, arguments.scene, seed, options, folder)
            answers.append(answer(choice))
            print(f"{choice['scene']['name']}, seed {seed}: {answers[-1]} ({cost(choice)}; tried in "
                  f"{time.monotonic() - start:.0f} s)", flush=True)
            if seed == 1 and not is_of_engine(choice):
                options += ["--candidates", candidates_that_may_serve(choice)]
    return 0 if len(set(answers)) == 1 else 1


if __name__ == "__main__":
    sys.exit(main())
