#include "tools/report/gl/canvas.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/report/look.h"
#include "tests/report/run_example.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint::report {
namespace {

/// Resident memory of this process, kB.
double ResidentMemory() {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double size = 0;
    if (word == "VmRSS:" && file >> size) return size;
  }
  return 0;
}

/// How many figures the test draws: WARMJOINT_FIGURES, for a long look, or few.
int FiguresToDraw() {
  const char* wanted = std::getenv("WARMJOINT_FIGURES");
  return wanted ? std::atoi(wanted) : 60;
}

TEST(Canvas, DoesNotGrowWithTheNumberOfFigures) {
  if (ResidentMemory() == 0) GTEST_SKIP() << "this system does not tell its memory";
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer keeps freed memory for a while";
#endif
  const Figure figure = *IntervalCoverage(ExampleRun());
  // drivers and allocators settle in the first
  for (int i = 0; i < 15; ++i) DrawFigure(TestCanvas(), figure);
  const double before = ResidentMemory();
  const int figures = FiguresToDraw();
  for (int i = 0; i < figures; ++i) DrawFigure(TestCanvas(), figure);
  const double growth = ResidentMemory() - before;
  RecordProperty("growth_kB", static_cast<int>(growth));
  // one picture is 3 MB, its frame buffers 40 MB; what is kept of either would show at once. An
  // allocator may round up by some MB whatever the number of figures
  EXPECT_LT(growth, 8000 + 10.0 * figures) << "kB in " << figures << " figures";
}

}  // namespace
}  // namespace warmjoint::report
