#!/usr/bin/env python3
"""Prints where an engine that agrees with the truth keeps a shorter time than our routines in 95% of
the queries, and of each pair the class where ours take longest:

    ./touchstone report --only scores,timing --candidates reference,bullet,ode,mujoco
    python3 properties/benchmarks/tail_table.py out/report.json

The report asks the candidates in turns. Of its 20 to 100 configurations of a class the 95th
percentile is what the slowest few take, and the clock of some processors advances in steps of 10 ns.
"""
import json
import sys
from collections import defaultdict


def main():
    with open(sys.argv[1]) as file:
        results = json.load(file)["results"]
    classes = defaultdict(dict)
    for result in results:
        times = result["nanoseconds"]
        if times and times["p95"] is not None:
            classes[result["pair"], result["class"]][result["candidate"]] = result
    classes = {name: of for name, of in classes.items() if "reference" in of}

    def p95(result):
        return result["nanoseconds"]["p95"]

    print("slowest class of each pair: p95, median (ns)")
    for pair in dict.fromkeys(pair for pair, _ in classes):
        (_, name), of = max((item for item in classes.items() if item[0][0] == pair),
                            key=lambda item: p95(item[1]["reference"]))
        ours = of["reference"]
        print(f"  {pair}/{name}: {p95(ours):.0f}, {ours['nanoseconds']['median']:.0f}")
    print("an engine that agrees on all of a class is faster at p95 (ns)")
    for (pair, name), of in classes.items():
        for candidate, result in of.items():
            agrees = sum(result["outcomes"].get(o, 0) for o in ("agree", "unseen")) == result["count"]
            if agrees and p95(result) < p95(of["reference"]):
                print(f"  {pair}/{name}: {candidate} {p95(result):.0f}, ours "
                      f"{p95(of['reference']):.0f}")


if __name__ == "__main__":
    main()
