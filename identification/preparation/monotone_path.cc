#include "identification/preparation/monotone_path.h"

#include <vector>

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// First and last sample and the turning points between them, ascending: a turning point is the
/// furthest sample before a way back of more than the hysteresis.
std::vector<Index> TurningPoints(const VectorXd& p, double hysteresis) {
  std::vector<Index> turns{0};
  Index high = 0, low = 0;
  int direction = 0;
  for (Index i = 1; i < p.size(); ++i) {
    // the extremes since the last turning point
    if (p[i] > p[high]) high = i;
    if (p[i] < p[low]) low = i;
    // a way back beyond the hysteresis shows that the extreme before it was a turn
    if (direction >= 0 && p[high] - p[i] > hysteresis) {
      if (direction > 0 || high > 0) turns.push_back(high);
      direction = -1;
      low = high = i;
    } else if (direction <= 0 && p[i] - p[low] > hysteresis) {
      if (direction < 0 || low > 0) turns.push_back(low);
      direction = 1;
      low = high = i;
    }
  }
  // the last sample ends the last stretch
  if (turns.back() != p.size() - 1) turns.push_back(p.size() - 1);
  return turns;
}

/// A run of samples that share one value.
struct Pool {
  double times = 0, values = 0;  // sums
  double count = 0;

  double Middle() const { return times / count; }
  double Mean() const { return values / count; }
  void Add(const Pool& other) {
    times += other.times;
    values += other.values;
    count += other.count;
  }
};

/// Replaces samples first, ..., last: the nearest sequence that rises (sign 1) or falls (-1) is one
/// of runs of equal values; straight lines lead from the middle of each run to that of the next.
void MakeMonotone(const VectorXd& time, VectorXd& p, Index first, Index last, double sign) {
  std::vector<Pool> pools;
  for (Index i = first; i <= last; ++i) {
    pools.push_back({time[i], sign * p[i], 1});
    // neighbours in the wrong order become one run of their mean
    while (pools.size() > 1 && pools[pools.size() - 2].Mean() >= pools.back().Mean()) {
      const Pool behind = pools.back();
      pools.pop_back();
      pools.back().Add(behind);
    }
  }
  // straight lines between the middles of the runs, level before the first and behind the last
  size_t k = 0;
  for (Index i = first; i <= last; ++i) {
    while (k + 1 < pools.size() && pools[k + 1].Middle() <= time[i]) ++k;
    const double from = pools[k].Middle();
    double value = pools[k].Mean();
    // between two runs by the share of the time that has passed
    if (k + 1 < pools.size() && time[i] > from) {
      const double share = (time[i] - from) / (pools[k + 1].Middle() - from);
      value += share * (pools[k + 1].Mean() - value);
    }
    p[i] = sign * value;
  }
}

}  // namespace

VectorXd MonotonePath(const VectorXd& time, const VectorXd& position, double hysteresis) {
  VectorXd path = position;
  const std::vector<Index> turns = TurningPoints(position, hysteresis);
  for (size_t k = 1; k < turns.size(); ++k) {
    // a turning point belongs to the stretch that leads to it
    const Index first = k == 1 ? turns[0] : turns[k - 1] + 1;
    const double sign = position[turns[k]] >= position[turns[k - 1]] ? 1 : -1;
    MakeMonotone(time, path, first, turns[k], sign);
  }
  return path;
}

}  // namespace warmjoint
