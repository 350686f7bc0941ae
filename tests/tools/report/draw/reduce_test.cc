#include "tools/report/draw/reduce.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"
#include "tests/tools/report/look.h"

namespace warmjoint::report {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// How many inked pixels of a picture have no ink of another within a pixel.
int Astray(const Image& image, const Image& other) {
  const auto inked = [](const Image& picture, int x, int y) {
    return x >= 0 && y >= 0 && x < picture.width && y < picture.height &&
           Distance(picture.At(x, y), LightTheme().background) > 60;
  };
  int astray = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!inked(image, x, y)) continue;
      bool near = false;
      for (int i = 0; i < 9; ++i) near = near || inked(other, x + i % 3 - 1, y + i / 3 - 1);
      astray += !near;
    }
  }
  return astray;
}

TEST(ReduceCloud, DrawsTheSameCloudWithATenthOfTheMarks) {
  // a dense disc and stray samples about it
  constexpr Index kPoints = 60000;
  RandomStream random({4, 0}, Stream::test);
  VectorXd x(kPoints), y(kPoints);
  for (Index i = 0; i < kPoints; ++i) {
    const double radius = i % 500 == 0 ? 1.5 : 0.6 * std::sqrt(random.Uniform(0, 1));
    const double angle = random.Uniform(0, 2 * M_PI);
    x[i] = radius * std::cos(angle);
    y[i] = radius * std::sin(angle);
  }
  Figure figure;
  figure.width = figure.height = 200;
  Plot plot;
  plot.x = plot.y = {"x", -1.6, 1.6, Scale::linear, {}};
  plot.series = {{"", Hue::blue, Scatter{x, y, 1}}};
  figure.panels = {{"cloud", plot}};
  const Drawn reduced = DrawFigure(figure);

  // parts so small that each of their markers is drawn
  constexpr Index kParts = 100;
  plot.series.clear();
  for (Index part = 0; part < kParts; ++part) {
    const auto own = Eigen::seqN(part, kPoints / kParts, kParts);
    plot.series.push_back({"", Hue::blue, Scatter{x(own), y(own), 1}});
  }
  figure.panels = {{"cloud", plot}};
  const Drawn whole = DrawFigure(figure);
  Index markers = 0;
  for (const DrawnSeries& series : whole.plots[0].series) markers += series.points;
  EXPECT_LT(reduced.plots[0].series[0].points, markers / 10);
  // what either shows, the other shows within a pixel
  EXPECT_EQ(Astray(whole.image, reduced.image), 0);
  EXPECT_EQ(Astray(reduced.image, whole.image), 0);
}

TEST(ReduceCurve, DrawsAMillionPointsWithTheirSpikes) {
  Figure figure;
  figure.name = "million";
  figure.finding = "One spike.";
  const Index n = 1000000;
  const VectorXd x = VectorXd::LinSpaced(n, 0, 1);
  VectorXd y = 0.3 * (5000 * x).array().sin();
  y[n / 4] = 0.95;
  Plot plot;
  plot.x = {"x", 0, 1, Scale::linear, {}};
  plot.y = {"y", -1, 1, Scale::linear, {}};
  plot.series = {{"", Hue::blue, Line{x, y, 1.5}}};
  figure.panels = {{"curve", plot}};
  const Drawn drawn = DrawFigure(figure);
  EXPECT_TRUE(HasColourNear(drawn.image, PixelOf(drawn.plots[0], 0.25, 0.9),
                            LightTheme().Colour(Hue::blue)));
}

}  // namespace
}  // namespace warmjoint::report
