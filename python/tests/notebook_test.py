"""Runs the notebooks of docs/, which must print what they show but for their numbers.

notebook_test.py --write stores what they print.
"""
import contextlib
import io
import json
import os
import pathlib
import re
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"


def run(notebook):
    """Runs the cells one after the other, and puts what they print in place of their outputs."""
    names = {"__name__": "__main__"}
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for number, cell in enumerate(cells, 1):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile("".join(cell["source"]), f"cell {number}", "exec"), names)
        text = printed.getvalue().splitlines(keepends=True)
        cell["execution_count"] = number
        cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": text}] if text else []


def comparable(notebook):
    """Its text without what times change: numbers, the width of columns, and the slow tails, of which a busy
    machine shows some."""
    cells = [dict(cell, outputs="".join("".join(o["text"]) for o in cell.get("outputs", []))) for cell in
             notebook["cells"]]
    text = json.dumps(dict(notebook, cells=cells), indent=1)
    text = re.sub(r"\\nSlow tails: .*?\\n(?=\\n)", "", text)
    return re.sub(r"[-+]?\d[\d.e+-]*", "#", re.sub(" +", " ", text))


def main(write):
    notebooks = sorted(DOCS.glob("*.ipynb"))
    faults = [] if notebooks else ["there is no notebook"]
    for path in notebooks:
        shown = json.loads(path.read_text())
        found = json.loads(path.read_text())
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            run(found)
            if not os.path.exists("out/report.html"):
                faults.append(f"{path.name}: there is no out/report.html")
        if write:
            path.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n")
        elif comparable(found) != comparable(shown):
            faults.append(f"{path.name}: prints {comparable(found)}\ninstead of {comparable(shown)}")
    print(*faults, sep="\n", end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] == ["--write"]))
