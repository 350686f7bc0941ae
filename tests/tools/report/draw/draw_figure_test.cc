#include "tools/report/draw/draw_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "tests/tools/report/look.h"

namespace warmjoint::report {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using ::testing::HasSubstr;

/// One panel whose single series is a line through two points of unequal axes.
Figure OneLine() {
  Figure figure;
  figure.name = "line";
  figure.title = "Title";
  figure.subtitle = "Subtitle";
  figure.finding = "A line.";
  figure.width = 400;
  figure.height = 300;
  Plot plot;
  plot.x = {"time (s)", 0, 10, Scale::linear, {}};
  plot.y = {"torque (N·m)", -2, 2, Scale::linear, {}};
  plot.series.push_back({"measured", Hue::blue, Line{Vector2d(0, 8), Vector2d(-1, 1.5), 3}});
  figure.panels.push_back({"Panel", plot});
  return figure;
}

TEST(DrawFigure, HandsOverLimitsDataAndColour) {
  const Drawn drawn = DrawTidy(OneLine());
  const DrawnPlot& plot = PlotNamed(drawn, "Panel");
  EXPECT_EQ(plot.x, std::pair(0.0, 10.0));
  EXPECT_EQ(plot.y, std::pair(-2.0, 2.0));
  const DrawnSeries& series = SeriesNamed(plot, "measured");
  EXPECT_EQ(series.points, 2);
  EXPECT_EQ(series.x, std::pair(0.0, 8.0));
  EXPECT_EQ(series.y, std::pair(-1.0, 1.5));
  EXPECT_EQ(series.colour, LightTheme().Colour(Hue::blue));
}

TEST(DrawFigure, PutsXToTheRightAndYUpwards) {
  const Drawn drawn = DrawTidy(OneLine());
  const DrawnPlot& plot = PlotNamed(drawn, "Panel");
  const Rgb blue = LightTheme().Colour(Hue::blue);
  // the middle of the line, and what it would be with axes swapped or turned over
  EXPECT_TRUE(HasColourNear(drawn.image, PixelOf(plot, 4, 0.25), blue));
  EXPECT_TRUE(HasColourNear(drawn.image, PixelOf(plot, 8, 1.5), blue));
  EXPECT_FALSE(HasColourNear(drawn.image, PixelOf(plot, 8, -1.5), blue));
  EXPECT_FALSE(HasColourNear(drawn.image, PixelOf(plot, 2, 1), blue));
}

TEST(DrawFigure, PutsPointsOnLogarithmicAxesByTheirLogarithm) {
  Figure figure = OneLine();
  auto& plot = std::get<Plot>(figure.panels[0].content);
  plot.x = {"iteration", 1, 1000, Scale::logarithmic, {}};
  plot.y = {"error (%)", 0.1, 1000, Scale::logarithmic, {}};
  plot.series[0].shape = Scatter{Vector2d(10, 100), Vector2d(1, 100), 6};
  const Drawn drawn = DrawTidy(figure);
  const Rgb blue = LightTheme().Colour(Hue::blue);
  const auto at = [&](double x, double y) {
    return PixelOf(drawn.plots[0], x, y, Scale::logarithmic, Scale::logarithmic);
  };
  EXPECT_TRUE(HasColourNear(drawn.image, at(10, 1), blue, 0));
  EXPECT_TRUE(HasColourNear(drawn.image, at(100, 100), blue, 0));
  EXPECT_FALSE(HasColourNear(drawn.image, at(10, 10), blue, 0));
}

TEST(DrawFigure, WritesEveryWord) {
  const Drawn drawn = DrawTidy(OneLine());
  std::vector<std::string> words;
  for (const DrawnText& text : drawn.texts) words.push_back(text.text);
  EXPECT_THAT(words, ::testing::IsSupersetOf({"Title", "Subtitle", "Panel", "time (s)",
                                              "torque (N·m)", "measured", "0", "10", "−2.0"}));
}

TEST(DrawFigure, GivesTheSameBytesWhateverWasDrawnBefore) {
  const std::string first = EncodePng(DrawFigure(OneLine()).image, "alt");
  Figure other = OneLine();
  other.title = "Other letters: xyzäöüβγ";
  DrawFigure(other, DarkTheme());
  EXPECT_EQ(EncodePng(DrawFigure(OneLine()).image, "alt"), first);
}

TEST(DrawFigure, ShowsBandsBarsBoxesLevelsAndHeatMapsWhereTheyBelong) {
  Figure figure = OneLine();
  auto& plot = std::get<Plot>(figure.panels[0].content);
  Box box{8, -1.5, -1, 0.3, 1, 1.5, VectorXd::Constant(1, 1.9), 1};
  plot.series = {
      {"band", Hue::green, Band{Vector2d(0, 2), Vector2d(-1, -1), Vector2d(1, 1), 1.0}},
      {"bars", Hue::orange, Bars{VectorXd::Constant(1, 4), VectorXd::Constant(1, 1.5), 1}},
      {"box", Hue::purple, box},
      {"level", Hue::vermilion, LevelLine{-1.8, Dash::solid}}};
  const Drawn drawn = DrawTidy(figure);
  const DrawnPlot& drawn_plot = drawn.plots[0];
  const auto has = [&](double x, double y, Hue hue) {
    return HasColourNear(drawn.image, PixelOf(drawn_plot, x, y), LightTheme().Colour(hue), 1);
  };
  EXPECT_TRUE(has(1, 0, Hue::green));
  EXPECT_FALSE(has(1, 1.2, Hue::green));
  EXPECT_TRUE(has(4, 1.4, Hue::orange));
  EXPECT_FALSE(has(4, -0.2, Hue::orange));
  EXPECT_TRUE(has(7.8, 0.3, Hue::purple));
  EXPECT_TRUE(has(8, 1.9, Hue::purple));
  EXPECT_TRUE(has(5, -1.8, Hue::vermilion));

  HeatMap map;
  map.values = Eigen::MatrixXd{{0, 1}, {1, 1}};
  map.x = {0, 10};
  map.y = {-2, 2};
  map.colours = {0, 1};
  map.label = "friction (N·m)";
  plot.series = {{"", Hue::text, map}};
  const Drawn heat = DrawTidy(figure);
  const Rgb low =
      heat.image.At(PixelOf(heat.plots[0], 2.5, -1).x, PixelOf(heat.plots[0], 2.5, -1).y);
  const Rgb high =
      heat.image.At(PixelOf(heat.plots[0], 7.5, 1).x, PixelOf(heat.plots[0], 7.5, 1).y);
  EXPECT_LT(low.red + low.green, 120) << "row 0, column 0 stands at the lower left";
  EXPECT_GT(high.red + high.green, 400);
}

TEST(EncodeFigure, GivesTheSameBytesOfEachFormatWhateverWasDrawnBefore) {
  for (FileFormat format : {FileFormat::png, FileFormat::svg, FileFormat::pdf}) {
    PageSetting setting;
    setting.format = format;
    Figure figure = OneLine();
    // an image inside: cairo numbers them through the process
    HeatMap map{Eigen::MatrixXd{{0, 1}}, {0, 10}, {-2, 2}, {0, 1}, "z"};
    std::get<Plot>(figure.panels[0].content).series.push_back({"", Hue::text, map});
    const std::string first = EncodeFigure(figure, setting).bytes;
    setting.style = StyleNamed("paper");
    EncodeFigure(figure, setting);
    setting.style = StyleNamed("screen");
    EXPECT_TRUE(EncodeFigure(figure, setting).bytes == first) << NameOf(format);
  }
}

TEST(EncodeFigure, WritesWordsAsWords) {
  Figure figure = OneLine();
  figure.panels[0].title = "k_{v} < 1 & more";
  PageSetting setting;
  setting.format = FileFormat::svg;
  const std::string svg = EncodeFigure(figure, setting).bytes;
  for (const char* words : {">Title</text>", ">torque (N·m)</text>", ">k</text>", ">v</text>",
                            "> &lt; 1 &amp; more</text>", "<desc>A line.</desc>"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
  EXPECT_THAT(svg, HasSubstr("width=\"400pt\" height=\"300pt\""));
}

TEST(EncodeFigure, IsAsLargeAsAsked) {
  PageSetting setting;
  setting.style = StyleNamed("paper");
  setting.width = 88;
  setting.height = 60;
  const PictureFile file = EncodeFigure(OneLine(), setting);
  EXPECT_NEAR(file.width, 88 * 72 / 25.4, 1e-9) << "points";
  EXPECT_NEAR(file.height, 60 * 72 / 25.4, 1e-9);
  // 300 pixels an inch
  const auto number = [&](std::size_t at) {
    return static_cast<unsigned char>(file.bytes[at]) * 256 +
           static_cast<unsigned char>(file.bytes[at + 1]);
  };
  EXPECT_EQ(number(18), 1039);
  EXPECT_EQ(number(22), 709);
  setting.height = 20;
  EXPECT_THROW(EncodeFigure(OneLine(), setting), BadInput) << "no room between the axes";
}

TEST(EncodeFigure, ThinsAHundredThousandSamplesAndSaysSo) {
  constexpr Eigen::Index kSamples = 100000;
  const VectorXd x = VectorXd::LinSpaced(kSamples, 0, 10);
  VectorXd y(kSamples);
  for (Eigen::Index i = 0; i < kSamples; ++i)
    y[i] = std::sin(x[i]) + 0.3 * std::sin(1e4 * x[i] * x[i]);
  Figure figure = OneLine();
  figure.width = 960;
  auto& plot = std::get<Plot>(figure.panels[0].content);
  plot.series = {{"dots", Hue::grey, Scatter{x, y, 1}}, {"line", Hue::blue, Line{x, y, 1}}};
  PageSetting setting;
  for (FileFormat format : {FileFormat::svg, FileFormat::pdf}) {
    setting.format = format;
    const PictureFile file = EncodeFigure(figure, setting);
    EXPECT_LT(file.bytes.size(), 300000u) << NameOf(format);
    EXPECT_THAT(file.caption, HasSubstr("thinned; no extreme is lost"));
  }
  EXPECT_EQ(EncodeFigure(OneLine(), setting).caption, "A line.");
}

}  // namespace
}  // namespace warmjoint::report
