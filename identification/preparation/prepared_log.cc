#include "identification/preparation/prepared_log.h"

#include <algorithm>

#include "identification/preparation/moving_view.h"

namespace warmjoint::inline identification {
namespace {

LogView Head(const LogView& all, double time) {
  const Eigen::Index n = (all.measurements.time.array() < time).count();
  LogView head{FirstSamples(all.measurements, n), {all.selection.keep.head(n), {}}};
  for (Segment segment : all.selection.segments) {
    if (segment.begin >= n) break;
    segment.end = std::min(segment.end, n);
    head.selection.segments.push_back(segment);
  }
  return head;
}

/// Whether a tenth or more of what moves clearly moves at a constant speed.
bool ShowsSpeeds(const LogView& taken) {
  constexpr double fewest = 0.1;  // of the samples that move clearly
  const Measurements& m = taken.measurements;
  const auto moving = static_cast<double>((m.velocity.array().abs() > ClearSpeed(m)).count());
  return static_cast<double>(taken.selection.count()) >= fewest * moving;
}

}  // namespace

const LogView& PreparedLog::moving() const {
  std::call_once(moving_->once,
                 [&] { moving_->view = ViewMotion(log_->taken.measurements, log_->source); });
  return moving_->view;
}

bool PreparedLog::HoldsSpeeds() const {
  std::call_once(moving_->speeds_once, [&] { moving_->holds_speeds = ShowsSpeeds(log_->taken); });
  return moving_->holds_speeds;
}

PreparedLog PreparedLog::Before(double time) const {
  Log before = *log_;
  before.taken = Head(log_->taken, time);
  if (log_->steady) before.steady = Head(*log_->steady, time);
  return PreparedLog(std::move(before));
}

}  // namespace warmjoint::inline identification
