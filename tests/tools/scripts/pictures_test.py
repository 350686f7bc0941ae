"""Pictures are files that others can read. Run by ctest: pictures_test.py PROGRAM"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

PROGRAM = sys.argv.pop(1)
SVG = "{http://www.w3.org/2000/svg}"


def draw(*options):
    """The bytes of the figure of kernels."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "plot", "kernels", "-o", folder, *options], check=True, stdout=subprocess.DEVNULL)
        return next(pathlib.Path(folder).iterdir()).read_bytes()


class Pictures(unittest.TestCase):
    def test_svg_is_xml_whose_words_are_words(self):
        root = xml.etree.ElementTree.fromstring(draw("--format", "svg", "--size", "180x120"))
        self.assertEqual(root.tag, SVG + "svg")
        self.assertAlmostEqual(float(root.get("width").removesuffix("pt")), 180 / 25.4 * 72, places=3)
        words = [element.text for element in root.iter(SVG + "text")]
        for word in ("Plain kernels", "normalised kernels", "value"):
            self.assertIn(word, words)
        identifiers = [element.get("id") for element in root.iter() if element.get("id")]
        self.assertEqual(len(identifiers), len(set(identifiers)))
        links = [value for element in root.iter() for value in element.attrib.values() if "url(#" in value]
        for link in links:
            self.assertIn(re.search(r"#([^)]+)", link).group(1), identifiers)
        self.assertTrue(root.find(SVG + "desc").text.startswith("At t = 4"))

    def test_pdf_holds_its_typeface_and_no_date(self):
        pdf = draw("--format", "pdf", "--style", "paper", "--title", "none")
        self.assertTrue(pdf.startswith(b"%PDF-1.") and pdf.rstrip().endswith(b"%%EOF"))
        self.assertNotIn(b"CreationDate", pdf)
        self.assertIn(b"+DejaVuSans", pdf)
        streams = b"".join(zlib.decompress(data) for data in
                           re.findall(rb"/FlateDecode[^>]*>>\s*stream\n(.*?)\nendstream", pdf, re.S))
        self.assertIn(b"beginbfchar", streams, "words can be searched and copied")
        width = float(re.search(rb"/MediaBox \[ 0 0 (\S+) ", pdf).group(1))
        self.assertAlmostEqual(width, 180 / 25.4 * 72, places=1)

    def test_png_says_its_resolution(self):
        png = draw("--dpi", "300")
        place = png.index(b"pHYs") + 4
        self.assertEqual(int.from_bytes(png[place:place + 4], "big"), round(300 / 0.0254))
        self.assertEqual(int.from_bytes(png[16:20], "big"), 960 * 300 // 72)


if __name__ == "__main__":
    unittest.main()
