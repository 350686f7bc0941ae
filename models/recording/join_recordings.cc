#include "models/recording/join_recordings.h"

#include <fmt/format.h>

#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Column = std::optional<Eigen::VectorXd>;

void Append(const Eigen::VectorXd& more, Eigen::VectorXd& column) {
  const Eigen::Index n = column.size();
  column.conservativeResize(n + more.size());
  column.tail(more.size()) = more;
}

/// A column that may be absent: gone where either lacks it.
void Append(const Column& more, const char* name, const std::string& source, Measurements& joined,
            Column& column) {
  if (column && more) return Append(*more, *column);
  if (column || more) {
    joined.notes.push_back(
        fmt::format("{} is left out: not every recording has it, as {}", name, source));
  }
  column.reset();
}

/// The velocity, gone where either lacks it: positions then tell it for all recordings alike.
void AppendVelocity(const Measurements& next, Measurements& joined) {
  const bool has = next.velocity.size() > 0, had = joined.velocity.size() > 0;
  if (has && had) return Append(next.velocity, joined.velocity);
  if (has || had) {
    joined.notes.push_back(
        fmt::format("velocity is left out: not every recording has it, as {}", next.source));
  }
  joined.velocity.resize(0);
}

void CheckAlike(const Measurements& a, const Measurements& b) {
  if (a.torque_unit != b.torque_unit || a.joint != b.joint || a.gear != b.gear) {
    Refuse({b.source},
           "is of another joint or in another unit ({}) than {} ({}); join recordings of "
           "one joint",
           b.torque_unit, a.source, a.torque_unit);
  }
}

}  // namespace

Measurements JoinRecordings(std::vector<Measurements> recordings) {
  if (recordings.empty()) Refuse({}, "no recording is given");
  Measurements joined = std::move(recordings.front());
  for (size_t i = 1; i < recordings.size(); ++i) {
    const Measurements& next = recordings[i];
    CheckAlike(joined, next);
    // its time begins one step behind the last sample, where the joint is cold again
    const Eigen::Index n = joined.size();
    const double begin = joined.time[n - 1] + MedianStep(joined.time);
    joined.starts.push_back(n);
    // column by column; one that may be absent is gone where either lacks it
    Append(next.time.array() - next.time[0] + begin, joined.time);
    Append(next.position, joined.position);
    joined.position_integrated |= next.position_integrated;
    AppendVelocity(next, joined);
    Append(next.torque, joined.torque);
    Append(next.motor_position, "motor_position", next.source, joined, joined.motor_position);
    Append(next.load, "load", next.source, joined, joined.load);
    Append(next.temperature, "temperature", next.source, joined, joined.temperature);
    // notes say which file they are about
    for (const std::string& note : next.notes) {
      joined.notes.push_back(fmt::format("{}: {}", next.source, note));
    }
    joined.source += " + " + next.source;
  }
  return joined;
}

}  // namespace warmjoint
