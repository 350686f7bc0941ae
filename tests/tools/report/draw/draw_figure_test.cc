#include "tools/report/draw/draw_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/random_stream.h"
#include "tests/tools/report/look.h"
#include "tools/report/draw/figure_data.h"
#include "tools/report/draw/reduce.h"
#include "tools/report/draw/ticks.h"

namespace warmjoint::report {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using ::testing::ElementsAre;
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

TEST(FigureCsv, HoldsEveryNumberWithAllItsDigits) {
  Plot plot;
  plot.x = {"time (s)", 0, 10, Scale::linear, {}};
  plot.y = {"torque (N·m)", -2, 2, Scale::linear, {}};
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

std::vector<std::string> Labels(const Axis& axis, int wanted) {
  std::vector<std::string> labels;
  for (const Tick& tick : AxisTicks(axis, wanted)) labels.push_back(tick.label);
  return labels;
}

TEST(AxisTicks, AreRoundAndInsideTheLimits) {
  EXPECT_THAT(Labels({"", 0, 10, Scale::linear, {}}, 5),
              ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(Labels({"", -0.3, 0.31, Scale::linear, {}}, 4), ElementsAre("−0.2", "0", "0.2"));
  EXPECT_THAT(Labels({"", -6e-5, 1e-6, Scale::linear, {}}, 4),
              ElementsAre("−6·10⁻⁵", "−4·10⁻⁵", "−2·10⁻⁵", "0"));
}

TEST(AxisTicks, AreDecadesOnLogarithmicAxes) {
  EXPECT_THAT(Labels({"", 0.5, 2000, Scale::logarithmic, {}}, 5),
              ElementsAre("1", "10", "100", "1000"));
  EXPECT_THAT(Labels({"", 0.9, 11, Scale::logarithmic, {}}, 6), ElementsAre("1", "2", "5", "10"));
  EXPECT_THAT(Labels({"", 1e-6, 1e-2, Scale::logarithmic, {}}, 5),
              ElementsAre("10⁻⁶", "10⁻⁵", "10⁻⁴", "0.001", "0.01"));
}

TEST(AxisTicks, ShareOnePowerOfTen) {
  EXPECT_THAT(Labels({"", 0, 2.2e-4, Scale::linear, {}}, 5),
              ElementsAre("0", "0.5·10⁻⁴", "1.0·10⁻⁴", "1.5·10⁻⁴", "2.0·10⁻⁴"));
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
