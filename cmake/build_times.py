#!/usr/bin/env python3
"""Where a build's time went, by Ninja's log: build_times.py [BUILD-FOLDER] [ROWS].

Prints the steps that took longest, in seconds by the clock, and the sum of all. To be compared, builds
start from an empty folder, with nothing else on the machine."""
import pathlib
import sys


def steps(folder):
    """Seconds of each step, of the last time that it ran."""
    found = {}
    for line in (folder / ".ninja_log").read_text().splitlines():
        if not line.startswith("#"):
            start, end, _, output, command = line.split("\t")
            found[start, end, command] = (int(end) - int(start)) / 1000, output
    return sorted(found.values(), reverse=True)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release")
    rows = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    if not (folder / ".ninja_log").exists():
        print(f"{folder} is no folder that Ninja has built in", file=sys.stderr)
        return 2
    all_steps = steps(folder)
    for seconds, output in all_steps[:rows]:
        print(f"{seconds:7.1f} s  {output}")
    print(f"{sum(s for s, _ in all_steps):7.1f} s  all {len(all_steps)} steps")
    return 0


if __name__ == "__main__":
    sys.exit(main())
