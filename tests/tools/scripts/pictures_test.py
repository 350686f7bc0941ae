"""Every figure and page as files that others can read. Run by ctest: pictures_test.py PROGRAM SOURCE

What the program hands to its backend is kept by a Python that passes it on; figures are then drawn again here, in each
format and style, and looked at: words inside the sheet and apart, sizes, what the files say of themselves.
"""

import html.parser
import json
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

PROGRAM, SOURCE = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
FOLDER = SOURCE / "tools/python/warmjoint"
SVG = "{http://www.w3.org/2000/svg}"
SUITE = """name: little
question: Who wins?
seed: 3
realizations: 4
scenario:
  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}, thermal: {thermal_gain: -1, thermal_time_constant: 200}}
  motion: {speeds: [0.1, 1], hold: 4}
  noise: {torque: 0.3}
  duration: 900
ladder: {variable: noise.torque, unit: N.m, values: [0.1, 1]}
identifiers: [{name: energy-ml}, {name: energy-als, options: {iterations: 5}}, {name: nominal-ls}]
"""
ROBOT = """name: warm arm
plant: mujoco
robot: irb140_like
joint: joint_2
friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}, thermal: {thermal_gain: -0.3, thermal_time_constant: 60}}
motion: {speeds: [0.1, 0.5], hold: 3}
duration: 120
"""


def python_with(*modules):
    """A Python that has these modules; None where this machine has none."""
    for python in filter(None, (os.environ.get("WARMJOINT_PYTHON"), "python3", "/usr/bin/python3")):
        if subprocess.run([python, "-c", "import " + ", ".join(modules)], check=False, stderr=subprocess.DEVNULL).returncode == 0:
            return python
    return None


def call(*words, status=0, **variables):
    done = subprocess.run([PROGRAM, *map(str, words)], env={**os.environ, **variables}, capture_output=True, text=True, check=False)
    if done.returncode != status:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stderr}")
    return done


class Collected:
    """Figures and pages of an estimate, a run and a simulation, as the program writes them for its backend."""

    def __init__(self, folder, python):
        self.folder, self.count = pathlib.Path(folder), 0
        self.tee = self.folder / "tee"
        self.tee.write_text(f'#!/bin/sh\ncase "$1" in -c) exec {python} "$@" ;; esac\ncat > "$KEEP"\nexec {python} "$@" < "$KEEP"\n')
        self.tee.chmod(self.tee.stat().st_mode | stat.S_IXUSR)
        self.at = lambda name: self.folder / name
        self.at("suite.yaml").write_text(SUITE)
        self.at("robot.yaml").write_text(ROBOT)
        call("simulate", SOURCE / "tools/examples/warm.yaml", "--set", "duration=900", "-o", self.at("log"))
        call("identify", self.at("log/recording.csv"), "-o", self.at("estimate.json"))
        call("run", self.at("suite.yaml"), "-o", self.at("run"))
        call("simulate", self.at("robot.yaml"), "-o", self.at("robot"))
        self.figures = []
        for source in ("kernels", self.at("estimate.json"), self.at("run"), self.at("log"), self.at("robot")):
            self.figures += self.asked("plot", source, "-o", self.at("pictures"))["figures"]
        self.pages = {"log": self.asked("report", self.at("estimate.json"), "-o", self.at("log.html")),
                      "run": self.asked("report", self.at("run"), "-o", self.at("run.html"))}

    def asked(self, *words):
        """What the backend was asked by this command."""
        self.count += 1
        kept = self.folder / f"asked{self.count}.json"
        call(*words, WARMJOINT_PYTHON=str(self.tee), KEEP=str(kept))
        return json.loads(kept.read_text())


def boxes(fig):
    """All words that are drawn, with their places in pixels."""
    from matplotlib.text import Text
    renderer = fig.canvas.get_renderer()
    fig.draw(renderer)
    # ticks outside of the limits are kept, and not drawn
    for ax in fig.axes:
        for axis, limits in ((ax.xaxis, sorted(ax.get_xlim())), (ax.yaxis, sorted(ax.get_ylim()))):
            spare = 1e-9 * (limits[1] - limits[0])
            for tick in axis.get_major_ticks():
                if not limits[0] - spare <= tick.get_loc() <= limits[1] + spare:
                    tick.label1.set_visible(False)
                    tick.label2.set_visible(False)
    texts = [text for text in fig.findobj(Text) if text.get_visible() and text.get_text().strip()]
    return [(text.get_text(), text.get_window_extent(renderer)) for text in dict.fromkeys(texts)]


class Pages(html.parser.HTMLParser):
    """Whether every element that is opened is closed, and what is asked of others."""

    def __init__(self, text):
        super().__init__()
        self.open, self.links = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "link", "img", "source", "input", "!doctype"):
            self.open.append(tag)
        self.links += [value for name, value in attrs if name in ("src", "srcset", "href")]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.all = Collected(cls.scratch.name, sys.executable)
        sys.path.insert(0, str(FOLDER))
        import draw
        cls.draw = draw

    def named(self, name):
        return next(figure for figure in self.all.figures if figure["name"] == name)

    def test_every_figure_is_drawn_in_each_style_with_its_words_inside_and_apart(self):
        names = {figure["name"] for figure in self.all.figures}
        self.assertLessEqual({"kernels", "fit", "log", "trace", "envelope", "npe_boxes", "ladder", "coverage", "warm_robot"}, names)
        for figure in self.all.figures:
            for style, size in (("screen", {}), ("paper", {"width": 88})):
                with self.subTest(figure=figure["name"], style=style, **size):
                    self.look(self.draw.draw(figure, style, **size))

    def look(self, fig):
        places = boxes(fig)
        width, height = fig.get_size_inches() * fig.dpi
        for words, box in places:
            self.assertTrue(box.x0 > -1 and box.y0 > -1 and box.x1 < width + 1 and box.y1 < height + 1, f"'{words}' leaves the sheet")
        for i, (words, a) in enumerate(places):
            for other, b in places[i + 1:]:
                over = min(min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0))
                self.assertLess(over, 0.25 * min(a.height, b.height), f"'{words}' and '{other}' overlap")

    def test_formats_give_the_same_bytes_twice_and_the_size_that_is_asked_for(self):
        figure = self.named("log")
        for format in ("png", "svg", "pdf"):
            once = self.draw.encode(figure, format, "paper", width=88)
            self.assertEqual(once, self.draw.encode(figure, format, "paper", width=88), format)
        points = 88 / 25.4 * 72
        self.assertAlmostEqual(float(re.search(rb"/MediaBox \[ 0 0 (\S+) ", self.draw.encode(figure, "pdf", "paper", width=88))[1]), points, places=1)
        png = self.draw.encode(figure, "png", "paper", width=88, dpi=600)
        self.assertAlmostEqual(int.from_bytes(png[16:20], "big"), 88 / 25.4 * 600, delta=1)
        place = png.index(b"pHYs") + 4
        self.assertEqual(int.from_bytes(png[place:place + 4], "big"), round(600 / 0.0254))
        self.assertIn(figure["finding"].encode(), png)

    def test_svg_is_xml_whose_words_are_words(self):
        figure = self.named("kernels")
        root = xml.etree.ElementTree.fromstring(self.draw.encode(figure, "svg", width=180, height=120))
        self.assertAlmostEqual(float(root.get("width").removesuffix("pt")), 180 / 25.4 * 72, places=3)
        words = "|".join("".join(element.itertext()) for element in root.iter(SVG + "text"))
        for word in ("Plain kernels", "normalised kernels", "value"):
            self.assertIn(word, words)
        self.assertEqual(root.find(SVG + "desc").text, figure["finding"])

    def test_pdf_holds_its_typeface_and_no_date(self):
        pdf = self.draw.encode(self.named("kernels"), "pdf", "paper", titled=False)
        self.assertNotIn(b"CreationDate", pdf)
        self.assertIn(b"DejaVuSans", pdf)
        streams = b"".join(zlib.decompress(data) for data in re.findall(rb"/FlateDecode[^>]*>>\s*stream\n(.*?)\nendstream", pdf, re.S))
        self.assertIn(b"beginbfrange", streams, "words can be searched and copied")

    def test_a_style_is_changed_by_a_dictionary_and_one_plot_goes_into_given_axes(self):
        import matplotlib.figure
        figure = self.named("friction_curve")
        fig = self.draw.draw(figure, {"base": "paper", "background": "#ffeedd", "hues": {"sky": "#123456"}})
        self.assertEqual(matplotlib.colors.to_hex(fig.get_facecolor()), "#ffeedd")
        self.assertIn("#123456", [matplotlib.colors.to_hex(line.get_color()) for line in fig.axes[0].lines])
        axes = matplotlib.figure.Figure().subplots()
        self.draw.draw(figure, ax=axes)
        self.assertTrue(axes.get_xlabel() and axes.get_legend())
        self.assertRaises(ValueError, self.draw.draw, self.named("kernels"), ax=axes)

    def test_a_python_without_matplotlib_is_one_sentence(self):
        bare = self.all.at("bare")
        bare.write_text("#!/bin/sh\nexit 1\n")
        bare.chmod(0o755)
        for words in (("plot", "kernels", "-o", self.all.at("none")), ("report", self.all.at("run")),
                      ("identify", self.all.at("log/recording.csv"), "--plot", self.all.at("none.png"))):
            err = call(*words, status=4, WARMJOINT_PYTHON=str(bare)).stderr
            self.assertIn("sudo apt install python3-matplotlib python3-jinja2", err)
            self.assertEqual(len(err.strip().splitlines()), 1, err)
        self.assertFalse(self.all.at("none").exists())

    def test_pages_need_nothing_but_themselves_and_close_what_they_open(self):
        for name in ("log", "run"):
            text = self.all.at(f"{name}.html").read_text()
            page = Pages(text)
            self.assertEqual(page.open, [])
            self.assertTrue(all(link.startswith(("data:", "#")) for link in page.links))
            self.assertIn("default-src 'none'", text)
            self.assertNotIn("sourceMappingURL", text)
            self.assertLess(len(text), 6_000_000)

    def test_pages_escape_what_others_wrote(self):
        import page
        asked = self.all.pages["log"]["data"]
        text = page.fill("log", {**asked, "source": "<script>x</script>", "remarks": ["a <b>c</b>"], "figures": []}, self.draw)
        self.assertNotIn("<script>x", text)
        self.assertIn("a &lt;b&gt;c&lt;/b&gt;", text)

    def test_a_page_without_the_library_of_charts_says_so_and_has_its_pictures(self):
        import page
        charts, page.CHARTS = page.CHARTS, pathlib.Path("/nowhere")
        self.addCleanup(setattr, page, "CHARTS", charts)
        text = page.fill("log", self.all.pages["log"]["data"], self.draw)
        self.assertIn("sudo apt install libjs-dygraphs", text)
        self.assertNotIn("<script", text)
        self.assertGreater(text.count("<img "), 3)


if __name__ == "__main__":
    have = python_with("matplotlib", "jinja2")
    if have and pathlib.Path(sys.executable).resolve() != pathlib.Path(subprocess.check_output([have, "-c", "import sys; print(sys.executable)"], text=True).strip()).resolve():
        os.execvp(have, [have, __file__, PROGRAM, str(SOURCE), *sys.argv[1:]])
    unittest.main()
