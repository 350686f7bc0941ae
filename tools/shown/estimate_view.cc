#include "tools/shown/estimate_view.h"

#include <warmjoint/identify.h>

#include "identification/answer/identify.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/identifier.h"
#include "identification/fit/seen_samples.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/report/report_fit.h"

namespace warmjoint::shown {
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

/// The options with which one of our identifiers made an estimate.
Options OptionsOf(const Identifier& identifier, const Estimate& estimate) {
  return identifier.options.Read(estimate.options, {"options of the estimate"});
}

/// The last samples of the recording beside the fit that has not seen them (hold_out.h), which is made again. Nothing
/// where the identifier is none of ours or gives no friction there.
std::optional<FitView> ViewHeldOut(const Estimate& estimate, const PreparedLog& log) {
  const Identifier* identifier = LookUpIdentifier(estimate.identifier);
  if (!identifier) return std::nullopt;
  const Options options = OptionsOf(*identifier, estimate);
  const IdentifierInput input{log, options, {}};

  // one that chooses a structure has chosen it on all samples
  const Fit all_data = estimate.choice ? identifier->fit(SelectSamples(*identifier, input)) : Fit{};
  const auto first = FitFirstPart(*identifier, input, HoldOutSource{}.fraction, all_data);
  if (!first) return std::nullopt;
  const PreparedLog before = log.Before(first->split);
  const LogView& fitted = SeenByModel(first->fit.model.inertia, identifier->view, before);
  Estimate made = ReportFit(first->fit, Infer(first->fit), before, fitted.measurements);
  if (!made.friction) return std::nullopt;

  // the rest, with the verdict on the whole
  made.status = estimate.status;
  const auto& [measurements, selection] =
      SeenByModel(ValueOf(Role::inertia, estimate), View::raw, log);
  return MakeFitView(measurements, From(first->split, measurements, selection), made);
}

}  // namespace

EstimateView MakeEstimateView(Estimate estimate, const PreparedLog& other) {
  EstimateView view{std::move(estimate), other.raw().measurements};
  view.fit = MakeFitView(other, view.estimate);
  return view;
}

Estimate WithFitAgain(Estimate estimate, const PreparedLog& log) {
  const Identifier* identifier = LookUpIdentifier(estimate.identifier);
  if (estimate.friction || !identifier) return estimate;
  const Options options = OptionsOf(*identifier, estimate);
  Estimate fit = IdentifyUnchecked(*identifier, {log, options, {}});
  estimate.parameters = std::move(fit.parameters);
  estimate.friction = std::move(fit.friction);
  estimate.gravity = std::move(fit.gravity);
  estimate.bands = std::move(fit.bands);
  return estimate;
}

EstimateView ViewOwnRecording(Estimate estimate, const PreparedLog& own) {
  EstimateView view = MakeEstimateView(WithFitAgain(std::move(estimate), own), own);
  if (view.estimate.holdout) view.held_out = ViewHeldOut(view.estimate, own);
  return view;
}

}  // namespace warmjoint::shown
