#include "tools/report/draw/canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tests/tools/report/look.h"

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
  return wanted ? std::atoi(wanted) : 80;
}

/// Every kind of thing that a figure may hold, small: a thousand take a minute.
Figure SmallFigure() {
  Plot plot;
  plot.x = plot.y = {"x", 0, 1, Scale::linear, {}};
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(500, 0, 1);
  plot.series = {
      {"line", Hue::blue, Line{ramp, ramp, 1}},
      {"", Hue::grey, Scatter{ramp, ramp, 1}},
      {"", Hue::green, Band{ramp, 0.5 * ramp, ramp}},
      {"", Hue::text, HeatMap{Eigen::MatrixXd::Ones(4, 4), {0, 1}, {0, 1}, {0, 2}, "z"}}};
  Figure figure;
  figure.title = "small";
  figure.width = 400;
  figure.height = 160;
  figure.columns = {1, 1};
  figure.panels = {{"plot", plot, 0, 0},
                   {"", Picture{Image{8, 8, std::vector<std::uint8_t>(192, 50)}}, 0, 1}};
  return figure;
}

TEST(Canvas, DoesNotGrowWithTheNumberOfFigures) {
  if (ResidentMemory() == 0) GTEST_SKIP() << "this system does not tell its memory";
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer keeps freed memory for a while";
#endif
  const Figure figure = SmallFigure();
  // drivers and allocators settle in the first
  for (int i = 0; i < 15; ++i) DrawFigure(figure);
  // what is kept of every figure grows in every block; an allocator's steps of some MB do not
  constexpr int kBlocks = 4;
  const int figures = FiguresToDraw() / kBlocks;
  const double before = ResidentMemory();
  double steadiest = 1e9;  // kB
  for (int block = 0; block < kBlocks; ++block) {
    const double begin = ResidentMemory();
    for (int i = 0; i < figures; ++i) DrawFigure(figure);
    steadiest = std::min(steadiest, ResidentMemory() - begin);
  }
  RecordProperty("growth_kB", static_cast<int>(ResidentMemory() - before));
  // one picture is 300 kB, its pixels 400 kB
  EXPECT_LT(steadiest, 50.0 * figures) << "kB in " << figures << " figures";
}

}  // namespace
}  // namespace warmjoint::report
