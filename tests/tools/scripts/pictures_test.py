"""Every figure and page as files that others can read. Run by ctest: pictures_test.py PROGRAM SOURCE"""

import html.parser
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

PROGRAM, SOURCE = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
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


def call(*words, status=0, **variables):
    done = subprocess.run([PROGRAM, *map(str, words)], env={**os.environ, **variables}, capture_output=True, text=True, check=False)
    if done.returncode != status:
        raise AssertionError(f"{words} ended with {done.returncode}: {done.stderr}")
    return done


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
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.at = lambda self, name: pathlib.Path(scratch.name) / name
        at = lambda name: pathlib.Path(scratch.name) / name
        at("suite.yaml").write_text(SUITE)
        at("robot.yaml").write_text(ROBOT)
        call("simulate", SOURCE / "tools/examples/warm.yaml", "--set", "duration=900", "-o", at("log"))
        call("identify", at("log/recording.csv"), "-o", at("estimate.json"))
        call("run", at("suite.yaml"), "-o", at("run"))
        call("simulate", at("robot.yaml"), "-o", at("robot"))
        cls.said = call("plot", "kernels", at("estimate.json"), at("run"), at("log"), at("robot"), "-o", at("all"), "--data")

    def drawn(self, *words, source="kernels", figure="kernels", format="png"):
        """The bytes of one figure."""
        folder = self.at("one")
        call("plot", source, "--figure", figure, "--format", format, "-o", folder, *words)
        return (folder / f"{figure}.{format}").read_bytes()

    def test_every_family_gives_its_figures_and_their_numbers(self):
        names = {path.relative_to(self.at("all")).with_suffix("").as_posix() for path in self.at("all").rglob("*.png")}
        self.assertLessEqual({"kernels/kernels", "estimate/fit", "estimate/log", "estimate/trace", "estimate/envelope", "estimate/held_out",
                              "run/npe_boxes", "run/ladder", "run/coverage", "log/envelope", "robot/warm_robot"}, names)
        for name in names:
            head = [line for line in self.at(f"all/{name}.csv").read_text().splitlines() if not line.startswith("#")]
            self.assertEqual(head[0], "panel,series,kind,x,y,lower,upper,value")
            self.assertGreater(len(head), 2, name)
        self.assertIn("motor_angle (needs a gear or the column motor_position)", self.said.stderr)

    def test_formats_give_the_same_bytes_twice_and_the_size_that_is_asked_for(self):
        for format in ("png", "svg", "pdf"):
            one, two = (self.drawn("--style", "paper", "--size", "88", format=format) for _ in range(2))
            self.assertEqual(one, two, format)
        points = 88 / 25.4 * 72
        pdf = self.drawn("--style", "paper", "--size", "88", format="pdf")
        self.assertAlmostEqual(float(re.search(rb"/MediaBox \[ 0 0 (\S+) ", pdf)[1]), points, places=1)
        png = self.drawn("--style", "paper", "--size", "88", "--dpi", "600")
        self.assertAlmostEqual(int.from_bytes(png[16:20], "big"), 88 / 25.4 * 600, delta=1)
        place = png.index(b"pHYs") + 4
        self.assertEqual(int.from_bytes(png[place:place + 4], "big"), round(600 / 0.0254))
        self.assertIn(b"beyond the data, the plain kernels say", png)

    def test_svg_is_xml_whose_words_are_words(self):
        root = xml.etree.ElementTree.fromstring(self.drawn("--size", "180x120", format="svg"))
        self.assertAlmostEqual(float(root.get("width").removesuffix("pt")), 180 / 25.4 * 72, places=3)
        words = "|".join("".join(element.itertext()) for element in root.iter(SVG + "text"))
        for word in ("Plain kernels", "normalised kernels", "value"):
            self.assertIn(word, words)
        self.assertIn("beyond the data", root.find(SVG + "desc").text)

    def test_pdf_holds_its_typeface_and_no_date(self):
        pdf = self.drawn("--style", "paper", "--title", "none", format="pdf")
        self.assertNotIn(b"CreationDate", pdf)
        self.assertIn(b"DejaVuSans", pdf)
        streams = b"".join(zlib.decompress(data) for data in re.findall(rb"/FlateDecode[^>]*>>\s*stream\n(.*?)\nendstream", pdf, re.S))
        self.assertIn(b"beginbfrange", streams, "words can be searched and copied")

    def test_without_a_title_a_figure_is_lower(self):
        height = lambda png: int.from_bytes(png[20:24], "big")
        self.assertLess(height(self.drawn("--title", "none")), height(self.drawn()))

    def test_a_python_without_matplotlib_is_one_sentence(self):
        bare = self.at("bare")
        bare.write_text("#!/bin/sh\nexit 1\n")
        bare.chmod(0o755)
        for words in (("plot", "kernels", "-o", self.at("none")), ("report", self.at("run")),
                      ("identify", self.at("log/recording.csv"), "--plot", self.at("none.png"))):
            err = call(*words, status=4, WARMJOINT_PYTHON=str(bare)).stderr
            self.assertIn("sudo apt install python3-matplotlib python3-jinja2", err)
            self.assertEqual(len(err.strip().splitlines()), 1, err)
        self.assertFalse(self.at("none").exists())

    def test_pages_need_nothing_but_themselves_and_close_what_they_open(self):
        call("report", self.at("estimate.json"), "-o", self.at("log.html"))
        call("report", self.at("run"), "-o", self.at("run.html"))
        for name in ("log", "run"):
            text = self.at(f"{name}.html").read_text()
            page = Pages(text)
            self.assertEqual(page.open, [])
            self.assertTrue(all(link.startswith(("data:", "#")) for link in page.links))
            self.assertIn("default-src 'none'", text)
            self.assertNotIn("sourceMappingURL", text)
            self.assertGreater(text.count("<img "), 3)
            self.assertLess(len(text), 6_000_000)

    def test_pages_escape_what_others_wrote(self):
        folder = self.at("<script>x<")
        folder.mkdir()
        (folder / "log.csv").write_bytes(self.at("log/recording.csv").read_bytes())
        call("report", folder / "log.csv", "-o", self.at("escaped.html"))
        text = self.at("escaped.html").read_text()
        self.assertNotIn("<script>x", text)
        self.assertIn("&lt;script&gt;x&lt;/log.csv", text)


if __name__ == "__main__":
    unittest.main()
