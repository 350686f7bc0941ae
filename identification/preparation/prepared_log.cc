#include "identification/preparation/prepared_log.h"

#include <algorithm>

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

}  // namespace

PreparedLog PreparedLog::Before(double time) const {
  Log before = *log_;
  before.taken = Head(log_->taken, time);
  if (log_->steady) before.steady = Head(*log_->steady, time);
  return PreparedLog(std::move(before));
}

}  // namespace warmjoint::inline identification
