// Rows of a fit to torque that has passed a first-order lag.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "identification/forward/row_products.h"
#include "identification/uncertainty/whitening.h"

namespace warmjoint {

/// The kept samples of a log, in runs: neighbours of one segment that are all kept.
struct KeptRuns {
  std::vector<Eigen::Index> samples;  // [n] of the log
  Eigen::VectorXd time;               // [n] s
  std::vector<SampleRange> runs;      // [R] of places among all n, in order of time

  Eigen::Index count() const { return static_cast<Eigen::Index>(samples.size()); }
  Eigen::Index run_count() const { return static_cast<Eigen::Index>(runs.size()); }
  /// Time between two samples, the median within runs, s.
  double Step() const;
  /// Duration of a run, the median, s.
  double Duration() const;
};

/// A run ends where a sample is left out, a segment begins, or the joint is cold again
/// (LogSamples::Recordings).
KeptRuns FindRuns(const LogSamples& measurements, const Selection& selection);

/// What a log holds of a torque f after a lag T (low_pass.h) in each run of samples:
///
///     tau = L f + d exp(-(t - t0) / T) + noise,
///
/// L the lag settled on the run's first sample. d is the remainder in the lag of all torque before the run, of the
/// ramp, its inertia and the friction of the run before. None of these need be known, since each run has a
/// d of its own, and the rows are those orthogonal to exp(-(t - t0) / T), so that the other unknowns are
/// fitted as if together with all d. Exact, and linear in f.
class LaggedRows final : public RowTransform {
 public:
  /// lag: T > 0, s; whitening: of the noise of tau, which must not reach from one run to the next
  /// (WhiteningOfRuns); or none.
  LaggedRows(std::shared_ptr<const KeptRuns> runs, double lag,
             std::shared_ptr<const Whitening> whitening = nullptr);

  /// W P L rows: after the lag, whitened, and without what any d explains.
  void Apply(Rows& rows) const override;
  Eigen::Index size() const override { return runs_->count(); }

  /// The torque whose L is the one given, so that a fit may subtract its model before Apply. The two
  /// may differ by some d exp(-(t - t0) / T). torque: [n]
  Eigen::VectorXd BeforeLag(const Eigen::VectorXd& torque) const;
  /// L rows. [n x q]
  Eigen::MatrixXd Lagged(const Eigen::MatrixXd& rows) const;
  /// The d that explain most of the rows, by the noise's colour. rows: [n x q]; returns [R x q].
  Eigen::MatrixXd InitialStates(const Eigen::MatrixXd& rows) const;
  /// d exp(-(t - t0) / T). held: [R x q]; returns [n x q].
  Eigen::MatrixXd Decaying(const Eigen::MatrixXd& held) const;
  /// L f + d exp(-(t - t0) / T) with the d that explain the residual of L f: f as the log would show it. torque: f;
  /// measured: [n]
  Eigen::VectorXd FittedTo(const Eigen::VectorXd& measured, const Eigen::VectorXd& torque) const;

  double lag() const { return lag_; }
  const std::shared_ptr<const KeptRuns>& runs() const { return runs_; }
  const std::shared_ptr<const Whitening>& whitening() const { return whitening_; }

 private:
  void Lag(Rows& rows) const;

  std::shared_ptr<const KeptRuns> runs_;
  double lag_;
  std::shared_ptr<const Whitening> whitening_;
  Eigen::VectorXd share_;   // [n] of a step that the lag follows from the sample before to this one
  Eigen::VectorXd dying_;   // [n] exp(-(t - t0) / T)
  Eigen::VectorXd across_;  // [n] W of that, of length 1 in each run
  Eigen::VectorXd length_;  // [R] of W of it
};

/// Whitening by a colour of noise that every run has by itself.
std::shared_ptr<const Whitening> WhiteningOfRuns(const NoiseModel& noise, const KeptRuns& runs);

}  // namespace warmjoint
