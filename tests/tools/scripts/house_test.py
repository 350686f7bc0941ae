"""tools/house counts a tiny tree rightly. Run by ctest: house_test.py FOLDER_OF_THE_PROJECT"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()

TREE = {
    # a walk: start.cc -> one.h (one.cc -> two.h) and pictures/three.h; far.h is never reached
    "models/start.cc": '#include <vector>\n#include "models/one.h"\n#include "tools/pictures/three.h"\n',
    "models/one.h": "#pragma once\nint One(int a);\n",
    "models/one.cc": """#include "models/one.h"

#include "models/two.h"

namespace n::inline m {
namespace {

// { a brace in a comment
constexpr int kTable[] = {1, 2, 3};
const std::map<int, int> kMap{{1, 2}};

/// Five lines, and a lambda that belongs to it.
int
Sum(int a, int b = 2) {
  const auto less = [&](int x) { return x - 1'000; };
  return less(a + b) + static_cast<int>(R"({{{)"[0]);
}

class Holder {
 public:
  enum class Kind { one, two };
  explicit Holder(int a) : a_{a}, b_{{a, a}} {}
  Holder(int a, int b)
      : a_{a}, b_{{a, b}} {
    a_ += '{';
  }
  int operator()(int x) const { return x; }

 private:
  int a_{0};
  std::array<int, 2> b_;
};

template <typename T, int N = 3>
std::vector<T> Many() noexcept {
  if (N > 2) {
    return {T{}, T{}};
  }
  return {};
}

}  // namespace

int One(int a) { return a; }

}  // namespace n::inline m
""",
    "models/two.h": '#pragma once\n#include "models/one.h"\n',
    "models/far.h": "#pragma once\n",
    "tools/pictures/three.h": "#pragma once\n\n",
    "tests/one_test.cc": "TEST(One, Is) {\n  EXPECT_EQ(One(1), 1);\n}\n",
}


class House(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(self.folder.name)
        for folder in ("scenarios", "sim", "identification"):
            (root / folder).mkdir()
        for name, text in TREE.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)

    def tearDown(self):
        self.folder.cleanup()

    def call(self, *arguments):
        return subprocess.run([sys.executable, ROOT / "tools/house", "--root", self.folder.name, *arguments],
                              capture_output=True, text=True, check=False)

    def count(self, *walks):
        done = self.call("--json", *walks)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_walks_count_each_header_with_its_source(self):
        whole, without = self.count("all=models/start.cc", "plain=models/start.cc-tools/pictures")["walks"]
        lines = {name: text.count("\n") for name, text in TREE.items()}
        reached = ["models/start.cc", "models/one.h", "models/one.cc", "models/two.h"]
        self.assertEqual(without, {"walk": "plain", "files": 4, "lines": sum(lines[name] for name in reached)})
        self.assertEqual(whole, {"walk": "all", "files": 5, "lines": without["lines"] + 2})

    def test_functions_are_found_with_their_lengths(self):
        parts = {part["part"]: part for part in self.count("all=models/start.cc")["parts"]}
        # by hand: Holder(int), operator() and One have 1 line, Holder(int, int) 4, Sum 5, Many 7 with its template line
        models = parts["models"]
        self.assertEqual(models["functions"], 6)
        self.assertEqual((models["function_median"], models["function_p90"], models["function_longest"]), (1, 7, 7))
        self.assertEqual(models["files"], 5)
        self.assertEqual(models["file_longest"], TREE["models/one.cc"].count("\n"))
        self.assertEqual(parts["tests"]["function_longest"], 3)
        self.assertEqual(parts["product"]["files"], 6)

    def test_a_walk_from_nowhere_is_refused(self):
        done = self.call("bad=models/nowhere.cc")
        self.assertEqual(done.returncode, 2)
        self.assertIn("models/nowhere.cc", done.stderr)


if __name__ == "__main__":
    unittest.main()
