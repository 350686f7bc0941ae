#include "tools/figures/estimate_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "identification/answer/identify.h"
#include "identification/estimate.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "tests/support/judging.h"
#include "tests/tools/figures/look.h"
#include "tests/tools/figures/warm_recording.h"
#include "tools/figures/symbols.h"

namespace warmjoint::figures {
namespace {

using ::testing::HasSubstr;

/// Parameters that close in on the truth.
void AddTrace(Estimate& estimate, int iterations) {
  for (int k = 0; k < iterations; ++k) {
    const double off = std::pow(0.5, k);
    TraceEntry entry{k, {}, 0.5 + off};
    for (const EstimatedParameter& parameter : estimate.parameters) {
      entry.parameters.emplace_back(parameter.name, parameter.value * (1 + off));
    }
    estimate.trace.push_back(entry);
  }
}

EstimateView ExampleView() {
  MappedRecording mapped;
  AddTrace(mapped.estimate, 8);
  EstimateView view{mapped.estimate, mapped.measurements, std::nullopt};
  view.fit = mapped.View();
  view.fit->estimate = view.estimate;
  view.held_out = view.fit;
  return view;
}

TEST(EstimateFigures, AreTidyAndNamedAsTheirFiles) {
  const auto shown = LookAtAll(EstimateFigures(), ExampleView());
  for (const EstimateFigure& one : EstimateFigures()) {
    // the envelope of a ripple would guess a wrong warming
    EXPECT_EQ(shown.contains(one.name), one.name != "envelope") << one.name;
  }
}

TEST(EstimateFigures, ShowWhatTheEstimateAloneTellsWithoutItsRecording) {
  EstimateView view = ExampleView();
  view = EstimateView{view.estimate};
  for (const EstimateFigure& one : EstimateFigures()) {
    EXPECT_EQ(one.make(view).has_value(), one.name == "trace") << one.name;
  }
}

TEST(EstimateFigures, ShowTheRecordingAloneWithoutAFriction) {
  EstimateView view = ExampleView();
  view.estimate.friction.reset();
  view.estimate.trace.clear();
  view = MakeEstimateView(view.estimate, Prepare(*view.measurements));
  std::vector<std::string> names;
  for (const auto& [name, shown] : LookAtAll(EstimateFigures(), view)) {
    names.push_back(name);
    EXPECT_FALSE(shown.plots.empty()) << name;
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("fit", "log", "hysteresis", "motor_angle"));
}

TEST(EstimateFigures, ShowTheFitOfARefusedEstimateWithItsOptions) {
  const PreparedLog log = Prepare(WarmRecording().measurements);
  // a law that knows no warming of a joint that warms, as its file holds it after a verdict
  const Estimate answer = test::Answer("nominal-ls", log, {{"law", "coulomb"}});
  const Estimate refused = EstimateFrom({EstimateToTree(answer), "estimate.json"});
  ASSERT_NE(refused.status, Status::ok);
  ASSERT_FALSE(refused.friction.has_value());
  const EstimateView view = ViewOwnRecording(refused, log);
  ASSERT_TRUE(view.fit->has_fit);
  EXPECT_TRUE(view.fit->is_void());
  EXPECT_EQ(view.estimate.friction->law, "coulomb");
  EXPECT_EQ(view.estimate.parameters.size(), 1u);
}

TEST(EstimateFigures, PredictTheHeldOutSamplesByAFitThatHasNotSeenThem) {
  const PreparedLog log = Prepare(WarmRecording().measurements);
  const Identifier& identifier = FindIdentifier("energy-ml");
  const Options options = identifier.options.Read({});
  const IdentifierInput input{log, options, {}};
  Estimate estimate = IdentifyAndCheck(identifier, input);
  estimate.holdout = HoldOut(identifier, input, 0.3).metrics;
  const EstimateView view = ViewOwnRecording(estimate, log);
  ASSERT_TRUE(view.held_out.has_value());
  EXPECT_EQ(view.held_out->selection.count(), estimate.holdout->n);
  const double rmse = std::sqrt(Residuals(*view.held_out).array().square().mean());
  EXPECT_NEAR(rmse, estimate.holdout->rmse, 1e-9 * rmse) << "the same fit and the same samples";
  EXPECT_FALSE(MakeEstimateView(estimate, log).held_out.has_value()) << "of another recording";
}

TEST(Trace, ShowsEachParameterByIterationWithItsFinalInterval) {
  const EstimateView view = ExampleView();
  const Figure figure = *MakeTrace(view.estimate, "warm.csv");
  const Shown drawn = Look(figure);
  ASSERT_EQ(drawn.plots.size(), 5u) << "four parameters and the RMSE";
  const ShownPlot& gain = PlotNamed(drawn, "thermal_gain, k");
  EXPECT_EQ(gain.series[0].label, "final 95 % interval");
  EXPECT_EQ(gain.series[0].y, std::pair(-3.1, -2.9));
  EXPECT_EQ(gain.series[1].x, std::pair(0.0, 7.0));
  EXPECT_EQ(gain.series[1].y.first, -6) << "twice the truth at first";
  EXPECT_EQ(gain.series[1].hue, IdentifierHue("energy-ml"));
  const ShownPlot& fit = PlotNamed(drawn, "Root mean square error of the fit");
  EXPECT_EQ(fit.series[0].y.second, 1.5);
  EXPECT_THAT(figure.finding, HasSubstr("viscous 10.0 to 5.04"));
}

}  // namespace
}  // namespace warmjoint::figures
