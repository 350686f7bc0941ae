"""tools/constants check wants a row or a reason for each named number. Run by ctest: constants_test.py FOLDER_OF_THE_PROJECT"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()

PAGE = """## Not sensitive

| file | name | value | | answers | half widths | % |
|---|---|---|---|---|---|---|
| fit.cc | kQuiet | 0.5 | of the width | 0 | 0 | 0 |

## Sensitive

| fit.cc | kLoud | 4 | deviations | 1 | 0 | 0 |

## By definition
"""
SOURCE = """constexpr double kQuiet = 0.5;  // of the width

constexpr int kLoud = 4;  // deviations; why 4: one normal sample in 16 000 lies further
"""


class Constants(unittest.TestCase):
    def check(self, source):
        """What `check` says of a tree with that source; empty where it is content."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for room in ("identification", "models/recording"):
                (root / room).mkdir(parents=True)
                (root / room / "NUMBERS.md").write_text(PAGE)
            (root / "identification/fit.cc").write_text(source)
            (root / "tools").mkdir()
            shutil.copy(ROOT / "tools/constants", root / "tools/constants")
            done = subprocess.run([sys.executable, root / "tools/constants", "check"], capture_output=True, text=True)
            self.assertEqual(done.returncode == 0, done.stderr.strip() == "", done.stderr)
            return done.stderr

    def test_rows_and_reasons_are_enough(self):
        self.assertEqual(self.check(SOURCE), "")

    def test_a_reason_may_stand_above_its_paragraph(self):
        self.assertEqual(self.check("// why these: half and double find the same\n" + SOURCE.replace("; why", ";")
                                    .replace("\n\n", "\n")), "")

    def test_another_value_is_no_row(self):
        self.assertIn("kQuiet", self.check(SOURCE.replace("0.5", "0.6")))

    def test_a_unit_is_no_reason(self):
        self.assertIn("kLoud", self.check(SOURCE.replace("why 4: ", "")))

    def test_a_new_number_needs_one(self):
        said = self.check(SOURCE + "\ninline constexpr double kNew = 1.0 / 3;\n")
        self.assertIn("kNew = 1.0 / 3", said)
        self.assertNotIn("kQuiet", said)

    def test_the_reason_of_another_number_is_none(self):
        self.assertIn("kNew", self.check(SOURCE + "constexpr long kNew = 3;\n"))
        self.assertIn("kNew", self.check(SOURCE + "                      // in any log\nconstexpr long kNew = 3;\n"))

    def test_a_reason_may_go_on_below(self):
        self.assertEqual(self.check(SOURCE.replace(" why 4", "\n                      // why 4")), "")


if __name__ == "__main__":
    unittest.main()
