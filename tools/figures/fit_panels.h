// The panels of a story about one recording; each may stand in a figure of its own.
#pragma once

#include "identification/lack_of_fit/table.h"
#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// sign(v) torque over time at the kept samples with the fit: how the level of friction falls.
Plot LevelOverTime(const FitView& view);

/// Means over the kept samples of each segment, as strokes from its first sample to its last. values: [N].
Line SegmentMeans(const FitView& fit, const Eigen::VectorXd& values);

/// Part of a recording, samples [begin, end).
struct Window {
  Eigen::Index begin = 0;
  Eigen::Index end = 0;

  /// The values within it. all: [N].
  Eigen::VectorXd Of(const Eigen::VectorXd& all) const { return all.segment(begin, end - begin); }
};

/// The first and the last `segments` moving segments, half of them where they are few, and a little
/// around them; a twelfth of a recording without.
Window ColdWindow(const FitView& view, int segments = 6);
Window WarmWindow(const FitView& view, int segments = 6);

/// Torque and fit as they were logged.
Plot CloseUp(const FitView& view, const Window& window, const Axis& torque);
/// An axis that holds the torque of both windows at constant speed.
Axis TorqueAxis(const FitView& view, const Window& a, const Window& b);

/// Torque over velocity: samples, the fitted curve cold and warm with their 95 % bands where these
/// are wider than a line. With maps, the mean at each speed over the places where the joint moved so.
Plot FrictionCurve(const FitView& view);

/// E over time with its 95 % band, over what the samples say of it, Eq. (23).
Plot WarmUpCurve(const FitView& view);

/// Residuals over one of these with their median in 40 bins: flat where the model is complete.
Plot ResidualsOver(const FitView& view, SeenOver what);

/// Correlation of residuals with those one sample later and more, over a logarithmic axis; within
/// the dashed lines where white.
Plot ResidualMemory(const FitView& view);

/// Correlation of the residuals with those `lag` samples later, over pairs that are both kept.
double ResidualCorrelation(const FitView& view, Eigen::Index lag);

/// Parameters with units and 95 % intervals.
Table ParametersOf(const FitView& view);

/// Verdict, agreement and data used, in words.
Words VerdictOf(const FitView& view);

/// The verdict in one sentence.
std::string VerdictSentence(const FitView& view);

}  // namespace warmjoint::figures
