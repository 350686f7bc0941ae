#include <fmt/format.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>

#include "identification/preparation/log_faults.h"
#include "models/recording/measurements.h"

namespace warmjoint {
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

void PreparedLog::LeaveOut(LogView& view) const {
  for (Eigen::Index i = 0; i < view.measurements.size() && !log_->left_out.empty(); ++i) {
    if (std::ranges::binary_search(log_->left_out, view.measurements.time[i]))
      view.selection.keep[i] = false;
  }
}

const PreparedLog& PreparedLog::WithoutAbsurd() const {
  const auto& made = found_->without_absurd.Get([&]() -> std::shared_ptr<const PreparedLog> {
    const auto& [measurements, selection] = log_->taken;
    const SampleFlags absurd = AbsurdTorque(measurements, selection);
    if (log_->faults.empty() || !absurd.any()) return nullptr;
    // the fault, which is named last, becomes a warning
    Log without = *log_;
    without.faults.pop_back();
    without.absurd = fmt::format("{}, and left out", DescribeAbsurd(measurements, absurd));
    without.warnings.push_back(*without.absurd);
    for (Eigen::Index i = 0; i < absurd.size(); ++i) {
      if (absurd[i]) without.left_out.push_back(measurements.time[i]);
    }

    PreparedLog log(without);
    log.LeaveOut(without.taken);
    if (without.steady) log.LeaveOut(*without.steady);
    return std::make_shared<const PreparedLog>(PreparedLog(std::move(without)));
  });
  return made ? *made : *this;
}

}  // namespace warmjoint
