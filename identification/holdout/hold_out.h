// Figures on samples that the fit has not seen.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"

namespace warmjoint {

/// A selection cut in time: what it keeps before a sample, and from it on.
struct SplitSelection {
  Eigen::Index at = 0;
  Selection first, rest;  // with the segments of the whole
};

/// Cut where the last samples are a share of those that take part, 0 < fraction < 1. Nothing where fewer than two come before
/// them, or none is left.
std::optional<SplitSelection> SplitOf(const Selection& selection, double fraction);

/// Whether the joint moves in both directions, at speeds that differ by more than a tenth. velocity: [N]; test: keeps one sample
/// at least
bool IsVaried(const Eigen::VectorXd& velocity, const Selection& test);

/// A fit to the samples before a time only.
struct FirstPart {
  double split = 0;  // s
  Fit fit;
};

/// Fits the first 1 - fraction of the samples that take part, 0 < fraction < 1; where the fit of all samples chose
/// a structure (Fit::structure), that one. Nothing where fewer than two samples are left.
std::optional<FirstPart> FitFirstPart(const Identifier& identifier, const IdentifierInput& input,
                                      double fraction, const Fit& all_data);

/// Figures on samples that a fit has not seen, or why there are none.
struct HeldOut {
  std::optional<Metrics> metrics;
  std::string why_none{};  // a clause; empty where there are figures, or none are asked for
  /// Whether the joint moves in both directions, at more than one speed, in the samples of the figures.
  bool varied = false;
  /// Rms that the same samples leave without friction: about their mean, or beside a description that is given. N.m or N
  double without_friction = 0;
};

/// FitFirstPart, evaluated on the kept samples of the
/// rest. The prediction starts with the recording, at E(0) where the fit estimates it, so that the
/// joint comes to the test part as warm as it was. Where each recording has an E(0) of its own, those
/// that begin in the rest are left out. 0 < fraction < 1. None where that fit gives no friction or the
/// rest keeps no sample.
HeldOut HoldOut(const Identifier& identifier, const IdentifierInput& input, double fraction,
                const Fit& all_data = {});

/// Evaluates a fit of the identifier on the kept samples of another recording, which starts cold.
/// None where the fit gives no friction.
HeldOut HoldOut(const Identifier& identifier, const Fit& fit, const PreparedLog& other);

/// Contiguous parts of a recording, each with its number of kept samples as equal as can be.
/// Returns the first sample of each, and N: [blocks + 1].
std::vector<Eigen::Index> CutIntoBlocks(const Selection& selection, int blocks);

/// What the fit to all other blocks leaves of each sample of a block, tau less its prediction, N.m or N. The samples of the
/// block are left out of the fit alone: they still warm the joint, in fit and prediction. Nothing
/// where a fit gives no friction or predicts no sample of its block. bounds: of CutIntoBlocks; returns [N], not a number for
/// samples that are not kept or not predicted.
std::optional<Eigen::VectorXd> UnseenResiduals(const Identifier& identifier,
                                               const IdentifierInput& input,
                                               const std::vector<Eigen::Index>& bounds);

struct TorquePrediction {
  Eigen::VectorXd torque;  // [N] as the log would hold it, N.m or N
  Selection covered;       // of the samples asked for, those where the model knows its gravity
  Prediction friction;
};

/// Along the motion from its first sample on, from `start`. Inertia acts where the log has an
/// acceleration (PreparedLog::moving). asked: samples that are to be compared.
TorquePrediction PredictTorque(const TorqueModel& model, const LogSamples& measurements,
                               Selection asked, const ThermalStart& start);

/// Compares the torque that the fit's friction, gravity and inertia predict along a log with the samples that
/// `test` keeps; where the fit knows its gravity only in places, with those there. The prediction
/// runs from the first sample on, from `start`. Nothing where the fit gives no
/// friction or no sample is left.
std::optional<Metrics> Evaluate(const Fit& fit, const LogSamples& measurements, Selection test,
                                const ThermalStart& start);

}  // namespace warmjoint
