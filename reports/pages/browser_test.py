#!/usr/bin/python3
"""Opens the pages in Chromium as a reader does: browser_test.py PROGRAM. Fails without a browser to drive."""
import json
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.select import Select
except ImportError:
    sys.exit("python3-selenium is missing (packages-test.txt)")
missing = [tool for tool in ("chromium", "chromedriver") if shutil.which(tool) is None]
if missing:
    sys.exit(f"{' and '.join(missing)} missing (packages-test.txt)")

program = sys.argv.pop(1)
max_bytes = 5_000_000
min_contrast = 4.5  # of small text (WCAG 2.2, 1.4.3)
scene = Path(__file__).parents[2] / "simulation/scenes/wheel-on-road.json"


def browser(width, height):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
    return driver


# Contrast of elements' text with what is behind it, as WCAG defines it. A canvas tells what a colour is.
contrasts_of = """
const pen = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
const paint = (colour, opacity = 1) => {
  pen.globalAlpha = opacity;
  pen.fillStyle = colour;
  pen.fillRect(0, 0, 1, 1);
  const [r, g, b] = [...pen.getImageData(0, 0, 1, 1).data].map(c => c / 255)
      .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
return [...document.querySelectorAll(arguments[0])].map(e => {
  paint(getComputedStyle(document.documentElement).backgroundColor);
  const behind = paint(getComputedStyle(e.closest('td')).backgroundColor);
  const text = paint(getComputedStyle(e).color, Number(getComputedStyle(e).opacity));
  return (Math.max(text, behind) + 0.05) / (Math.min(text, behind) + 0.05);
});
"""


class PageTest(unittest.TestCase):
    """A browser and a folder for pages."""
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.driver = browser(1280, 900)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.folder.cleanup()

    @classmethod
    def run_program(cls, *arguments):
        subprocess.run([program, *arguments], check=True, capture_output=True)

    @classmethod
    def load(cls, page):
        """The addresses that loading the page asks for, itself excepted."""
        cls.driver.get_log("performance")  # of pages before
        cls.driver.get(page.as_uri())
        time.sleep(0.5)
        events = [json.loads(e["message"])["message"] for e in cls.driver.get_log("performance")]
        urls = [e["params"]["request"]["url"] for e in events
                if e["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if url != page.as_uri()]

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

    def press(self, element):
        """Clicks an element where nothing at the page's edge lies over it."""
        self.hover(element)
        element.click()

    def console(self):
        return [e for e in self.driver.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]

    def assert_no_sideways_scrolling_on_a_phone(self, page):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        self.assertEqual(self.load(page), [])
        width = "return Math.max(document.documentElement.scrollWidth, innerWidth)"
        self.assertEqual(self.driver.execute_script(width), 390)


class Report(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # Every candidate and class, so that the page is as large as it gets.
        start = time.monotonic()
        cls.run_program("report", "--count", "1", "--out", cls.folder.name)
        cls.seconds = time.monotonic() - start
        cls.page = Path(cls.folder.name) / "report.html"
        cls.requested = cls.load(cls.page)

    def test_1_loads_without_error_or_request(self):
        self.assertEqual(self.console(), [])
        self.assertEqual(self.requested, [])

    def test_the_report_says_how_long_all_of_it_took(self):
        report = json.loads(self.page.with_suffix(".json").read_text())
        self.assertTrue(report["stability"] and report["experiments"])
        self.assertGreater(report["wall_seconds"], 0.8 * self.seconds)
        self.assertLess(report["wall_seconds"], self.seconds)

    def test_2_is_small(self):
        self.assertLess(self.page.stat().st_size, max_bytes)

    def test_charts_are_drawn(self):
        self.assertEqual(len(self.all("#chart-panels svg")), 6)
        for chart in ("#distribution-cumulative", "#distribution-histogram", "#trend-chart"):
            self.assertGreater(len(self.all(f"{chart} svg path")), 3, chart)

    def test_charts_have_names_and_fill_their_places(self):
        charts = self.all(".chart")
        self.assertGreater(len(charts), 8)
        for chart in charts:
            self.assertEqual(chart.get_attribute("role"), "figure")
            self.assertGreater(len(chart.get_attribute("aria-label")), 10)
            drawn = chart.find_element(By.CSS_SELECTOR, "svg").size["width"]
            self.assertAlmostEqual(drawn, chart.size["width"], delta=2)

    def test_numbers_in_coloured_cells_can_be_read_in_both_themes(self):
        for theme in ("light", "dark"):
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                "features": [{"name": "prefers-color-scheme", "value": theme}]})
            contrasts = self.driver.execute_script(contrasts_of, "td.heat, td.heat small")
            self.assertGreater(len(contrasts), 100)
            self.assertGreaterEqual(min(contrasts), min_contrast, theme)

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
        self.choose("#finding-candidate", "bullet")
        failures = self.find("#finding-failures")
        self.assertIn("pose classes, most in", failures.text)
        self.press(failures.find_element(By.CSS_SELECTOR, "li:last-child button"))
        self.assertEqual(self.find("#worst-candidate").get_attribute("value"), "bullet")

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
        self.press(self.find("#trend-legend .toggle[aria-pressed=true]"))
        self.assertEqual(len(self.all("#trend-chart .mark-line path")), lines - 1)

    def test_the_group_of_poses_changes_every_table_and_chart(self):
        places = ("#finding-accuracy", "#worst-error-table", "#chart-panels", "#summary-table",
                  "#distribution-cumulative", "#trend-chart", "#class-table", "#outcome-bars",
                  "#worst-cases")
        def shown():
            time.sleep(0.3)  # charts are drawn when they are ready
            return [self.find(place).get_attribute("innerHTML") for place in places]
        before = shown()
        self.press(self.find("#groups button[value=extreme]"))
        for place, was, now in zip(places, before, shown()):
            self.assertNotEqual(was, now, place)
        self.assertEqual(len(self.all("#chart-panels svg")), 6)
        self.assertIn("extreme poses", self.find("#summary-table caption").text)
        self.press(self.find("#groups button[value=everyday]"))
        self.assertEqual(self.find("#summary-table").get_attribute("innerHTML"), before[3])

    def test_an_arrangement_alone_stands_beside_itself_turned(self):
        self.choose("#contrast-pair", "cylinder-cylinder")
        row = next(r for r in self.all("#contrast-table tbody tr") if r.text.startswith("perpendicular-t"))
        self.assertIn("100 → 100", row.text)  # the reference
        self.choose("#contrast-modifier", "tilted")
        failing = next(c for c in self.all("#contrast-table td.heat")
                       if not c.text.endswith("→ 100"))
        self.press(failing)
        self.assertIn("./touchstone replay cylinder-cylinder/", self.find("#contrast-command code").text)

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

    def test_a_pixel_of_a_map_tells_its_command(self):
        picture = self.find("canvas.map")
        self.assertIn("agree", picture.get_attribute("aria-label"))
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        picture.click()
        self.assertIn("./touchstone replay map/lying/", self.find("#stability .command").text)

    def test_drakes_own_numbers_stand_beside_ours(self):
        rows = [row.text for row in self.all("#drake-table tbody tr")]
        self.assertIn("Drake, point pair 4.0e-12 5.0e-12 4.0e-2 2.0 1.0", rows[0])
        self.hover(self.all("#drake-table tbody tr:nth-child(4) td")[-1]).is_displayed()
        self.all("#drake-table tbody tr:nth-child(4) td")[-1].click()
        self.assertIn("./touchstone replay -", self.find("#drake-command code").text)

    def test_engines_are_shown_before_and_after(self):
        rows = self.all("#engines table:first-of-type tbody tr")
        self.assertIn("8.5e3 → held", next(r.text for r in rows if r.text.startswith("small-log")))
        self.choose("#engine-experiment", "rolling")
        self.assertIn("./touchstone simulate rolling --engine bullet,ode,mujoco",
                      self.find("#engines .command code").text)

    def test_y_a_page_without_contacts_or_times_loads_too(self):
        small = Path(self.folder.name) / "small"
        self.run_program("report", "--count", "1", "--pair", "cylinder-plane", "--class", "standing",
                         "--candidates", "fcl-distance", "--out", small)
        self.driver.get((small / "report.html").as_uri())
        self.assertEqual(self.console(), [])
        self.assertIn("no candidate has a routine", self.find("#finding-accuracy").text)

    def test_z_a_phone_needs_no_sideways_scrolling(self):
        self.assert_no_sideways_scrolling_on_a_phone(self.page)
        for table in ("#worst-error-table", "#drake-table", "#summary-table", "#manifold-table"):
            hidden = self.driver.execute_script(
                "return arguments[0].scrollWidth - arguments[0].clientWidth", self.find(table))
            self.assertEqual(hidden, 0, table)
        self.assertEqual(self.console(), [])


class OtherPages(PageTest):
    def setUp(self):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False})

    def open(self, page):
        self.assertEqual(self.load(page), [])
        self.assertEqual(self.console(), [])

    def picture(self, selector):
        return self.driver.execute_script("return arguments[0].toDataURL()", self.find(selector))

    def test_replay(self):
        page = Path(self.folder.name) / "replay.html"
        self.run_program("replay", "cylinder-box/rim-face/1/0", "--html", page)
        self.open(page)
        self.assertEqual(self.find("#replay code").text, "./touchstone replay cylinder-box/rim-face/1/0")
        before = self.picture("#view")
        self.find("#view-contact").click()
        self.assertNotEqual(self.picture("#view"), before)
        self.assert_no_sideways_scrolling_on_a_phone(page)

    def test_comparison(self):
        reports = [Path(self.folder.name) / name for name in ("before", "after")]
        for report, seed in zip(reports, ("1", "2")):
            self.run_program("report", "--count", "2", "--pair", "cylinder-plane", "--candidates",
                             "reference,bullet,ode", "--seed", seed, "--out", report)
        page = Path(self.folder.name) / "compare.html"
        subprocess.run([program, "compare", *(r / "report.json" for r in reports), "--html", page],
                       capture_output=True)  # exit code 1 on a regression
        self.open(page)
        marks = [m.get_attribute("aria-label") for m in self.all(".chart .mark-symbol path")]
        for name in ("reference", "bullet", "ode"):
            self.assertTrue(any(m.startswith(name + ",") for m in marks), name)
        self.assert_no_sideways_scrolling_on_a_phone(page)

    def test_stability(self):
        folder = Path(self.folder.name) / "stability"
        self.run_program("stability", "--count", "1", "--candidates", "reference,bullet",
                         "--part", "amplification,sequences", "--out", folder)  # maps take longer
        self.open(folder / "stability.html")
        lines = len(self.all(".chart .mark-line path"))
        self.assertEqual(lines, 2 * 5)
        self.find(".toggle").click()
        self.assertEqual(len(self.all(".chart .mark-line path")), lines // 2)
        self.assertEqual(len(self.all("#stability tbody tr th[scope=row]")), 3)
        self.assert_no_sideways_scrolling_on_a_phone(folder / "stability.html")

    def test_choice(self):
        folder = Path(self.folder.name) / "choose"
        self.run_program("choose", scene, "--candidates", "reference,ode,capsule", "--out", folder)
        self.open(folder / "choose.html")
        self.assertIn("error / limit", self.find("#front").text)
        self.assertGreater(len(self.all("#front .mark-symbol path")), 2)
        start = self.picture("#left")
        self.driver.execute_script("""const scrub = document.getElementById('scrub'); scrub.value = 1;
                                      scrub.dispatchEvent(new Event('input'))""")
        later = self.picture("#left")
        self.assertNotEqual(later, start)
        self.assertNotEqual(self.picture("#right"), later)
        ActionChains(self.driver).drag_and_drop_by_offset(self.find("#right"), 40, 10).perform()
        self.assertNotEqual(self.picture("#left"), later)
        self.find("#play").click()
        self.assertEqual(self.find("#play").text, "Pause")
        self.assert_no_sideways_scrolling_on_a_phone(folder / "choose.html")

    def test_engines(self):
        folder = Path(self.folder.name) / "engines"
        self.run_program("simulate", "small-log", "stack-of-five", "--engine", "bullet,mujoco",
                         "--out", folder)
        self.open(folder / "engines.html")
        self.assertEqual(len(self.all("#scene option")), 2)
        self.driver.execute_script("""const scrub = document.getElementById('scrub'); scrub.value = 5;
                                      scrub.dispatchEvent(new Event('input'))""")
        self.assertNotEqual(self.picture("#left"), self.picture("#right"))
        before = self.picture("#right")
        self.choose("#scene", "1")
        self.assertNotEqual(self.picture("#right"), before)
        self.assertIn("small-log", self.find("#engines table").text)
        self.assert_no_sideways_scrolling_on_a_phone(folder / "engines.html")


if __name__ == "__main__":
    unittest.main()
