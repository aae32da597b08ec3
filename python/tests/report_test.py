"""Reports on Python functions: good ones, and those that raise, hang and return nonsense."""
import json
import math
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import touchstone
from touchstone import Contact

ONE_CLASS = {"pairs": ["cylinder-plane"], "classes": ["lying"], "count": 4}
ours = touchstone.contact


def report(function, **more):
    return touchstone.report(function, "mine", **{**ONE_CLASS, "candidates": [], **more}).to_dict()


def outcomes(function, **more):
    [row] = report(function, **more)["results"]
    return row["outcomes"]


def reasons(found):
    return {answer["reason"] for case in found["worst"]
            for answer in case["answers"].values() if "reason" in answer}


class Reports(unittest.TestCase):
    def test_our_own_contact_has_the_scores_of_the_native_one(self):
        found = touchstone.report(ours, "mine", count=1, groups=["everyday"]).to_dict()
        rows = {}
        for row in found["results"]:
            row = {key: row[key] for key in ("pair", "class", "candidate", "outcomes", "points",
                                             "depth_error", "normal_regret", "coverage")}
            rows.setdefault(row.pop("candidate"), []).append(row)
        self.assertEqual({row["pair"] for row in rows["mine"]}, set(touchstone.PAIRS))
        self.assertEqual(rows["mine"], rows["reference"])

    def test_a_function_is_marked_as_script_and_timed(self):
        found = report(ours)
        [candidate] = found["candidates"]
        self.assertEqual((candidate["name"], candidate["runs"]), ("mine", "script"))
        self.assertGreater(found["results"][0]["nanoseconds"]["median"], 100)

    def test_the_time_is_that_of_the_function(self):
        taken = []  # in nanoseconds, as the function itself measures them

        def slow(*question):
            start = time.perf_counter_ns()
            while time.perf_counter_ns() < start + 2_000_000:
                pass
            answer = ours(*question)
            taken.append(time.perf_counter_ns() - start)
            return answer

        nanoseconds = report(slow)["results"][0]["nanoseconds"]["median"]
        self.assertTrue(min(taken) / 2 < nanoseconds < 2 * max(taken), nanoseconds)

    def test_the_number_of_workers_does_not_change_the_scores(self):
        few, many = (report(ours, classes=["lying", "standing"], workers=n) for n in (1, 3))
        for row in few["results"] + many["results"]:
            del row["nanoseconds"]
        self.assertEqual(few["results"], many["results"])

    def test_saved_it_is_what_the_dict_has(self):
        result = touchstone.report(ours, "mine", **ONE_CLASS)
        with tempfile.TemporaryDirectory() as folder:
            result.save(folder + "/new")
            result.save(pathlib.Path(folder, "new"))
            with self.assertRaisesRegex(TypeError, "^folder is 7: must be a str or a path$"):
                result.save(7)
            saved = json.loads(pathlib.Path(folder, "new", "report.json").read_text())
            self.assertIn("<html", pathlib.Path(folder, "new", "report.html").read_text())
        self.assertEqual(saved, result.to_dict())
        self.assertIn("mine", str(result))
        with self.assertRaisesRegex(ValueError, "folder is .*: "):
            result.save("/proc/nowhere")

    def test_the_function_gets_the_threshold(self):
        def far(a, pose_a, b, pose_b, threshold):
            assert threshold == 0.5
            return ours(a, pose_a, b, pose_b, threshold)

        self.assertEqual(outcomes(far, threshold=0.5), {"agree": 4})

    def test_a_pair_named_twice_is_scored_once(self):
        self.assertEqual(outcomes(ours, pairs=["cylinder-plane"] * 2), {"agree": 4})

    def test_the_call_is_recorded(self):
        self.assertIn("touchstone.report(mine, pairs=['cylinder-plane'], classes=['lying'], ",
                      report(ours)["command"])


class BadFunctions(unittest.TestCase):
    def test_what_it_does_instead_of_answering_is_told(self):
        class Mute(Exception):
            def __str__(self):
                raise RuntimeError

        def raising(error):
            def function(*_):
                raise error
            return function

        def returning(value):
            return lambda *_: value

        no_answer = "returned {}: must be touchstone.Contact, None or NotImplemented"
        for function, outcome, told in (
                (raising(ArithmeticError("the simplex <degenerates>")), "failed",
                 {"raised ArithmeticError: the simplex <degenerates>"}),
                (raising(Mute), "failed", {"raised Mute"}),
                (raising(SystemExit("done")), "failed", {"raised SystemExit: done"}),
                (returning("a"), "failed", {no_answer.format("str")}),
                (returning(0.5), "failed", {no_answer.format("float")}),
                (returning((1, 2)), "failed", {no_answer.format("tuple")}),
                (returning(Contact), "failed", {no_answer.format("pybind11_type")}),
                (returning(Contact(math.nan, (0, 0, 1))), "not-finite", set()),
                (returning(NotImplemented), "unsupported", set())):
            with self.subTest(outcome=outcome, told=told):
                found = report(function)
                self.assertEqual(found["results"][0]["outcomes"], {outcome: 4})
                self.assertEqual(reasons(found), told)

    def test_one_that_raises_now_and_then_fails_then(self):
        calls = []

        def sometimes(*question):
            calls.append(1)
            if len(calls) % 2 == 0:
                raise KeyError
            return ours(*question)

        self.assertEqual(outcomes(sometimes, workers=1), {"agree": 2, "failed": 2})

    def test_one_with_other_parameters_fails(self):
        self.assertIn("raised TypeError: ", reasons(report(lambda a, b: None)).pop())

    def test_one_that_takes_too_long_is_ended(self):
        def computing(*_):
            while True:
                pass

        def waiting(*_):
            time.sleep(1000)

        def stubborn(*_):
            for _ in range(3):
                try:
                    time.sleep(1000)
                except BaseException:
                    pass
            time.sleep(1000)

        for function in (computing, waiting, stubborn):
            found = report(function, seconds=0.05, count=2)
            self.assertEqual(found["results"][0]["outcomes"], {"timed-out": 2})
            self.assertEqual(reasons(found), {"no answer within 0.05 s"})
            self.assertIsNone(found["results"][0]["nanoseconds"])

    def test_alarms_are_as_they_were_before(self):
        def handler(*_):
            pass

        before = signal.signal(signal.SIGALRM, handler)
        report(ours)
        self.assertIs(signal.signal(signal.SIGALRM, before), handler)
        self.assertEqual(signal.getitimer(signal.ITIMER_REAL), (0, 0))

    def test_one_that_ends_its_process_ends_the_report_by_name(self):
        with self.assertRaisesRegex(RuntimeError, "cylinder-plane/lying/1/0: .*exit code 3"):
            report(lambda *_: os._exit(3))


class Calls(unittest.TestCase):
    def test_bad_arguments_are_refused(self):
        for more, text in [({"classes": ["lyng"]}, "classes is .*lyng"),
                           ({"pairs": ["cylinder-cone"]}, "pairs is .*cylinder-cone"),
                           ({"groups": ["daily"]}, "groups is .*daily"),
                           ({"groups": ["extreme"]}, "groups is .*extreme.* which are degenerate"),
                           ({"candidates": ["bulet"]}, "candidates is .*bulet.* must be one of"),
                           ({"count": 0}, "count is 0: must be at least 1"),
                           ({"tolerance": 0}, "tolerance is 0: must be positive"),
                           ({"seconds": math.nan}, "seconds is nan: must be positive"),
                           ({"threshold": -1}, "threshold is -1")]:
            with self.assertRaisesRegex(ValueError, text):
                report(ours, **more)
        for name in ("", "a b", "a:1", "ä", "../a", "-a"):
            with self.assertRaisesRegex(ValueError, "name is .*: must be up to 63 characters of printable ASCII"):
                touchstone.report(ours, name, **ONE_CLASS)
        with self.assertRaisesRegex(ValueError, "name is \"reference\": must not be that of ano"):
            touchstone.report(ours, "reference", **ONE_CLASS)
        with self.assertRaises(TypeError):
            touchstone.report("ours")

    def test_another_thread_may_report(self):
        found = []
        thread = threading.Thread(target=lambda: found.append(outcomes(ours)))
        thread.start()
        thread.join()
        self.assertEqual(found, [{"agree": 4}])

    def test_an_interrupt_ends_it(self):
        this = os.getpid()

        def interrupting(*_):
            os.kill(this, signal.SIGINT)
            time.sleep(1000)

        with self.assertRaises(KeyboardInterrupt):
            report(interrupting, workers=1)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        def slow_here(*asked):  # in this process, where it is timed
            if os.getpid() == this:
                os.kill(this, signal.SIGINT)
                time.sleep(1000)
            return ours(*asked)

        start = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            report(slow_here, workers=1, seconds=1e6)
        self.assertLess(time.monotonic() - start, 900)  # it neither slept to its end nor to its limit
        with self.assertRaises(KeyboardInterrupt):  # Python's own handler is back
            os.kill(this, signal.SIGINT)
            time.sleep(10)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which a shell's job in the background ignores
    unittest.main()
