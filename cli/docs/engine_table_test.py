#!/usr/bin/env python3
"""The table of engines in a page is that of a fresh report, but for times: engine_table_test.py PROGRAM PAGE

The command is the one that stands above the table."""
import difflib
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile


def table_in(text):
    """Its lines, without what stands last in a cell: the time."""
    lines = re.findall(r"^\|.*\|$", text.partition("\n## ")[0], re.MULTILINE)
    return [re.sub(r"<br>[0-9]+(?=\|)", "", line) for line in lines if "<br>" in line]


def main(program, page):
    text = pathlib.Path(page).read_text()
    command = re.search(r"`\./touchstone (report [^`]*--only scores,timing)`", text)[1]
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "table.md"
        words = shlex.split(command.replace("scores,timing", "scores"))
        subprocess.run([program, *words, "--out", folder, "--table", table], check=True, stdout=subprocess.DEVNULL)
        # No time is "-".
        fresh = table_in(table.read_text().replace("<br>-|", "|"))
    differences = list(difflib.unified_diff(table_in(text), fresh, page, "a fresh report", lineterm=""))
    print("\n".join(differences))
    return 1 if differences or not fresh else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
