#!/usr/bin/env python3
"""Ends the program as a person does, on a terminal: interruption_test.py PROGRAM."""
import json
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time

PATIENCE = 1200  # seconds: ends a hang, on a machine however slow and busy


def listed_classes(program):
    """The number of pose classes of a report, by the list of pose classes."""
    text = subprocess.run([program, "list", "classes"], check=True, capture_output=True,
                          text=True).stdout
    return sum(int(n) for n in re.findall(r"A report scores (\d+) classes", text))


def timed_classes(report):
    """How many of a whole report's classes are timed, as reports/timing.hpp says."""
    def is_timed(c):
        modifiers = c["modifiers"]
        if c["group"] in ("everyday", "recorded") or not modifiers:
            return True
        tilts = ("tilted-1e-1", "tilted-1e-6", "tilted-1e-12")
        return (c["arrangement"] in ("general", "parallel", "perpendicular") and len(modifiers) == 1
                and (not modifiers[0].startswith("tilted") or modifiers[0] in tilts))
    return sum(is_timed(c) for c in report["classes"])


def planned_count(row, of_class):
    """As many configurations as the documentation promises for a class at the usual --count."""
    usual, everyday_times = 20, 5
    is_everyday = of_class["group"] in ("everyday", "recorded") or of_class["modifiers"] == ["aligned"]
    return usual * (everyday_times if is_everyday else 1)


def on_terminal(command):
    """Its process and terminal."""
    pid, terminal = pty.fork()
    if pid == 0:
        # Which a shell's job in the background ignores, and all that it starts.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.execv(command[0], command)
    return pid, terminal


class Run:
    """`touchstone report` on a terminal of its own."""

    def __init__(self, program, folder, *options):
        self.folder = folder
        self.printed = ""
        self.pid, self.terminal = on_terminal(
            [program, "report", "--out", folder, "--candidates", "reference,bullet", *options])

    def read(self):
        try:
            part = os.read(self.terminal, 4096).decode(errors="replace")
        except OSError:  # the terminal is gone
            part = ""
        self.printed += part
        return part

    def wait_for(self, pattern):
        end = time.time() + PATIENCE
        while not (found := re.search(pattern, self.printed)):
            assert self.read(), f"ended before it printed {pattern}: {self.printed}"
            assert time.time() < end, f"no {pattern} in {self.printed}"
        return found

    def ctrl_c(self):
        os.write(self.terminal, b"\x03")  # a signal for all of the terminal's processes

    def end(self):
        """Its wait status, when nothing of it is left."""
        while self.read():
            pass
        _, status = os.waitpid(self.pid, 0)
        end = time.time() + PATIENCE
        while left := processes_of_session(self.pid):
            assert time.time() < end, f"orphans: {left}"
            time.sleep(0.05)
        return status

    def report(self):
        with open(f"{self.folder}/report.json") as file:
            return json.load(file)


def processes_of_session(session):
    found = []
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat") as file:
                state, _, _, its_session = file.read().rsplit(")", 1)[1].split()[:4]
        except OSError:  # it has just ended
            continue
        if int(its_session) == session and state != "Z":
            found.append(int(entry))
    return found


def ctrl_c_while_scoring(program, folder):
    run = Run(program, folder)
    progress = run.wait_for(r"\d%, .* left: [1-9]\d* of (\d+) configurations")
    assert len(processes_of_session(run.pid)) > 3  # workers, and engines in processes of their own
    run.ctrl_c()
    status = run.end()
    assert os.WEXITSTATUS(status) == 130, status
    report = run.report()
    done, planned = report["completed"], report["planned"]
    assert report["partial"] is True
    assert 0 < done["classes"] < planned["classes"] == listed_classes(program), done
    assert done["configurations"] < planned["configurations"] == int(progress[1]), done
    of_class = {(c["pair"], c["class"]): c for c in report["classes"]}
    for row in report["results"]:  # no class is there in part
        assert row["count"] == planned_count(row, of_class[row["pair"], row["class"]]), row
    rows = [row for row in report["results"] if row["candidate"] == "bullet"]
    assert report["configurations"] == done["configurations"] == sum(r["count"] for r in rows)
    assert len(rows) == done["classes"] and len(report["results"]) == 2 * done["classes"]
    assert "PARTIAL" in run.printed and "once more" in run.printed
    assert os.path.exists(f"{folder}/report.html")


def termination_while_timing(program, folder):
    run = Run(program, folder, "--count", "1")
    progress = run.wait_for(r"(?<!\d)[1-9]\d* of (\d+) pose classes timed")
    os.kill(run.pid, signal.SIGTERM)
    status = run.end()
    assert os.WEXITSTATUS(status) == 143, status
    report = run.report()
    assert report["partial"] is True
    assert report["completed"]["classes"] == listed_classes(program)
    assert 0 < report["completed"]["timed_classes"] < int(progress[1]) == timed_classes(report)


def closed_terminal(program, folder):
    """Of which the system tells by SIGHUP: what was done is kept, and nothing goes on unseen."""
    run = Run(program, folder)
    run.wait_for(r"\d%, .* left: [1-9]\d* of (\d+) configurations")
    os.close(run.terminal)
    run.end()
    report = run.report()
    assert report["partial"] is True
    assert 0 < report["completed"]["classes"] < report["planned"]["classes"], report["completed"]
    assert os.path.exists(f"{folder}/report.html")


def ctrl_c_after_timing(program, folder):
    run = Run(program, folder, "--count", "1")
    run.wait_for(r"of \d+ poses")  # of the study of stability, which comes after timing
    run.ctrl_c()
    status = run.end()
    assert os.WEXITSTATUS(status) == 130, status
    report = run.report()
    assert report["partial"] is True
    assert report["completed"]["classes"] == report["planned"]["classes"] == listed_classes(program)
    assert report["completed"]["timed_classes"] == timed_classes(report)
    assert report.get("experiments") is None and report.get("engines") is None
    assert "PARTIAL" in run.printed


def status_of(pid, member):
    with open(f"/proc/{pid}/status") as file:
        return re.search(rf"^{member}:\s*(\S+)", file.read(), re.MULTILINE)[1]


def ctrl_c_twice(program, folder):
    run = Run(program, folder, "--count", "5000")
    run.wait_for(r"[1-9]\d* of \d{7,} configurations")
    # Stopped, or it might end in order between the two.
    os.kill(run.pid, signal.SIGSTOP)
    while status_of(run.pid, "State") != "T":
        time.sleep(0.01)
    run.ctrl_c()
    while not int(status_of(run.pid, "ShdPnd"), 16) >> (signal.SIGINT - 1) & 1:
        time.sleep(0.01)
    os.kill(run.pid, signal.SIGTERM)  # a second Ctrl-C at once would be the same request
    os.kill(run.pid, signal.SIGCONT)
    status = run.end()
    # The system tells of whichever it likes first.
    assert os.WIFSIGNALED(status) and os.WTERMSIG(status) in (signal.SIGINT, signal.SIGTERM), status
    assert "once more" in run.printed, run.printed
    assert not os.path.exists(f"{folder}/report.json")


def ctrl_c_where_nothing_is_kept(program, _):
    run = Run.__new__(Run)
    run.printed = ""
    run.pid, run.terminal = on_terminal(
        [program, "check", "--candidate", "reference", "--count", "5000"])
    run.wait_for(r"of \d{7,} configurations")
    run.ctrl_c()
    status = run.end()
    assert os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGINT, status
    assert run.printed.count("touchstone: interrupted; only what was written before is kept") == 1, run.printed


def killed_while_it_has_a_folder(program, folder):
    """Nobody else writes there meanwhile, and nothing is left of it afterwards."""
    run = Run(program, folder)
    run.wait_for(r"\d%, .* left: [1-9]\d* of (\d+) configurations")
    for command in (["report"], ["stability"], ["campaign", "--count", "1"]):
        second = subprocess.run([program, *command, "--out", folder], capture_output=True, text=True)
        assert second.returncode == 2, second
        assert f'--out is "{folder}": must be a folder that no other run' in second.stderr, second
        assert "name another folder by --out" in second.stderr, second
    os.kill(run.pid, signal.SIGKILL)
    run.end()
    assert not os.listdir(folder), os.listdir(folder)
    subprocess.run([program, "report", "--class", "rim-face", "--count", "1", "--only", "scores",
                    "--candidates", "reference", "--out", folder], check=True, capture_output=True)
    assert sorted(os.listdir(folder)) == ["report.html", "report.json"], os.listdir(folder)


for case in (ctrl_c_where_nothing_is_kept, ctrl_c_while_scoring, termination_while_timing, ctrl_c_after_timing,
             ctrl_c_twice, closed_terminal, killed_while_it_has_a_folder):
    with tempfile.TemporaryDirectory() as folder:
        case(sys.argv[1], folder)
        print("passed:", case.__name__, flush=True)
