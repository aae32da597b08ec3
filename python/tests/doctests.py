"""Runs the examples of docs/your-poses.md, and those in the module's docstrings, which other test runners
do not find."""
import doctest
import pathlib
import re
import sys

import numpy
import touchstone


PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "your-poses.md"


def docstrings():
    """Names and texts: of the module, of all that it exports, and of their members."""
    yield "touchstone", touchstone.__doc__
    for name in touchstone.__all__:
        exported = getattr(touchstone, name)
        yield name, exported.__doc__
        if isinstance(exported, type):
            for member, value in vars(exported).items():
                if not member.startswith("_"):
                    yield f"{name}.{member}", value.__doc__


def main():
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner()
    faults = []
    for name, text in docstrings():
        if not text:
            faults.append(f"{name} has no docstring")
            continue
        names = {"touchstone": touchstone, "numpy": numpy}
        runner.run(parser.get_doctest(text, names, name, None, 0))
    examples = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    runner.run(parser.get_doctest("\n".join(examples), {}, PAGE.name, None, 0))
    print(*faults, sep="\n", end="\n" if faults else "")
    return 1 if faults or runner.summarize().failed or runner.tries < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
