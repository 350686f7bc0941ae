#include "identification/preparation/insert_samples.h"

#include <algorithm>
#include <cmath>

#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// The column with the value behind each sample put in at it. [N + inserted]
template <typename Column>
Column Filled(const Column& column, const std::vector<InsertedSample>& inserted) {
  Column filled(column.size() + static_cast<Index>(inserted.size()));
  Index from = 0, to = 0;
  // all up to the sample in front, then a copy of the one behind it
  for (const InsertedSample& one : inserted) {
    const Index count = one.after + 1 - from;
    filled.segment(to, count) = column.segment(from, count);
    from += count;
    to += count;
    filled[to++] = column[from];
  }
  filled.tail(filled.size() - to) = column.tail(column.size() - from);
  return filled;
}

}  // namespace

void InsertSamples(const std::vector<InsertedSample>& inserted, LogView& view) {
  auto& [log, selection] = view;
  const Eigen::VectorXd position = log.position;
  const auto motor = log.motor_position;
  ForEachColumn(log, [&](Eigen::VectorXd& column) { column = Filled(column, inserted); });
  selection.keep = Filled(selection.keep, inserted);

  // what is put in: when, where, and that no fit sees it
  for (size_t i = 0; i < inserted.size(); ++i) {
    const InsertedSample& one = inserted[i];
    const Index n = one.after + 1 + static_cast<Index>(i);
    log.put_in.push_back(n);
    log.time[n] = one.time;
    log.position[n] = one.position;
    log.velocity[n] = one.velocity;
    selection.keep[n] = false;
    if (!motor) continue;
    (*log.motor_position)[n] =
        (*motor)[one.after] + log.gear * (one.position - position[one.after]);
  }

  // where the samples that were taken stand now
  const auto moved = [&](Index n) {
    const auto before = [](const InsertedSample& one, Index sample) { return one.after < sample; };
    return n + (std::lower_bound(inserted.begin(), inserted.end(), n, before) - inserted.begin());
  };
  for (Segment& segment : selection.segments) {
    segment.begin = moved(segment.begin);
    segment.end = moved(segment.end);
  }
}

double UnresolvedAt(double v0, double v1, double nearer) {
  return v0 * v1 < 0 ? 2 * nearer * std::abs(v0 * v1 / (v0 - v1)) : 0;
}

double HeldPath(const Measurements& m) {
  const Index steps = m.size() - 1;
  return m.velocity.head(steps).cwiseAbs().dot(m.time.tail(steps) - m.time.head(steps));
}

}  // namespace warmjoint
