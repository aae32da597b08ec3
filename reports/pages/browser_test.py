#!/usr/bin/python3
"""Opens a report in Chromium as a reader does: browser_test.py PROGRAM.

Exit code 77, which CTest counts as skipped, when there is no browser to drive."""
import json
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

skipped = 77
try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.select import Select
except ImportError:
    print("skipped: no python3-selenium (packages-test.txt)")
    sys.exit(skipped)
missing = [tool for tool in ("chromium", "chromedriver") if shutil.which(tool) is None]
if missing:
    print(f"skipped: no {' and no '.join(missing)} (packages-test.txt)")
    sys.exit(skipped)

program = sys.argv.pop(1)
most_bytes = 5_000_000


def browser(width, height):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
    return driver


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        # Every candidate and class, so that the page is as large as it gets.
        subprocess.run([program, "report", "--count", "1", "--out", cls.folder.name], check=True,
                       capture_output=True)
        cls.page = Path(cls.folder.name) / "report.html"
        cls.driver = browser(1280, 900)
        cls.requested = cls.load()

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.folder.cleanup()

    @classmethod
    def load(cls):
        """The addresses that loading the page asks for, itself excepted."""
        cls.driver.get_log("performance")  # of pages before
        cls.driver.get(cls.page.as_uri())
        time.sleep(0.5)
        events = [json.loads(e["message"])["message"] for e in cls.driver.get_log("performance")]
        urls = [e["params"]["request"]["url"] for e in events
                if e["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if url != cls.page.as_uri()]

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def choose(self, selector, value):
        Select(self.find(selector)).select_by_value(value)

    def hover(self, element):
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
        ActionChains(self.driver).move_to_element(element).perform()
        return self.find("#tooltip")

    def console(self):
        return [e for e in self.driver.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]

    def test_1_loads_without_error_or_request(self):
        self.assertEqual(self.console(), [])
        self.assertEqual(self.requested, [])

    def test_2_is_small(self):
        self.assertLess(self.page.stat().st_size, most_bytes)

    def test_charts_are_drawn(self):
        self.assertEqual(len(self.all("#chart-panels svg")), 6)
        for chart in ("#distribution-cumulative", "#distribution-histogram", "#trend-chart"):
            self.assertGreater(len(self.all(f"{chart} svg path")), 3, chart)

    def test_a_mark_tells_its_numbers_and_leads_to_its_worst_cases(self):
        mark = next(m for m in self.all("#chart-panels figure:last-child .mark-symbol path")
                    if m.get_attribute("aria-label").startswith("bullet-margin-0,"))
        tip = self.hover(mark)
        self.assertTrue(tip.is_displayed())
        self.assertIn("bullet-margin-0, cylinder–plane", tip.text)
        self.assertIn("ns per query", tip.text)
        mark.click()
        self.assertEqual(self.find("#worst-candidate").get_attribute("value"), "bullet-margin-0")
        self.assertEqual(self.find("#worst-pair").get_attribute("value"), "cylinder-plane")
        self.assertIn("replay cylinder-plane/", self.find("#worst-cases .command code").text)

    def test_labels_do_not_lie_on_each_other(self):
        for panel in self.all("#chart-panels figure"):
            boxes = self.driver.execute_script(
                """return [...arguments[0].querySelectorAll('.role-mark text')]
                   .filter(t => t.textContent && getComputedStyle(t).opacity > 0.5)
                   .map(t => t.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom])""",
                panel)
            self.assertGreater(len(boxes), 3)
            for i, a in enumerate(boxes):
                for b in boxes[:i]:
                    # A box of text is higher than its letters.
                    apart = (a[0] >= b[2] or b[0] >= a[2] or a[1] + 3 >= b[3] or b[1] + 3 >= a[3])
                    self.assertTrue(apart, (a, b))

    def test_the_findings_answer_for_a_pair_and_a_candidate(self):
        box = next(li.text for li in self.all("#finding-accuracy li") if "cylinder–box" in li.text)
        self.assertIn("reference (agrees on 100%", box)
        self.assertRegex(self.find("#finding-cost").text, r"takes \d+ ns")
        self.choose("#finding-candidate", "ode")
        failures = self.find("#finding-failures")
        self.assertIn("pose classes, most in", failures.text)
        failures.find_element(By.CSS_SELECTOR, "li:last-child button").click()
        self.assertEqual(self.find("#worst-candidate").get_attribute("value"), "ode")

    def test_the_controls_change_what_is_shown(self):
        for control, value, place in (
                ("#summary-pair", "cylinder-box", "#summary-table"),
                ("#distribution-pair", "cylinder-box", "#distribution-cumulative"),
                ("#trend-variable", "depth", "#trend-chart"),
                ("#class-candidate", "fcl", "#class-table"),
                ("#experiment-name", "rolling", "#experiment-table"),
                ("#class-quantity", "worst", "#class-table"),
                ("#manifold-candidate", "ode", "#manifold-table"),
                ("#outcome-pair", "cylinder-box", "#outcome-bars")):
            before = self.find(place).get_attribute("innerHTML")
            self.choose(control, value)
            self.assertNotEqual(self.find(place).get_attribute("innerHTML"), before, control)
        lines = len(self.all("#trend-chart .mark-line path"))
        self.find("#trend-legend .toggle[aria-pressed=true]").click()
        self.assertEqual(len(self.all("#trend-chart .mark-line path")), lines - 1)

    def test_a_worst_case_is_drawn_and_turns(self):
        canvas = self.find("#worst-cases canvas")
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
        time.sleep(0.3)
        picture = "return arguments[0].toDataURL()"
        before = self.driver.execute_script(picture, canvas)
        blank = self.driver.execute_script(
            "const c = document.createElement('canvas'); c.width = arguments[0].width; "
            "c.height = arguments[0].height; return c.toDataURL()", canvas)
        self.assertNotEqual(before, blank)
        ActionChains(self.driver).drag_and_drop_by_offset(canvas, 40, 10).perform()
        self.assertNotEqual(self.driver.execute_script(picture, canvas), before)

    def test_drakes_own_numbers_stand_beside_ours(self):
        rows = [row.text for row in self.all("#drake-table tbody tr")]
        self.assertIn("Drake, point pair 4.0e-12 5.0e-12 4.0e-2 2.0 1.0", rows[0])
        self.hover(self.all("#drake-table tbody tr:nth-child(4) td")[-1]).is_displayed()
        self.all("#drake-table tbody tr:nth-child(4) td")[-1].click()
        self.assertIn("./touchstone replay -", self.find("#drake-command code").text)

    def test_y_a_page_without_contacts_or_times_loads_too(self):
        small = Path(self.folder.name) / "small"
        subprocess.run([program, "report", "--count", "1", "--pair", "cylinder-plane", "--class",
                        "standing", "--candidates", "fcl-distance", "--out", small], check=True,
                       capture_output=True)
        self.driver.get((small / "report.html").as_uri())
        self.assertEqual(self.console(), [])
        self.assertIn("no candidate has a routine", self.find("#finding-accuracy").text)

    def test_z_a_phone_needs_no_sideways_scrolling(self):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        self.assertEqual(self.load(), [])
        width = "return Math.max(document.documentElement.scrollWidth, innerWidth)"
        self.assertEqual(self.driver.execute_script(width), 390)
        for table in ("#worst-error-table", "#drake-table", "#summary-table", "#manifold-table"):
            hidden = self.driver.execute_script(
                "return arguments[0].scrollWidth - arguments[0].clientWidth", self.find(table))
            self.assertEqual(hidden, 0, table)
        self.assertEqual(self.console(), [])


if __name__ == "__main__":
    unittest.main()
