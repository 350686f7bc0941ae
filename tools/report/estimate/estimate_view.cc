#include "tools/report/estimate/estimate_view.h"

#include "identification/find_parameter.h"
#include "identification/preparation/moving_view.h"
#include "tools/actions/fit_again.h"
#include "tools/actions/identify_recording.h"

namespace warmjoint::report {
namespace {

/// The kept samples from a time (s) on.
Selection From(double time, const Measurements& measurements, Selection selection) {
  for (Eigen::Index i = 0; i < measurements.size() && measurements.time[i] < time; ++i) {
    selection.keep[i] = false;
  }
  std::erase_if(selection.segments,
                [&](const Segment& segment) { return measurements.time[segment.begin] < time; });
  return selection;
}

}  // namespace

EstimateView MakeEstimateView(Estimate estimate) {
  return {std::move(estimate), std::nullopt, std::nullopt, std::nullopt};
}

EstimateView MakeEstimateView(Estimate estimate, const PreparedLog& other) {
  EstimateView view = MakeEstimateView(std::move(estimate));
  view.measurements = other.taken().measurements;
  view.fit = MakeFitView(other, view.estimate);
  return view;
}

EstimateView ViewOwnRecording(Estimate estimate, const PreparedLog& own) {
  EstimateView view = MakeEstimateView(WithFitAgain(std::move(estimate), own), own);
  if (!view.estimate.holdout) return view;
  const auto& [measurements, selection] =
      Find(Role::inertia, view.estimate) ? MovingView(own) : own.taken();
  if (const auto first = FitFirstPartAgain(view.estimate, own, HoldOutSource{}.fraction)) {
    view.held_out =
        MakeFitView(measurements, From(first->split, measurements, selection), first->estimate);
  }
  return view;
}

}  // namespace warmjoint::report
