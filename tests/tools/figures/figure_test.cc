// Figures as data: what is written of them, and how it is thinned.
#include "tools/figures/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"
#include "tools/figures/reduce.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Figure FigureOf(const Shape& shape, double lower, double upper) {
  Plot plot;
  plot.x = plot.y = {"x", lower, upper};
  plot.series = {{"name", Hue::sky, shape}};
  Figure figure;
  figure.panels = {{"panel", plot}};
  return figure;
}

/// The shape of the first series, as it is read again.
Tree ShapeOf(const Figure& figure) {
  const Tree written = Tree::parse(FigureJson(figure).dump());
  return written["panels"][0]["content"]["series"][0]["shape"];
}

TEST(FigureJson, SaysOfEachThingWhichKindItIs) {
  const Figure figure =
      FigureOf(Line{Eigen::Vector2d(0, 1), Eigen::Vector2d(2, std::nan("")), 3}, 0, 1);
  // a number that is none is null in the text
  EXPECT_EQ(ShapeOf(figure).dump(),
            R"({"x":[0.0,1.0],"y":[2.0,null],"width":3.0,"dash":"solid","kind":"line"})");
  const Tree panel = FigureJson(figure)["panels"][0];
  EXPECT_EQ(panel["content"]["kind"], "plot");
  EXPECT_EQ(panel["content"]["x"]["scale"], "linear");
  EXPECT_EQ(panel["content"]["series"][0]["hue"], "sky");
  EXPECT_FALSE(panel.contains("frame"));
}

TEST(FigureJson, KeepsTheSpikesOfAMillionPoints) {
  constexpr Index kPoints = 1000000;
  const VectorXd x = VectorXd::LinSpaced(kPoints, 0, 1);
  VectorXd y = 0.3 * (5000 * x).array().sin();
  y[kPoints / 4] = 0.95;
  const Tree line = ShapeOf(FigureOf(Line{x, y}, 0, 1));
  EXPECT_LT(line["y"].size(), 9000u);
  EXPECT_THAT(line["y"], testing::Contains(Tree(0.95)));
}

TEST(ReduceCurve, BreaksWhereAColumnHasNothingAndAtTheLargestJumpWithinOne) {
  // ten columns of ten samples; all of the fourth are unknown, and samples 53 and 56
  const VectorXd x = VectorXd::LinSpaced(100, 0.005, 0.995);
  VectorXd y = x;
  y.tail(100 - 56).array() += 5;
  for (const Index i : {30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 53, 56}) y[i] = std::nan("");
  std::vector<Index> gaps;
  for (const Index i : ReduceCurve(x, y, {0, 1, 10})) {
    if (std::isnan(y[i])) gaps.push_back(i);
  }
  EXPECT_THAT(gaps, testing::ElementsAre(30, 56));
}

TEST(FigureJson, DrawsACloudWithASampleOfEachCell) {
  // a dense disc and stray samples about it
  constexpr Index kPoints = 200000;
  RandomStream random({4, 0}, Stream::test);
  VectorXd x(kPoints), y(kPoints);
  for (Index i = 0; i < kPoints; ++i) {
    const double radius = i % 5000 == 0 ? 1.5 : 0.3 * std::sqrt(random.Uniform(0, 1));
    const double angle = random.Uniform(0, 2 * M_PI);
    x[i] = radius * std::cos(angle);
    y[i] = radius * std::sin(angle);
  }
  const Tree cloud = ShapeOf(FigureOf(Scatter{x, y, 1}, -1.6, 1.6));
  EXPECT_LT(cloud["x"].size(), 20000u);
  int stray = 0;
  for (std::size_t i = 0; i < cloud["x"].size(); ++i) {
    stray += std::hypot(cloud["x"][i].get<double>(), cloud["y"][i].get<double>()) > 1;
  }
  EXPECT_GT(stray, 30) << "of 40, of which few may share a cell";
}

TEST(FigureCsv, HoldsEveryNumberWithAllItsDigits) {
  Plot plot;
  plot.x = {"time (s)", 0, 10};
  plot.y = {"torque (N·m)", -2, 2};
  const Eigen::Vector2d x(0, 1), y(1.0 / 3, std::nan(""));
  plot.series = {{"a, b", Hue::blue, Line{x, y}},
                 {"", Hue::blue, Band{x, y, 2 * y}},
                 {"", Hue::text, LevelLine{0.5}},
                 {"", Hue::text, HeatMap{Eigen::MatrixXd{{7}}, {0, 2}, {0, 4}, {0, 1}, "z"}},
                 {"", Hue::text, Note{0, 0, "words"}}};
  Figure figure;
  figure.panels = {{"", plot}, {"Words", Words{}}};
  EXPECT_EQ(FigureCsv(figure),
            "# panel 1: x is time (s); y is torque (N·m)\n"
            "panel,series,kind,x,y,lower,upper,value\n"
            "panel 1,\"a, b\",line,0,0.3333333333333333,,,\n"
            "panel 1,\"a, b\",line,1,,,,\n"
            "panel 1,series 2,band,0,,0.3333333333333333,0.6666666666666666,\n"
            "panel 1,series 2,band,1,,,,\n"
            "panel 1,series 3,level,,0.5,,,\n"
            "panel 1,series 4,cell,1,2,,,7\n");
}

TEST(SignificantText, RoundsAsPeopleDo) {
  EXPECT_EQ(SignificantText(15.0412), "15.0");
  EXPECT_EQ(SignificantText(-3.0), "−3.00");
  EXPECT_EQ(SignificantText(603.2), "603");
  EXPECT_EQ(SignificantText(-5.4e-5, 2), "−5.4·10⁻⁵");
  EXPECT_EQ(SignificantText(0), "0");
  EXPECT_EQ(SignificantText(0.09999, 2), "0.10") << "one more digit before the point";
  EXPECT_EQ(SignificantText(9.999e-5, 2), "1.0·10⁻⁴");
}

}  // namespace
}  // namespace warmjoint::figures
