#!/usr/bin/env python3
"""Prints the tables of "Speed" in reference/README.md, measured anew; some five minutes:

    python3 properties/benchmarks/speed_table.py build/release/properties/benchmarks/speed_benchmark

Each figure is nanoseconds of processor time per query (of the mixed ones, per pair of poses), the
least of five repetitions in random order.
"""
import json
import subprocess
import sys

BODIES = ["plane", "sphere", "capsule", "cylinder", "box"]
HULLS = ["convex-3", "convex-8", "convex-32", "convex-64"]  # by their vertices
COLUMNS = [
    ("signed_distance", "general+shallow", "`signed_distance` shallow"),
    ("signed_distance", "general+deep", "deep"),
    ("signed_distance", "concentric", "concentric"),
    ("signed_distance", "parallel-side", "parallel sides"),
    ("contact", "general+shallow", "`contact` shallow"),
    ("contact", "apart", "apart by 10%"),
    ("overlaps", "apart", "`overlaps` apart"),
]
# What the sentences below the first table say.
SENTENCES = [
    ("capsule", "parallel-side"),
    ("cylinder", "parallel-side"),
    ("cylinder", "cap-on-cap-offset"),
    ("box", "cap-on-face-offset"),
    ("cylinder", "rim-rim"),
    ("cylinder", "parallel+tilted-1e-6"),
]
QUESTIONS = ["signed_distance", "overlaps", "contact"]
KINDS = [("", ""), (", poses made for each question", "poses_made/"), (", float", "float/")]


def measure(program):
    """Least nanoseconds of each benchmark, by name."""
    output = subprocess.run(
        [program, "--benchmark_format=json", "--benchmark_repetitions=5",
         "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.1"],
        check=True, stdout=subprocess.PIPE).stdout
    least = {}
    for run in json.loads(output)["benchmarks"]:
        if run["run_type"] == "iteration":
            time = run["per_pair"] * 1e9 if "per_pair" in run else run["cpu_time"]
            name = run["run_name"]
            least[name] = min(time, least.get(name, time))
    return least


def print_table(heads, rows):
    for cells in [heads, ["---"] * len(heads), *rows]:
        print("| " + " | ".join(cells) + " |")
    print()


def main():
    least = measure(sys.argv[1])

    def cell(name):
        if name not in least:
            return ""
        return f"{least[name]:.1f}" if least[name] < 9.95 else f"{least[name]:.0f}"

    print_table(["against", *[head for _, _, head in COLUMNS]],
                [[body, *[cell(f"cylinder-{body}/{name}/{question}") for question, name, _ in COLUMNS]]
                 for body in BODIES + HULLS])
    for body, name in SENTENCES:
        contact, distance = [cell(f"cylinder-{body}/{name}/{q}") for q in ("contact", "signed_distance")]
        print(f"{body}, {name}: contact {contact}, signed_distance {distance}")
    print()
    rows = []
    for body in BODIES:
        for words, folder in KINDS:
            names = [f"cylinder-{body}/mixed/{folder}{question}/{how}"
                     for question in QUESTIONS for how in ("single", "batch")]
            rows.append((bool(folder), [body + words, *map(cell, names)]))
    rows.sort(key=lambda row: row[0])  # the plain ones first
    heads = ["against"]
    for question in QUESTIONS:
        heads += [f"`{question}` one by one", "batch"]
    print_table(heads, [row for _, row in rows])


if __name__ == "__main__":
    main()
