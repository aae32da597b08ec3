#!/usr/bin/python3
"""Opens the pages in Chromium as a reader does: browser_test.py PROGRAM. Fails without a browser to drive."""
import collections
import functools
import json
import re
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
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.select import Select
    from selenium.webdriver.support.wait import WebDriverWait
except ImportError:
    sys.exit("python3-selenium is missing (packages-test.txt)")
missing = [tool for tool in ("chromium", "chromedriver") if shutil.which(tool) is None]
if missing:
    sys.exit(f"{' and '.join(missing)} missing (packages-test.txt)")

program = sys.argv.pop(1)
max_bytes = 1_900_000  # of all pose classes; Vega, which is compressed too, is a seventh of it
longest = 600  # seconds to wait for the browser, which only a hang takes
min_contrast = 4.5  # of small text (WCAG 2.2, 1.4.3)
max_sections = 8
clients = Path(__file__).parents[2] / "candidates/clients"
scene = Path(__file__).parents[2] / "simulation/scenes/wheel-on-road.json"


@functools.cache
def browser():
    """That of all tests."""
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.set_page_load_timeout(longest)
    driver.set_script_timeout(longest)
    return driver


def tearDownModule():
    browser().quit()


# Ends when every chart is drawn, and what that changes in the layout has been seen by the page's observers.
settled = """
const done = arguments[0];
ready.then(() => Promise.all([...document.querySelectorAll('.chart')].map(e => e.chart.runAsync())))
    .then(() => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done))));
"""

# Contrast of all text with what is behind it, as WCAG defines it, as [contrast, text]: the colours of an element's
# ancestors lie on each other. A canvas tells what a colour is.
contrasts_of_text = """
const pen = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
const known = new Map();
const lightness = (...colours) => {
  const key = colours.join();
  if (known.has(key)) return known.get(key);
  for (const colour of colours) {
    pen.fillStyle = colour;
    pen.fillRect(0, 0, 1, 1);
  }
  const [r, g, b] = [...pen.getImageData(0, 0, 1, 1).data].map(c => c / 255)
      .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  known.set(key, 0.2126 * r + 0.7152 * g + 0.0722 * b);
  return known.get(key);
};
const result = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
for (let node = walker.nextNode(); node; node = walker.nextNode()) {
  const e = node.parentElement;
  if (!node.data.trim() || e.closest('script, noscript, option, title, :disabled')) continue;
  if (!e.checkVisibility({opacityProperty: true})) continue;
  const layers = [], style = getComputedStyle(e);
  for (let a = e; a; a = a.parentElement) {
    layers.unshift(getComputedStyle(a).backgroundColor);
    if (Number(getComputedStyle(a).opacity) < 1) throw new Error('translucent: ' + node.data);
  }
  const text = lightness(...layers, e.closest('svg') ? style.fill : style.color), behind = lightness(...layers);
  result.push([(Math.max(text, behind) + 0.05) / (Math.min(text, behind) + 0.05), node.data.trim()]);
}
return result;
"""

# What can be reached by Tab, and pictures without a role and a name.
tab_stops = """return [...document.querySelectorAll('a[href], button, input, select, summary, [tabindex]')]
    .filter(e => e.tabIndex >= 0 && e.checkVisibility())"""
# How near the texts of neighbouring cells of a table come to each other, in pixels, over all of its rows.
nearest_cells = """
const box = cell => { const r = document.createRange(); r.selectNodeContents(cell); return r.getBoundingClientRect(); };
return Math.min(...[...arguments[0].querySelectorAll('tr')].flatMap(row => {
  const boxes = [...row.cells].filter(c => c.checkVisibility() && c.textContent.trim()).map(box);
  return boxes.slice(1).map((b, i) => b.left - boxes[i].right);
}));"""
nameless_pictures = """return [...document.querySelectorAll('svg, canvas')]
    .filter(e => e.getAttribute('aria-hidden') !== 'true')
    .filter(e => !['img', 'graphics-document'].includes(e.getAttribute('role'))
                 || (e.getAttribute('aria-label') || '').length < 10)
    .map(e => e.outerHTML.slice(0, 100))"""
# Text beyond the window or its chart, and tables with columns out of sight.
hidden_text = """
const shown = e => e.checkVisibility({opacityProperty: true}) && e.textContent.trim();
const within = (e, box) => {
  const r = e.getBoundingClientRect();
  return r.left >= box.left - 1 && r.right <= box.right + 1;
};
return [
  ...[...document.querySelectorAll('.chart svg')].flatMap(svg => [...svg.querySelectorAll('text')]
      .filter(t => shown(t) && !within(t, svg.getBoundingClientRect()))),
  ...[...document.querySelectorAll('body *')]
      .filter(e => shown(e) && !e.closest('.scroll, nav') && !within(e, {left: 0, right: innerWidth})),
].map(e => e.textContent.slice(0, 40))
    .concat([...document.querySelectorAll(':not(details) > .scroll')]
        .filter(e => e.scrollWidth > e.clientWidth && innerWidth > 1000)
        .map(e => `${e.textContent.slice(0, 40)}: ${e.scrollWidth} of ${e.clientWidth}`))"""


class PageTest(unittest.TestCase):
    """The browser, on a desktop, and a folder for pages."""
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.driver = browser()
        cls.sit_at_a_desktop()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def sit_at_a_desktop(cls):
        cls.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False})

    @classmethod
    def hold_a_phone(cls):
        cls.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})

    @classmethod
    def unfold(cls):
        cls.driver.execute_script("for (const d of document.querySelectorAll('details')) d.open = true")

    @classmethod
    def run_program(cls, *arguments):
        return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout

    @classmethod
    def load(cls, page):
        """The addresses that loading the page asks for, itself excepted."""
        cls.driver.get_log("performance")  # of pages before
        cls.driver.get(page.as_uri())
        cls.settle()
        events = [json.loads(e["message"])["message"] for e in cls.driver.get_log("performance")]
        urls = [e["params"]["request"]["url"] for e in events
                if e["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if url != page.as_uri()]

    @classmethod
    def settle(cls):
        cls.driver.execute_async_script(settled)

    def wait_until(self, condition):
        WebDriverWait(self.driver, longest, poll_frequency=0.05).until(lambda _: condition())

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def assert_labels_apart(self, chart):
        """No label of the chart lies on another one; their number."""
        boxes = self.driver.execute_script(
            """return [...arguments[0].querySelectorAll('.role-mark text')]
               .filter(t => t.textContent && getComputedStyle(t).opacity > 0.5)
               .map(t => t.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom])""",
            chart)
        for i, a in enumerate(boxes):
            for b in boxes[:i]:
                # A box of text is higher than its letters.
                apart = (a[0] >= b[2] or b[0] >= a[2] or a[1] + 3 >= b[3] or b[1] + 3 >= a[3])
                self.assertTrue(apart, (a, b))
        return len(boxes)

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
        self.hold_a_phone()
        self.assertEqual(self.load(page), [])
        self.unfold()
        width = "return Math.max(document.documentElement.scrollWidth, innerWidth)"
        self.assertEqual(self.driver.execute_script(width), 390)
        self.assertEqual(self.driver.execute_script(hidden_text), [])

    def assert_nothing_hidden(self, table):
        """All columns are in sight."""
        hidden = "return arguments[0].scrollWidth - arguments[0].clientWidth"
        self.assertEqual(self.driver.execute_script(hidden, self.find(table)), 0, table)

    def assert_in_sight(self, *places):
        """They are seen without scrolling."""
        for place in places:
            box = self.driver.execute_script("""const r = arguments[0].getBoundingClientRect();
                                             return [r.left, r.top, r.right, r.bottom]""", self.find(place))
            width, height = self.driver.execute_script("return [innerWidth, innerHeight]")
            self.assertGreaterEqual(min(box[:2]), 0, place)
            self.assertLessEqual(box[2], width, place)
            self.assertLessEqual(box[3], height, place)

    def picture(self, selector):
        return self.driver.execute_script("return arguments[0].toDataURL()", self.find(selector))

    def assert_pictures_and_keys(self, max_stops):
        """Every picture has a name, every table and chart is one tab stop."""
        self.assertEqual(self.driver.execute_script(nameless_pictures), [])
        self.assertLess(len(self.driver.execute_script(tab_stops)), max_stops)


class Report(PageTest):
    """A report's page of the usual candidates, with a seventh of the pose classes."""
    options = ["--class", ",".join(
        "general parallel perpendicular perpendicular-t standing lying side cap rim rim-side rim-end cap-end side-end "
        "side-side rim-face rim-rim parallel-side cap-on-cap-centred side-on-face cap-on-face-offset vertex-cap edge-side "
        "edge-cap coaxial concentric touching recorded".split()
        + [f"general+{name}" for name in "apart shallow deep touching coin needle tiny huge far triangle of-box".split()]
        + [f"{name}+turned" for name in ("standing", "lying", "parallel-side", "perpendicular-t")]
        + [f"{name}+tilted-1e-{i}" for name in ("parallel", "perpendicular", "perpendicular-t")
           for i in range(1, 16)])]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_program("report", "--count", "1", *cls.options, "--only", "timing,casts,stability,engines",
                        "--out", cls.folder.name)
        cls.page = Path(cls.folder.name) / "report.html"
        cls.requested = cls.load(cls.page)
        cls.folded = {e.get_attribute("id") for e in cls.driver.find_elements(By.CSS_SELECTOR, "details .scroll")
                      if not e.is_displayed()}
        cls.unfold()

    def test_1_loads_without_error_or_request(self):
        self.assertEqual(self.console(), [])
        self.assertEqual(self.requested, [])

    def test_2_is_small(self):
        self.assertLess(self.page.stat().st_size, max_bytes)

    def test_charts_are_drawn(self):
        for chart in ("#speed-chart", "#distribution-cumulative", "#distribution-histogram", "#trend-chart"):
            self.assertGreater(len(self.all(f"{chart} svg path")), 3, chart)

    def test_charts_fill_their_places(self):
        charts = self.all(".chart")
        self.assertGreater(len(charts), 8)
        for chart in charts:
            drawn = chart.find_element(By.CSS_SELECTOR, "svg").size["width"]
            self.assertAlmostEqual(drawn, chart.size["width"], delta=2)

    def test_the_page_has_few_sections(self):
        sections = [s for s in self.all("main > section") if s.is_displayed()]
        self.assertLessEqual(len(sections), max_sections)
        self.assertEqual([a.get_attribute("hash") for a in self.all("#contents a")],
                         [f"#{s.get_attribute('id')}" for s in sections])

    def test_what_few_ask_for_is_folded(self):
        for table in ("contrast-table", "factor-table", "model-table", "drake-table", "manifold-table"):
            self.assertIn(table, self.folded)
            self.assertTrue(self.find(f"#{table}").is_displayed())

    def test_text_can_be_read_in_both_themes(self):
        for theme in ("light", "dark"):
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                "features": [{"name": "prefers-color-scheme", "value": theme}]})
            for quantity, word in (("worst", "lost"), ("agreement", "100%")):
                self.choose("#matrix-quantity", quantity)
                contrasts = self.driver.execute_script(contrasts_of_text)
                self.assertGreater(len(contrasts), 2000)
                self.assertEqual([c for c in contrasts if c[0] < min_contrast], [], theme)
                self.assertTrue(any(word in text for _, text in contrasts))

    def test_every_outcome_has_one_colour_and_only_agreement_is_green(self):
        for theme in ("light", "dark"):
            self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                "features": [{"name": "prefers-color-scheme", "value": theme}]})
            colours = self.driver.execute_script("""return outcomes.map(o => {
                const pen = document.createElement('canvas').getContext('2d');
                pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(outcomeColour(o));
                pen.fillRect(0, 0, 1, 1);
                return [o, ...pen.getImageData(0, 0, 1, 1).data];
              })""")
            greenest = [o for o, r, g, b, _ in colours if g > max(r, b)]
            self.assertEqual(greenest, ["agree"], theme)
            for i, (name, *colour) in enumerate(colours):
                for other, *there in colours[:i]:
                    self.assertGreater(sum(abs(x - y) for x, y in zip(colour, there)), 40,
                                       (theme, name, other))
        # The same colour in the bars, the maps and the worst cases.
        for place in ("#outcome-bars .swatch", "#stability .swatch", "#worst-cases .swatch"):
            for swatch in self.all(place):
                name = self.driver.execute_script("return arguments[0].nextSibling.data", swatch)
                self.assertIn(f"var(--outcome-{name})", swatch.get_attribute("style"))

    def test_numbers_are_written_in_one_way(self):
        text = self.find("body").text
        self.assertEqual(re.findall(r"[\d.]+e\+\d+", text), [])
        self.assertEqual(re.findall(r"−\d.*", text), [])  # a hyphen, as programs read it
        written = self.driver.execute_script(
            "return [0, 600, 6000, -0.06, 0.996, 999.6, 75, 1e21, null].map(x => exponent(x))")
        self.assertEqual(written, ["0", "600", "6.0e3", "-6.0e-2", "1.0", "1.0e3", "75", "1.0e21", "–"])

    def test_the_contents_stay_in_sight(self):
        for section in ("numbers", "classes"):
            self.press(self.find(f"#contents a[href='#{section}']"))
            self.wait_until(lambda: [a.get_attribute("hash") for a in self.all("#contents [aria-current]")] ==
                            [f"#{section}"])
            bar = self.find("#bar").rect
            top = self.driver.execute_script(
                "return [document.getElementById('bar'), document.getElementById(arguments[0])]"
                ".map(e => e.getBoundingClientRect()).map(r => [r.top, r.bottom])", section)
            self.assertAlmostEqual(top[0][0], 0, delta=1)
            self.assertLess(bar["height"], 110)
            self.assertGreaterEqual(top[1][0], top[0][1])  # the section begins below the bar

    def test_tables_sort_by_mouse_and_keyboard(self):
        self.choose("#pair", "all")
        def values():
            return self.driver.execute_script("""
                return [...document.querySelectorAll('#summary-table tbody tr')]
                    .map(row => row.cells[9].innerText.replaceAll(',', ''))""")
        def head():
            return self.all("#summary-table thead th")[9]
        before = values()
        self.assertEqual(head().get_attribute("aria-sort"), "none")
        self.press(head())
        self.assertEqual(head().get_attribute("aria-sort"), "ascending")
        numbers = [int(v) for v in values() if v != "–"]
        self.assertEqual(numbers, sorted(numbers))
        self.assertNotEqual(values(), before)
        head().send_keys(Keys.ENTER)
        self.assertEqual(head().get_attribute("aria-sort"), "descending")
        self.assertEqual([int(v) for v in values() if v != "–"], numbers[::-1])
        self.assertEqual(values()[len(numbers):], ["–"] * (len(before) - len(numbers)))
        head().send_keys(Keys.SPACE)
        self.assertEqual(values(), before)
        # Published numbers stay on top, however the others are sorted; names sort with their numbers.
        heads = self.all("#drake-table thead th")
        self.press(heads[-1])
        rows = [row.text for row in self.all("#drake-table tbody tr")]
        self.assertTrue(rows[0].startswith("Drake") and rows[1].startswith("Drake"))
        self.press(heads[0])
        names = [row.text.split()[0] for row in self.all("#drake-table tbody tr")][2:]
        self.assertEqual(names, sorted(names))
        for _ in range(2):
            self.press(heads[0])

    def test_a_table_and_a_chart_are_one_tab_stop_each(self):
        stops = self.driver.execute_script(tab_stops)
        self.assertLess(len(stops), 150)
        for name in ("table", ".chart svg", "[role=toolbar]"):
            inside = self.driver.execute_script(
                """return [...document.querySelectorAll(arguments[0])].filter(e => e.checkVisibility())
                    .map(e => [...e.querySelectorAll('[tabindex="0"], button:not([tabindex])')].length)""", name)
            self.assertGreater(len(inside), 2, name)
            self.assertLessEqual(max(inside), 1, name)
        self.assertEqual(self.driver.execute_script(
            """return [...document.querySelectorAll('table')].filter(t => t.rows.length > 3)
                .filter(t => t.getAttribute('role') !== 'grid').length"""), 0)

    def test_whatever_tells_more_can_be_reached_by_keyboard(self):
        out_of_reach = """return [...document.querySelectorAll('.explained')]
            .filter(e => e.closest('table') && !e.closest('table').querySelector('[tabindex="0"]'))
            .map(e => e.textContent)"""
        options = [o.get_attribute("value") for o in Select(self.find("#candidate")).options]
        rows = []
        for candidate in options:  # some have few rows
            self.choose("#candidate", candidate)
            rows.append(len(self.all("#factor-table tbody tr")))
            self.assertEqual(self.driver.execute_script(out_of_reach), [], candidate)
        self.assertTrue(any(0 < n < 5 for n in rows), rows)

    def test_arrow_keys_move_within_a_table(self):
        focused = self.driver.switch_to
        self.hover(self.find("#headline"))  # no cell lies under the pointer, whose words would be shown
        first = self.find("#matrix th")
        first.send_keys(Keys.ARROW_DOWN, Keys.END)
        cell = focused.active_element
        self.assertEqual(cell, self.all("#matrix tbody tr:first-child td")[-1])
        self.assertIn("reference, cylinder–convex", self.find("#tooltip").text)
        name = self.all("#matrix tbody tr")[1].text.split()[0]
        cell.send_keys(Keys.ARROW_DOWN, Keys.ARROW_LEFT, Keys.ENTER)
        # The keyboard goes along to the worst classes and cases.
        self.assertEqual(focused.active_element, self.find("#failures h2"))
        self.assertIn(f"{name}, cylinder–box, everyday poses", self.find("#failure-words").text)
        self.find("#matrix thead th:last-child").send_keys(Keys.ENTER)
        self.assertEqual(focused.active_element, self.find("#matrix thead th:last-child"))
        self.assertEqual(self.find("#pair").get_attribute("value"), "cylinder-convex")
        self.choose("#pair", "all")

    def test_arrow_keys_move_within_a_chart(self):
        def label():
            return self.driver.switch_to.active_element.get_attribute("aria-label")
        # From mark to mark, and along a line and between lines.
        chart = self.find("#speed-chart svg")
        chart.find_element(By.CSS_SELECTOR, "[tabindex='0']").send_keys(Keys.HOME)
        seen = {label()}
        for _ in range(len(chart.find_elements(By.CSS_SELECTOR, ".mark-symbol path"))):
            self.driver.switch_to.active_element.send_keys(Keys.ARROW_RIGHT)
            seen.add(label())
        self.assertEqual(seen, {m.get_attribute("aria-label")
                                for m in chart.find_elements(By.CSS_SELECTOR, ".mark-symbol path")})
        self.assertTrue(self.find("#tooltip").is_displayed())
        lines = self.find("#distribution-cumulative svg")
        lines.find_element(By.CSS_SELECTOR, "[tabindex='0']").send_keys(Keys.HOME)
        name = label().split("\n")[0]
        self.driver.switch_to.active_element.send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(label().split("\n")[0], name)
        names = set()
        for key in [Keys.ARROW_UP] * 12 + [Keys.ARROW_DOWN] * 12:
            self.driver.switch_to.active_element.send_keys(key)
            names.add(label().split("\n")[0])
        self.assertGreater(len(names), 3)
        self.find("#distribution-histogram svg [tabindex='0']").send_keys(Keys.END)
        self.assertIn("contacts", label())

    def test_pictures_have_a_role_and_a_name(self):
        self.assertEqual(self.driver.execute_script(nameless_pictures), [])

    def test_the_words_say_what_agreeing_takes(self):
        words = dict(zip((e.get_attribute("textContent") for e in self.all("#words dt")),
                         (e.get_attribute("textContent") for e in self.all("#words dd"))))
        for part in ("Depth", "normal regret", "deepest contact point"):
            self.assertIn(part, words["agree"])

    def test_nothing_is_clipped_on_a_desktop(self):
        self.choose("#trend-variable", "distance")
        for pair in ("cylinder-cylinder", "all"):
            self.choose("#pair", pair)
            self.settle()
            self.assertEqual(self.driver.execute_script(hidden_text), [], pair)

    def test_labels_lie_neither_on_each_other_nor_on_the_front(self):
        for pair in [o.get_attribute("value") for o in Select(self.find("#pair")).options][::-1]:
            self.choose("#pair", pair)
            self.settle()
            self.assertGreater(self.assert_labels_apart(self.find("#speed-chart")), 3)
            # Whether points of a line lie within a label's letters.
            crossed = self.driver.execute_script("""
                const result = [], svg = document.querySelector('#speed-chart svg');
                const texts = [...svg.querySelectorAll('.role-mark text')]
                    .filter(t => t.textContent && getComputedStyle(t).opacity > 0.5);
                for (const line of svg.querySelectorAll('.role-mark .mark-line path, .mark-line.role-mark path')) {
                  const matrix = line.getScreenCTM();
                  for (let at = 0; at < line.getTotalLength(); at += 1) {
                    const p = line.getPointAtLength(at).matrixTransform(matrix);
                    for (const t of texts) {
                      const b = t.getBoundingClientRect();
                      const isWithin = p.x > b.left && p.x < b.right && p.y > b.top + 3 && p.y < b.bottom - 3;
                      if (isWithin) result.push(t.textContent);
                    }
                  }
                }
                return [...new Set(result)];""")
            self.assertEqual(crossed, [], pair)

    def test_the_chart_shows_the_time_that_95_of_100_queries_keep_too(self):
        self.choose("#pair", "all")
        def places():
            self.settle()
            return {m.get_attribute("aria-label").split(",")[0]: m.location["x"]
                    for m in self.all("#speed-chart .mark-symbol path")}
        medians = places()
        self.choose("#chart-time", "p95")
        tails = places()
        self.choose("#chart-time", "median")
        self.assertEqual(medians.keys(), tails.keys())
        self.assertNotEqual(tails, medians)
        self.assertEqual(places(), medians)

    def test_a_mark_tells_its_numbers_and_leads_to_its_worst_cases(self):
        self.choose("#pair", "cylinder-plane")
        self.settle()
        # Marks of equal speed and accuracy lie on each other, which ones is a matter of timing: one that can be pointed at.
        mark = self.driver.execute_script("""
            document.querySelector('#speed-chart').scrollIntoView({block: 'center'});
            return [...document.querySelectorAll('#speed-chart .mark-symbol path')].find(m => {
              const b = m.getBoundingClientRect();
              return document.elementFromPoint((b.left + b.right) / 2, (b.top + b.bottom) / 2) === m;
            });""")
        name = mark.get_attribute("aria-label").split(",")[0]
        tip = self.hover(mark)
        self.assertTrue(tip.is_displayed())
        self.assertIn(f"{name}, cylinder–plane", tip.text)
        self.assertIn("ns per query", tip.text)
        elsewhere = "return elsewhere({candidate: arguments[0], pair: 'cylinder-plane'})"
        self.assertIn(self.driver.execute_script(elsewhere, name), tip.text)
        mark.click()
        self.assertEqual(self.find("#candidate").get_attribute("value"), name)
        self.assertIn(f"{name}", self.find("#worst-cases h3").text)
        self.assertIn("replay cylinder-plane/", self.find("#worst-cases .command code").text)
        self.choose("#pair", "all")

    def test_a_cell_of_the_matrix_leads_to_its_worst_classes_and_cases(self):
        self.choose("#matrix-quantity", "agreement")
        heads = [h.text for h in self.all("#matrix thead th")]
        self.assertEqual(heads, ["candidate", "all", "plane", "sphere", "capsule", "cylinder", "box",
                                 "convex"])
        row = next(r for r in self.all("#matrix tbody tr") if r.text.split()[0] == "bullet")
        cell = row.find_elements(By.TAG_NAME, "td")[heads.index("box") - 1]
        self.assertRegex(cell.text, r"^\d+\.\d%\n\d+(\.\d)? [nµ]s$")
        self.press(cell)
        self.assertIn("bullet, cylinder–box, everyday poses: disagrees in", self.find("#failure-words").text)
        worst = self.find("#failure-table tbody tr")
        pose_class = worst.find_element(By.TAG_NAME, "th").text
        self.press(worst)
        self.assertIn(f"./touchstone replay cylinder-box/{pose_class}/1/", self.find("#failure-command code").text)
        self.assertIn("bullet", self.find("#worst-cases h3").text)
        self.choose("#pair", "all")

    def test_the_matrix_is_sorted_by_the_pair_that_is_chosen_below_the_yardstick(self):
        self.choose("#matrix-quantity", "agreement")
        shares = """return [...document.querySelectorAll('#matrix tbody tr')].map(r => r.cells[arguments[0]].textContent)
                    .map(t => t === '–' ? -1 : parseFloat(t))"""
        for column, pair in ((1, "all"), (2, "cylinder-plane"), (6, "cylinder-box")):
            self.press(self.all("#matrix thead th")[column])
            self.assertEqual(self.find("#pair").get_attribute("value"), pair)
            first, *others = self.driver.execute_script(shares, column)
            self.assertEqual(others, sorted(others, reverse=True))
            self.assertIn("reference (Touchstone’s own)", self.find("#matrix tbody tr").text.replace("\n", " "))
            self.assertEqual(self.all("#matrix thead th")[column].get_attribute("aria-sort"), "descending")
        self.press(self.all("#matrix thead th")[1])

    def test_a_name_in_the_matrix_tells_what_it_stands_for(self):
        for name, meaning in (("bullet-margin-0", "margin 0 on cylinder, box"), ("prism:16", "prism:16 models every cylinder")):
            row = next(r for r in self.all("#matrix tbody tr") if r.text.split()[0] == name)
            self.assertIn(meaning, self.hover(row.find_element(By.TAG_NAME, "th")).text)

    def test_a_figure_over_all_pairs_says_so_in_its_title(self):
        captions = ("#answer figcaption", "#outcome-bars-title", "#errors figcaption")
        for pair, words in (("all", "all pairs together, everyday poses"), ("cylinder-box", "cylinder–box, everyday poses")):
            self.choose("#pair", pair)
            for caption in captions:
                self.assertTrue(self.find(caption).text.endswith(words), caption)
        self.choose("#pair", "all")
        self.assertIn("cylinder–", self.find("#trend-caption").text)

    def test_the_verdict_says_who_is_right_and_how_fast(self):
        self.choose("#pair", "cylinder-box")
        verdict = self.find("#headline").text
        self.assertRegex(verdict, r"^(Right in all|Most often right in) everyday poses against a box: \S+ .*in [\d.]+ [nµ]s")
        self.assertRegex(verdict, r"Yardstick: reference \(Touchstone’s own\), 100% in \d+ ns\.$")
        self.choose("#pair", "all")

    def test_failures_in_other_groups_are_told_wherever_one_group_alone_is(self):
        self.choose("#pair", "all")
        report = json.loads((Path(self.folder.name) / "report.json").read_text())
        group_of = {(c["pair"], c["class"]): c["group"] for c in report["classes"]}
        names = [c["name"] for c in report["candidates"]]
        failing, supported = ({name: collections.Counter() for name in names} for _ in range(2))
        for row in report["results"]:
            count = row["count"] - row["outcomes"].get("unsupported", 0)
            agreeing = sum(row["outcomes"].get(name, 0) for name in ("agree", "unseen"))
            group = group_of[row["pair"], row["class"]]
            supported[row["candidate"]][group] += count > 0
            failing[row["candidate"]][group] += agreeing < count
        right = [name for name in names if not failing[name].total()]
        self.assertIn("reference", right)
        self.assertRegex(self.find("#extent").text, rf"of {len(names)} candidates {len(right)} agrees? in every pose class")
        for name in ("reference", "bullet-margin-0", "ode"):
            self.choose("#candidate", name)
            text = self.find("#failure-words").text
            self.assertEqual("Elsewhere" in text, name not in right, name)
            others = failing[name] - collections.Counter(everyday=failing[name]["everyday"])
            for group, count in others.items():
                self.assertIn(f"{count} of {supported[name][group]} {group} classes", text)
            row = next(r for r in self.all("#matrix tbody tr") if r.text.split()[0] == name)
            tip = self.hover(row.find_element(By.TAG_NAME, "td")).text
            rest = supported[name].total() - supported[name]["everyday"]
            self.assertEqual(f"elsewhere: {others.total()} of {rest} class" in tip, name not in right, name)
        best = re.match(r"[^:]+: ([^ ,]+),? .*? \(elsewhere: (\d+) of \d+ classes fail\)", self.find("#headline").text)
        self.assertEqual(int(best[2]), failing[best[1]].total() - failing[best[1]]["everyday"])
        self.press(next(b for b in self.all("#failure-words .link") if "degenerate" in b.text))
        self.assertEqual(self.find("#groups [aria-pressed=true]").text, "degenerate")
        self.assertIn("everyday classes", self.find("#failure-words").text)
        self.press(self.find("#groups button[value=everyday]"))

    def test_the_controls_change_what_is_shown(self):
        for control, value, place in (
                ("#matrix-quantity", "worst", "#matrix"),
                ("#trend-variable", "depth", "#trend-chart"),
                ("#class-quantity", "worst", "#class-table"),
                ("#distribution-quantity", "normal_regret", "#distribution-cumulative")):
            before = self.find(place).get_attribute("innerHTML")
            self.choose(control, value)
            self.assertNotEqual(self.find(place).get_attribute("innerHTML"), before, control)
        lines = len(self.all("#trend-chart .mark-line path"))
        self.press(self.find("#error-legend .toggle[aria-pressed=true]"))
        self.assertEqual(len(self.all("#trend-chart .mark-line path")), lines - 1)

    def test_group_pair_and_candidate_change_every_table_and_chart_about_them(self):
        of_group = ["#headline", "#matrix", "#speed-chart", "#failure-words", "#failure-table", "#worst-cases", "#factor-table",
                    "#summary-table", "#outcome-bars", "#distribution-cumulative", "#distribution-histogram", "#trend-chart",
                    "#class-table", "#model-table"]
        of_candidate = ["#failure-words", "#failure-table", "#worst-cases", "#factor-table", "#distribution-histogram",
                        "#class-table", "#manifold-table", "#contrast-count"]
        of_pair = [*of_group, "#contrast-table", "#manifold-table"]
        def shown():
            self.settle()
            return {place: self.find(place).get_attribute("innerHTML") for place in {*of_pair, *of_candidate}}
        self.choose("#pair", "all")
        self.choose("#candidate", "bullet")
        before = shown()
        for places, change, back in (
                (of_group, lambda: self.press(self.find("#groups button[value=extreme]")),
                 lambda: self.press(self.find("#groups button[value=everyday]"))),
                (of_pair, lambda: self.choose("#pair", "cylinder-plane"), lambda: self.choose("#pair", "all")),
                (of_candidate, lambda: self.choose("#candidate", "ode"), lambda: self.choose("#candidate", "bullet"))):
            change()
            now = shown()
            self.assertEqual([place for place in places if now[place] == before[place]], [])
            back()
        self.assertEqual(self.find("#summary-table").get_attribute("innerHTML"), before["#summary-table"])

    def test_a_decade_is_as_wide_as_every_other(self):
        self.choose("#pair", "cylinder-cylinder")
        self.settle()
        places = {}
        for mark in self.all("#trend-chart .mark-symbol path"):
            decade = re.search(r"tilt 1e(-?\d+) to", mark.get_attribute("aria-label"))
            if decade:  # zero has its place beside the least
                places[int(decade[1])] = mark.rect["x"] + mark.rect["width"] / 2
        decades = sorted(places)
        steps = [b - a for a, b in zip(decades, decades[1:])]
        self.assertGreater(max(steps), 1, "no decade is without a value: nothing is seen here")
        width = (places[decades[-1]] - places[decades[0]]) / (decades[-1] - decades[0])
        for a, b in zip(decades, decades[1:]):
            self.assertAlmostEqual((places[b] - places[a]) / (b - a), width, delta=1, msg=(a, b))

    def test_a_row_over_some_pairs_alone_says_so(self):
        self.choose("#pair", "all")
        rows = [r.text for r in self.all("#summary-table tbody tr")]
        self.assertTrue(any(r.startswith("libccd-mpr\n(5 of 6 pairs)") for r in rows), rows)
        self.assertTrue(any(r.startswith("reference 100%") for r in rows), rows)
        self.settle()
        labels = [m.get_attribute("aria-label") for m in self.all("#speed-chart .mark-symbol path")]
        self.assertTrue(any(t.startswith("libccd-mpr, all pairs (5 of 6 pairs)") for t in labels), labels)

    def test_an_arrangement_alone_stands_beside_itself_turned(self):
        self.choose("#pair", "cylinder-cylinder")
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
        picture = "return arguments[0].toDataURL()"
        blank = """const c = document.createElement('canvas'); c.width = arguments[0].width;
                   c.height = arguments[0].height; return c.toDataURL()"""
        self.wait_until(lambda: self.driver.execute_script(picture, canvas) !=
                        self.driver.execute_script(blank, canvas))  # drawn once it is in sight
        before = self.driver.execute_script(picture, canvas)
        ActionChains(self.driver).drag_and_drop_by_offset(canvas, 40, 10).perform()
        self.assertNotEqual(self.driver.execute_script(picture, canvas), before)

    def test_a_pixel_of_a_map_tells_its_command(self):
        picture = self.find("canvas.map")
        self.assertRegex(picture.get_attribute("aria-label"),
                         "^Map of failure, reference, lying, zoom 1e-8; pixels: agree ")
        for words in "t: a cap across a side", "x: sides that cross":  # not a letter alone
            self.assertIn(words, [e.text for e in self.all("#stability th")])
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        picture.click()
        self.assertIn("./touchstone replay map/lying/", self.find("#stability .command").text)

    def test_a_cell_of_casts_tells_the_commands_of_its_worst(self):
        rows = {row.text.split()[0]: row for row in self.all("#cast-matrix tbody tr")}
        self.assertIn("reference", rows)
        self.assertNotIn("ode", rows, "which has no casts")
        cell = rows["bullet"].find_element(By.CSS_SELECTOR, "td")  # of all pairs
        self.assertRegex(cell.text, r"^\d+\.\d%\s\d+ ")
        self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", cell)
        cell.click()
        self.assertRegex(self.find("#cast-worst .command").text, "replay cylinder-[a-z]+/.*/[a-z-]+")
        # The worst of them is drawn where A touches; its slider takes A to where the candidate let it go.
        self.wait_until(lambda: self.all("#cast-worst .sweep button"))
        touching, answered = self.picture("#cast-worst canvas"), self.all("#cast-worst .sweep button")[-1]
        self.assertRegex(answered.text, "^bullet")
        answered.click()
        self.assertNotEqual(self.picture("#cast-worst canvas"), touching)

    def test_drakes_own_numbers_stand_beside_ours(self):
        rows = [row.text for row in self.all("#drake-table tbody tr")]
        self.assertIn("Drake, point pair 4.0e-12 5.0e-12 4.0e-2 2.0 1.0", rows[0])
        self.hover(self.all("#drake-table tbody tr:nth-child(4) td")[-1]).is_displayed()
        self.all("#drake-table tbody tr:nth-child(4) td")[-1].click()
        self.assertIn("./touchstone replay -", self.find("#drake-command code").text)

    def test_engines_are_shown_before_and_after(self):
        rows = self.all("#engines table tbody tr")
        self.assertIn("8.5e3 → held", next(r.text for r in rows if r.text.startswith("small-log")))
        self.choose("#engine-experiment", "rolling")
        self.assertIn("./touchstone simulate rolling --engine bullet,ode,mujoco",
                      self.find("#engines .command code").text)

    def test_y_a_page_without_contacts_or_times_loads_too(self):
        small = Path(self.folder.name) / "small"
        self.run_program("report", "--count", "1", "--pair", "cylinder-plane", "--class", "standing",
                         "--candidates", "fcl-distance", "--out", small)
        self.load(small / "report.html")
        self.assertEqual(self.console(), [])
        self.assertIn("No candidate has a routine", self.find("#headline").text)

    def test_z_a_phone_needs_no_sideways_scrolling(self):
        self.assert_no_sideways_scrolling_on_a_phone(self.page)
        for table in ("#summary-table", "#model-table"):
            self.assertGreater(self.driver.execute_script(nearest_cells, self.find(table)), 5, table)
        for table in ("#matrix", "#drake-table", "#summary-table", "#manifold-table"):
            self.assert_nothing_hidden(table)
        self.assertEqual(self.console(), [])


class LargestReport(Report):
    """The same of a page as large as it gets."""
    options = ["--all-candidates"]


class FirstScreen(PageTest):
    """Which engine is right, how fast, where it fails: seen without scrolling, by a report of usual size."""
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.printed = cls.run_program("report", "--count", "1", "--class",
                                      "general+shallow,general,standing+turned,lying+turned",
                                      "--only", "scores,timing", "--out", cls.folder.name)
        cls.page = Path(cls.folder.name) / "report.html"

    def test_on_a_desktop_the_matrix_stands_beside_speed_against_accuracy(self):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False})
        self.load(self.page)
        self.assertGreaterEqual(len(self.all("#matrix tbody tr")), 12)  # as many as are asked by default
        self.assert_in_sight("#headline", "#groups", "#matrix", "#speed-chart")

    def test_the_findings_of_the_terminal_stand_below_with_their_commands(self):
        self.load(self.page)
        printed = " ".join(self.printed.split())
        findings = self.all("#findings li")
        self.assertEqual(len(findings), printed.split("Findings ")[1].count("./touchstone replay "))
        for finding in findings:
            text, command = finding.text.splitlines()[:2]
            self.assertIn(f"{text} {command} ", printed)

    def test_on_a_phone_the_matrix_is_seen(self):
        self.hold_a_phone()
        self.load(self.page)
        self.assert_in_sight("#headline", "#groups", "#matrix")


class OtherPages(PageTest):
    def setUp(self):
        self.sit_at_a_desktop()
        self.page = None

    def tearDown(self):
        if self.page:
            self.assert_no_sideways_scrolling_on_a_phone(self.page)

    def open(self, page, max_stops=50):
        self.page = page
        self.assertEqual(self.load(page), [])
        self.assertEqual(self.console(), [])
        self.assertEqual(self.driver.execute_script(hidden_text), [])
        self.assert_pictures_and_keys(max_stops)
        contrasts = self.driver.execute_script(contrasts_of_text)
        self.assertEqual([c for c in contrasts if c[0] < min_contrast], [])

    def go_to(self, seconds):
        """Moves the motions to this time."""
        self.driver.execute_script("""const scrub = document.getElementById('scrub'); scrub.value = arguments[0];
                                      scrub.dispatchEvent(new Event('input'))""", seconds)

    def show_run(self, name):
        self.choose("#other", self.driver.execute_script(
            "return String(data.motion.runs.findIndex(r => r.name === arguments[0]))", name))

    def assert_models_are_drawn(self, canvas="#right"):
        """Without what stands for its bodies the picture is another one."""
        with_models = self.picture(canvas)
        self.driver.execute_script("""for (const run of data.motion.runs) run.meshes = new Map();
                                      dispatchEvent(new Event('resize'))""")
        self.assertNotEqual(self.picture(canvas), with_models)
        self.driver.execute_script("""for (const run of data.motion.runs) delete run.meshes;
                                      dispatchEvent(new Event('resize'))""")
        self.assertEqual(self.picture(canvas), with_models)

    def with_capsule_over_a_body(self, orientation):
        """The picture on the right with such a capsule in place of what stands for the moving bodies."""
        self.driver.execute_script("""
            const {bodies, runs} = data.motion, run = runs[document.getElementById('other').value];
            const parts = [{shape: {shape: 'capsule', radius: 0.02, half_length: 0.3}, centre: [0, 0, 0],
                            orientation: arguments[0]}];
            run.models = bodies.map((b, body) => ({body, parts})).filter(m => !bodies[m.body].fixed);
            delete run.meshes;
            dispatchEvent(new Event('resize'))""", orientation)
        return self.picture("#right")

    def test_replay(self):
        page = Path(self.folder.name) / "replay.html"
        self.run_program("replay", "cylinder-box/rim-face/1/0", "--html", page)
        self.open(page)
        self.assertEqual(self.find("#replay code").text, "./touchstone replay cylinder-box/rim-face/1/0")
        self.assertRegex(self.find("#headline").text, r"^6\.4e-3 m deep; \d+ of \d+ candidates disagree: missed .*bullet\b")
        self.assert_in_sight("#headline", "#view", "#slice")
        before = self.picture("#view")
        self.find("#view-contact").click()
        self.assertNotEqual(self.picture("#view"), before)
        self.run_program("replay", "cylinder-sphere/side/1/2/passing", "--candidates", "reference,bullet", "--html", page)
        self.open(page)
        self.assertRegex(self.find("#headline").text, "^A (never )?touches B")
        self.assertNotEqual(self.find("#cast-table").text, "")
        slider, seen = self.find(".sweep input"), self.picture("#view")
        self.find(".sweep button").click()
        self.assertEqual(slider.get_attribute("value"), "0")
        self.assertNotEqual(self.picture("#view"), seen, "A is not back at its start")
        for name in ("plane/general", "sphere/general", "capsule/general", "cylinder/general", "convex/general",
                     "convex/general+triangle"):
            self.run_program("replay", f"cylinder-{name}/1/0", "--candidates", "reference", "--html", page)
            self.open(page)
            self.unfold()
            for body in "ab":  # the slice has an outline of each
                self.assertRegex(self.find(f"#slice path.{body}").get_attribute("d"), "^M[^N]+z$")  # no NaN
            self.assertIn("pose_a.position[2]", self.find("#number-table").text)  # which is filled last

    def test_a_report_of_experiments(self):
        folder = Path(self.folder.name) / "experiments"
        start = time.monotonic()
        self.run_program("report", "--count", "1", "--pair", "cylinder-plane", "--class", "standing", "--only",
                         "experiments", "--candidates", "capsule", "--workers", "1", "--out", folder)
        seconds = time.monotonic() - start
        report = json.loads((folder / "report.json").read_text())
        results = report["experiments"]["results"]
        self.assertGreaterEqual(len(results), 10)
        # The time that it tells is that of all parts, not of the scores alone.
        of_experiments = sum(1e-6 * r["microseconds_per_step"] * r["steps"] for r in results
                             if r["outcome"] == "measured")
        self.assertLess(of_experiments, report["wall_seconds"])
        self.assertLess(report["wall_seconds"], seconds)
        self.open(folder / "report.html", 150)
        self.unfold()
        before = self.find("#experiment-table").get_attribute("innerHTML")
        self.choose("#experiment-name", "rolling")
        self.assertNotEqual(self.find("#experiment-table").get_attribute("innerHTML"), before)

    def test_answers_that_came_in_a_file(self):
        folder = Path(self.folder.name) / "given"
        answers = Path(self.folder.name) / "answers.jsonl"
        answers.write_text("".join(json.dumps({"id": f"cylinder-{name}/1/0", "status": "none"}) + "\n"
                                   for name in ("plane/lying", "box/general+apart")))
        self.run_program("score", answers, "--name", "mine", "--out", folder)
        self.open(folder / "report.html", 150)
        self.assertEqual(len(self.all("#matrix tbody tr")), 1)
        for group in [b.text for b in self.all("#groups button")]:
            self.press(self.find(f"#groups button[value={group}]"))
            self.assertRegex(self.find("#headline").text, rf"^(Right in all|Most often right in) {group} poses: mine")
            self.assertIn(f"mine, all pairs, {group} poses", self.find("#failure-words").text)
        for row in self.all("#failure-table tbody tr"):
            self.press(row)
        self.assertNotIn("null", self.find("body").text)
        self.assertEqual(self.console(), [])

    def test_needles_and_coins_are_seen(self):
        page = Path(self.folder.name) / "thin.html"
        for name in ("cylinder-box/general+needle/1/0", "cylinder-capsule/coaxial+needle+tilted-1e-8+turned/1/0",
                     "cylinder-cylinder/touching-tilted+coin+huge+far/1/0"):
            self.run_program("replay", name, "--html", page)
            self.driver.get(page.as_uri())
            # The smallest width of each body's outline, in pixels, and how far the thinner one is from the middle.
            widths = self.driver.execute_script("""
                const scale = view.zoom * Math.min(view.canvas.clientWidth, view.canvas.clientHeight) / 2;
                return scene.bodies.map(b => {
                  const points = b.faces.flat().map(p => [dot(p, view.right), dot(p, view.up)]);
                  let width = Infinity;
                  const directions = b.axes.map(e => [dot(e, view.right), dot(e, view.up)])
                      .flatMap(([x, y]) => [[x, y], [-y, x]]);
                  for (const [x, y] of directions) {
                    const along = points.map(p => (p[0] * x + p[1] * y) / Math.hypot(x, y));
                    width = Math.min(width, Math.max(...along) - Math.min(...along));
                  }
                  return scale * width;
                });""")
            self.assertGreater(min(widths), 20, name)

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

    def compare_with(self, change):
        """Opens the comparison of a small report with what `change` makes of it."""
        folder = Path(self.folder.name) / "unmoved"
        before, after, page = (folder / name for name in ("report.json", "after.json", "compare.html"))
        if not before.exists():
            self.run_program("report", "--count", "1", "--pair", "cylinder-plane,cylinder-sphere", "--class",
                             "lying+turned,cap", "--candidates", "reference,bullet,ode", "--only", "scores,timing",
                             "--out", folder)
        report = json.loads(before.read_text())
        change(report)
        after.write_text(json.dumps(report))
        done = subprocess.run([program, "compare", before, after, "--html", page], capture_output=True, text=True)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # 1: something is worse
        self.open(page)

    def assert_marks(self, count_of):
        """The chart of every pair is drawn, with so many marks of each candidate on a pair."""
        pairs = [o.get_attribute("value") for o in Select(self.find("#pair")).options]
        self.assertEqual(pairs, ["all", "cylinder-plane", "cylinder-sphere"])
        for pair in pairs:
            self.choose("#pair", pair)
            self.settle()
            marks = collections.Counter(m.get_attribute("aria-label").split(",")[0]
                                        for m in self.all("#speed-chart .mark-symbol path"))
            self.assertEqual(marks, {name: count_of(name, pair) for name in ("reference", "bullet", "ode")}, pair)
            self.assertGreater(self.assert_labels_apart(self.find("#speed-chart")), 0, pair)
        self.choose("#pair", "all")

    def test_comparison_of_equal_reports(self):
        self.compare_with(lambda report: None)
        self.assertEqual(self.find("#headline").text, "Nothing beyond the limits.")
        self.assertNotIn("→", self.find("#matrix").text)
        self.assert_marks(lambda name, pair: 1)

    def test_comparison_where_one_candidate_has_changed(self):
        def spoil(report):
            # ode takes ten times as long on spheres, and is too deep where it agreed.
            for row in report["summary"] + report["results"]:
                if row["candidate"] != "ode" or row["pair"] == "cylinder-plane":
                    continue
                row["outcomes"] = {"agree": row["count"] - 1, "overdeep": 1}
                if row["pair"] == "all":
                    continue
                for member in ("median", "low", "high", "ratio_to_bullet", "ratio_low", "ratio_high"):
                    if row["nanoseconds"][member] is not None:
                        row["nanoseconds"][member] *= 10
        self.compare_with(spoil)
        self.assertRegex(self.find("#headline").text,
                         r"^Worse: ode on cylinder–sphere \(1 class; \w+ agreement .*→ 0\.0%\)\. "
                         r"Slower: ode on cylinder–sphere \(1 class;")
        self.assert_marks(lambda name, pair: 2 if (name, pair) == ("ode", "cylinder-sphere") else 1)
        self.choose("#candidate", "bullet")
        self.assertEqual(self.find("#change-table").text, "None.")
        row = next(r for r in self.all("#matrix tbody tr") if r.text.startswith("ode"))
        self.press(row.find_elements(By.TAG_NAME, "td")[-1])
        self.assertEqual(self.driver.switch_to.active_element, self.find("#changes h2"))
        self.assertIn("cylinder-sphere", self.find("#change-table").text)

    def test_comparison_where_one_candidate_is_missing(self):
        def remove(report):
            for part in ("candidates", "results", "summary"):
                report[part] = [r for r in report[part] if "ode" not in (r.get("name"), r.get("candidate"))]
        self.compare_with(remove)
        row = next(r.text for r in self.all("#matrix tbody tr") if r.text.startswith("ode"))
        self.assertEqual(row.count("only before"), 3)
        self.assert_marks(lambda name, pair: 1)

    def test_history(self):
        """Of an engine of somebody's own, whose second release finds no contact."""
        folder, commands = Path(self.folder.name) / "history", []
        folder.mkdir()
        for release, broken in ((1, ""), (2, "    def query(self, *question): return None\n"), (3, "")):
            script = folder / f"{release}.py"
            script.write_text(f"import sys\nsys.path.append({str(clients)!r})\nfrom example import Example, run\n"
                              f"class Release(Example):\n    name = 'example@{release}'\n{broken}run(Release)\n")
            commands += ["--candidate-command", f"python3 {script}"]
        releases = ["example@1", "example@2", "example@3"]
        text = self.run_program(*commands, "report", "--history", "example", "--candidates", ",".join(releases),
                                "--count", "1", "--class", "general", "--pair", "cylinder-box",
                                "--only", "scores", "--out", folder)
        self.assertRegex(text, r"example@2 +0.0 +-  broke 1\nexample@3 +100.0 +-  mended 1\n")
        self.open(folder / "history.html")
        self.assertIn("example, 3 releases, 1 to 3", self.find("#headline").text)
        self.assertEqual(len(self.all("#agreement-chart .mark-symbol path")), len(releases))
        self.assertEqual(self.find("#time-chart").text, "Not measured.")
        self.assertEqual([" ".join(row.text.split()) for row in self.all("#first-table tbody tr")],
                         ["cylinder–box example@2: general, 100.0% → 0.0% example@3: general, 0.0% → 100.0%"])

    def test_stability(self):
        folder = Path(self.folder.name) / "stability"
        self.run_program("stability", "--count", "1", "--candidates", "reference,bullet",
                         "--part", "amplification,sequences", "--out", folder)  # maps take longer
        self.open(folder / "stability.html")
        lines = len(self.all(".chart .mark-line path"))
        self.assertEqual(lines, 2 * 6)
        self.find(".toggle").click()
        self.assertEqual(len(self.all(".chart .mark-line path")), lines // 2)
        self.assertEqual(len(self.all("#stability tbody tr th[scope=row]")), 3)

    def test_choice(self):
        folder = Path(self.folder.name) / "choose"
        self.run_program("choose", scene, "--candidates", "reference,ode,capsule,prism:16,spheres:1..16",
                         "--disturbances", "1", "--out", folder)
        self.open(folder / "choose.html")
        self.assert_in_sight("#headline", "#front", "#kind-table", "#need-table")  # verdict and picture
        self.assertIn("error / limit", self.find("#front").text)
        self.assertGreater(len(self.all("#front .mark-symbol path")), 2)
        self.assertGreater(self.assert_labels_apart(self.find("#front")), 3)
        self.assertEqual(self.find("#left-caption").text, "With exact")
        routines = self.all("#run-table h3 + table tbody td:first-child")  # apart from models
        self.assertEqual([cell.text for cell in routines], ["ode"])
        self.assertIn("exact runs differ by", self.find("#need-table").text)
        self.show_run("spheres:1")
        self.assertIn("parts from the run beside it at", self.find("#other-note").text)
        run = self.driver.execute_script("return data.motion.runs[document.getElementById('other').value]")
        self.assertAlmostEqual(float(self.find("#scrub").get_attribute("value")),
                               max(0, run["from"] - 0.1), places=3)
        start = self.picture("#left")
        self.go_to(1)
        later = self.picture("#left")
        self.assertNotEqual(later, start)
        self.assertNotEqual(self.picture("#right"), later)
        ActionChains(self.driver).drag_and_drop_by_offset(self.find("#right"), 40, 10).perform()
        self.assertNotEqual(self.picture("#left"), later)
        self.find("#play").click()
        self.assertEqual(self.find("#play").text, "Pause")
        self.assertIn("The same as spheres:1 here: capsule.", self.find("#too-slow").text)  # of a flat wheel
        for model in ("prism:16", "spheres:1"):
            self.show_run(model)
            self.go_to(1)  # the wheel is in sight
            self.assert_models_are_drawn()
            self.assertRegex(self.find("#other-command").text, f"--contacts '?{model}\\b")
        pictures = [self.with_capsule_over_a_body(turn) for turn in ([1, 0, 0, 0], [0.7, 0.7, 0, 0])]
        self.assertNotEqual(*pictures)

    def test_choice_for_a_robot_lists_what_was_not_read(self):
        folder = Path(self.folder.name) / "choose-robot"
        self.run_program("choose", scene.with_name("rover.urdf"), "--candidates", "capsule",
                         "--duration", "0.1", "--disturbances", "1", "--out", folder)
        self.open(folder / "choose.html")
        self.assertIn("transmission", self.driver.find_element(By.ID, "ignored").get_attribute("textContent"))

    def test_choice_of_many_needs(self):
        folder = Path(self.folder.name) / "choose-needs"
        scene = json.loads(Path(__file__).parents[2].joinpath("simulation/scenes/rod-on-table.json").read_text())
        scene["duration"] = 0.2
        scene["needs"] = [{"need": "rests", "speed": 1 + i, "by": 0.1, "bodies": ["rod"]} for i in range(100)]
        Path(self.folder.name, "needs.json").write_text(json.dumps(scene))
        self.run_program("choose", Path(self.folder.name) / "needs.json", "--candidates", "spheres:64",
                         "--disturbances", "0", "--out", folder)
        self.open(folder / "choose.html")
        self.assertEqual(self.driver.execute_script("return data.answer"), 0)
        self.assertNotIn("instead of", self.find("#provenance").text)  # exact contacts
        self.assertLess(self.find("#need-table").size["height"], 600)
        for table in ("#kind-table", "#need-table"):
            self.assertGreater(self.driver.execute_script(nearest_cells, self.find(table)), 5, table)
            self.assert_nothing_hidden(table)

    def test_choice_in_an_engine(self):
        folder = Path(self.folder.name) / "choose-engine"
        self.run_program("choose", scene.with_name("rod-on-table.json"), "--engine", "bullet",
                         "--disturbances", "2", "--out", folder)
        self.open(folder / "choose.html")
        self.assertIn("The default cylinder breaks", self.find("#headline").text)
        self.assertIn("btSphereShape", self.find("#kind-table pre").text)
        self.assertGreater(len(self.all("#run-table tbody tr")), 10)
        self.assert_models_are_drawn("#left")  # spheres over the rod

    def test_engines(self):
        folder = Path(self.folder.name) / "engines"
        self.run_program("simulate", "small-log", "stack-of-five", "--engine", "bullet,mujoco",
                         "--out", folder)
        self.open(folder / "engines.html")
        self.assertEqual(len(self.all("#scene option")), 2)
        self.go_to(5)
        self.assertNotEqual(self.picture("#left"), self.picture("#right"))
        before = self.picture("#right")
        self.choose("#scene", "1")
        self.assertNotEqual(self.picture("#right"), before)
        self.assertIn("small-log", self.find("#engines table").text)
        rest_of = "return restOf({exact: arguments[0], last_motion: 10, last_time: 10}, {rests: true})"
        self.assertIn("jitters", self.driver.execute_script(rest_of, True))  # held contradicts never
        self.assertEqual(self.driver.execute_script(rest_of, False), "never")


if __name__ == "__main__":
    unittest.main()
