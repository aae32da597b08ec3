#!/usr/bin/env python3
"""A badge from a report, as shields.io reads it: badge.py REPORT.json CANDIDATE > badge.json

It says how many poses of the report's first group the candidate answers right, cut downwards so that
only a candidate without a failure has 100.0%. SPDX-License-Identifier: CC0-1.0"""
import json
import math
import sys


def badge(report, candidate):
    rows = [row for row in report["summary"] if row["candidate"] == candidate]
    if not rows:
        known = ", ".join(c["name"] for c in report["candidates"])
        raise ValueError(f'CANDIDATE: "{candidate}" is not in this report: must be one of {known}')
    row = next(row for row in rows if row["pair"] == rows[-1]["pair"])  # the last is over all pairs
    right = row["outcomes"].get("agree", 0) + row["outcomes"].get("unseen", 0)
    share = right / max(1, row["count"] - row["outcomes"].get("unsupported", 0))
    return {"schemaVersion": 1, "label": "cylinder contacts",
            "message": f"{math.floor(1000 * share) / 10:.1f}% of {row['class']} poses right",
            "color": "brightgreen" if share == 1 else "yellow" if share >= 0.9 else "red"}


if __name__ == "__main__":
    try:
        with open(sys.argv[1]) as file:
            print(json.dumps(badge(json.load(file), sys.argv[2])))
    except (IndexError, OSError, ValueError) as error:
        sys.exit(print(f"badge.py: {error}; usage: badge.py REPORT.json CANDIDATE", file=sys.stderr) or 2)
