#include "identification/lagged/lagged_rows.h"

#include <cmath>
#include <set>
#include <utility>

#include "models/foundation/low_pass.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kApart = 1000;  // sampling intervals between runs, as far as a gap counts

}  // namespace

double KeptRuns::Step() const {
  std::vector<double> steps;
  for (const SampleRange& run : runs) {
    for (Eigen::Index i = run.first + 1; i < run.end(); ++i) steps.push_back(time[i] - time[i - 1]);
  }
  return MedianOf(steps);
}

double KeptRuns::Duration() const {
  std::vector<double> durations;
  for (const SampleRange& run : runs) durations.push_back(time[run.end() - 1] - time[run.first]);
  return MedianOf(durations);
}

KeptRuns FindRuns(const LogSamples& m, const Selection& selection) {
  // where a run ends although no sample is left out
  std::set<Eigen::Index> breaks(m.further_starts.begin(), m.further_starts.end());
  for (const Segment& segment : selection.segments) breaks.insert(segment.begin);

  KeptRuns found;
  for (Eigen::Index i = 0; i < selection.keep.size(); ++i) {
    if (!selection.keep[i]) continue;
    // a sample that is left out ends the run as well
    const bool goes_on = !found.samples.empty() && found.samples.back() == i - 1;
    if (!goes_on || breaks.contains(i)) found.runs.push_back({found.count(), 0});
    found.samples.push_back(i);
    ++found.runs.back().count;
  }

  // when the kept samples were taken
  found.time = m.time(found.samples);
  return found;
}

LaggedRows::LaggedRows(std::shared_ptr<const KeptRuns> runs, double lag,
                       std::shared_ptr<const Whitening> whitening)
    : runs_(std::move(runs)), lag_(lag), whitening_(std::move(whitening)) {
  // the share by which the lag follows in each step, and the part that is left of the value with which a run began
  share_.setZero(size());
  dying_.setOnes(size());
  for (const SampleRange& run : runs_->runs) {
    for (Index i = run.first + 1; i < run.end(); ++i) {
      share_[i] = ShareFollowed(runs_->time[i] - runs_->time[i - 1], lag_);
      dying_[i] = (1 - share_[i]) * dying_[i - 1];
    }
  }

  // the response to d as the whitened rows hold it, of length 1 in each run
  across_ = whitening_ ? whitening_->Of(dying_).col(0) : dying_;
  length_.resize(runs_->run_count());
  for (Index r = 0; r < length_.size(); ++r) {
    const SampleRange& run = runs_->runs[static_cast<std::size_t>(r)];
    length_[r] = across_.segment(run.first, run.count).norm();
    across_.segment(run.first, run.count) /= length_[r];
  }
}

void LaggedRows::Lag(Rows& rows) const {
  Eigen::RowVectorXd before, held;
  for (const SampleRange& run : runs_->runs) {
    // settled on the first sample of the run
    before = held = rows.row(run.first);
    for (Index i = run.first + 1; i < run.end(); ++i) {
      // towards the sample before, held until this one
      held += share_[i] * (before - held);
      before = rows.row(i);
      rows.row(i) = held;
    }
  }
}

void LaggedRows::Apply(Rows& rows) const {
  Lag(rows);
  if (whitening_) whitening_->Apply(rows);

  // subtract what any d explains, which is the part along its response
  for (const SampleRange& run : runs_->runs) {
    const auto across = across_.segment(run.first, run.count);
    auto part = rows.middleRows(run.first, run.count);
    const Eigen::RowVectorXd along = across.transpose() * part;
    part.noalias() -= across * along;
  }
}

VectorXd LaggedRows::BeforeLag(const VectorXd& torque) const {
  VectorXd before = torque;
  for (const SampleRange& run : runs_->runs) {
    // the step of the lag, solved for the torque that it followed
    for (Index i = run.first + 1; i < run.end(); ++i) {
      before[i - 1] = torque[i - 1] + (torque[i] - torque[i - 1]) / share_[i];
    }
  }
  return before;
}

MatrixXd LaggedRows::Lagged(const MatrixXd& rows) const {
  Rows lagged = rows;
  Lag(lagged);
  return lagged;
}

MatrixXd LaggedRows::InitialStates(const MatrixXd& rows) const {
  const MatrixXd white = whitening_ ? whitening_->Of(rows) : rows;

  // least squares of each run on the whitened response to d
  MatrixXd held(runs_->run_count(), rows.cols());
  for (Index r = 0; r < held.rows(); ++r) {
    const SampleRange& run = runs_->runs[static_cast<std::size_t>(r)];
    held.row(r) = across_.segment(run.first, run.count).transpose() *
                  white.middleRows(run.first, run.count) / length_[r];
  }
  return held;
}

MatrixXd LaggedRows::Decaying(const MatrixXd& held) const {
  MatrixXd dying(size(), held.cols());
  for (Index r = 0; r < held.rows(); ++r) {
    const SampleRange& run = runs_->runs[static_cast<std::size_t>(r)];
    dying.middleRows(run.first, run.count) = dying_.segment(run.first, run.count) * held.row(r);
  }
  return dying;
}

VectorXd LaggedRows::FittedTo(const VectorXd& measured, const VectorXd& torque) const {
  const VectorXd lagged = Lagged(torque);
  return lagged + Decaying(InitialStates(measured - lagged));
}

std::shared_ptr<const Whitening> WhiteningOfRuns(const NoiseModel& noise, const KeptRuns& runs) {
  std::vector<Index> places(runs.samples.size());
  Index next = 0;
  const double step = runs.Step();
  for (const SampleRange& run : runs.runs) {
    const Index first = next;
    // its place on a grid of the typical step, in any case after the sample before
    for (Index i = run.first; i < run.end(); ++i) {
      const auto on = first + std::llround((runs.time[i] - runs.time[run.first]) / step);
      next = places[static_cast<std::size_t>(i)] =
          std::max<Index>(on, i > run.first ? next + 1 : on);
    }
    // the next run is so much later that the noise of one run is not correlated with the next
    next += kApart;
  }
  return std::make_shared<const Whitening>(noise, places);
}

}  // namespace warmjoint
