// How long pictures take.
#include <benchmark/benchmark.h>

#include "models/foundation/random_stream.h"
#include "tools/report/draw/draw_figure.h"

namespace warmjoint::report {
namespace {

enum class Shape { line, dots };

/// A figure of one plot with noise over time. points: N.
Figure Noise(Eigen::Index points, Shape shape) {
  RandomStream random({5, 0}, Stream::test);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(points, 0, 1), y(points);
  for (double& value : y) value = random.Normal();
  Plot plot;
  plot.x = {"time (s)", 0, 1, Scale::linear, {}};
  plot.y = {"torque (N·m)", -5, 5, Scale::linear, {}};
  if (shape == Shape::dots) {
    plot.series.push_back({"samples", Hue::grey, Scatter{x, y, 1}});
  } else {
    plot.series.push_back({"samples", Hue::blue, Line{x, y, 1}});
  }
  Figure figure;
  figure.width = 960;
  figure.panels.push_back({"", plot});
  return figure;
}

void DrawOnce(benchmark::State& state, Shape shape) {
  const Figure figure = Noise(state.range(0), shape);
  for (auto step : state) {
    const Drawn drawn = DrawFigure(figure);
    state.counters["marks"] = static_cast<double>(drawn.plots[0].series[0].points);
  }
}

void DrawLine(benchmark::State& state) { DrawOnce(state, Shape::line); }
void DrawDots(benchmark::State& state) { DrawOnce(state, Shape::dots); }

BENCHMARK(DrawLine)->Arg(1000)->Arg(1000000)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);
BENCHMARK(DrawDots)->Arg(1000)->Arg(1000000)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace warmjoint::report
