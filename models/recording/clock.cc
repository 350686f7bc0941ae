#include "models/recording/clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kOnTheClock =
    100;  // median steps to a neighbour; why: more is a pause, which no single row tells of
constexpr Index kFewestRows = 10;           // that tell a step
constexpr std::size_t kEnoughSteps = 1000;  // whose median is that of all
constexpr double kSoonAgain =
    10;  // median steps across a restart; why: a counter runs on, two logs in a file begin anywhere
constexpr double kYear2010 = 1262304000, kYear2100 = 4102444800;  // s since 1970
constexpr double kFastest = 1e-5;                                 // s; why: no drive logs faster
constexpr double kSlowest =
    2;  // s; why: robots log at a sample a second or more, and ms are likelier
constexpr double kLongRun = 6e5;  // counts; why: ten minutes in ms, which in s is a week
constexpr double
    kSlowJoint = 0.01,
    kSlowSlide = 1e-3;  // rad/s, m/s on average; why: a thousandth of 1 rad/s, 1 m/s, and some more
constexpr double kAlike =
    3;  // between a path and another; why: units of speed differ by 6 and more, of time by 1000
constexpr Index kChunks = 200;  // of a log, along which paths are compared

/// Median of the first thousand steps that are not 0; 0 where all are.
double MedianTick(const VectorXd& time) {
  std::vector<double> steps;
  for (Index i = 1; i < time.size() && steps.size() < kEnoughSteps; ++i) {
    if (time[i] != time[i - 1]) steps.push_back(std::abs(time[i] - time[i - 1]));
  }
  return MedianOf(steps);
}

/// Counts after which a counter of 16, 24 or 32 bits starts again, whole or in thousandths or millionths, of which `back` is the
/// most, less up to `slack`; 0 where none fits.
double RangeOf(double back, double slack) {
  for (const int bits : {16, 24, 32}) {
    for (const double part : {1.0, 1e-3, 1e-6}) {
      const double range = part * std::exp2(bits);
      if (range > back && range - back <= slack) return range;
    }
  }
  return 0;
}

/// Whether a path over another is near 1.
bool AreAlike(double ratio) { return std::max(ratio, 1 / ratio) < kAlike; }

/// The path that positions travel over that by the velocity, in the median of the chunks of a log that travel farthest; nothing
/// where it tells neither.
std::optional<double> PathByVelocity(const Measurements& m) {
  if (m.position.size() == 0 || m.velocity.size() == 0) return std::nullopt;
  const Index n = m.size(), chunk = std::max<Index>(1, n / kChunks);
  std::vector<double> by_velocity, by_position;
  for (Index begin = 0; begin + chunk < n; begin += chunk) {
    double path = 0;
    for (Index i = begin + 1; i <= begin + chunk; ++i) {
      path += (m.time[i] - m.time[i - 1]) * (m.velocity[i] + m.velocity[i - 1]) / 2;
    }
    by_velocity.push_back(std::abs(path));
    by_position.push_back(std::abs(m.position[begin + chunk] - m.position[begin]));
  }
  // the quarter of the chunks with the longest paths: a rest tells nothing
  std::vector<double> sorted = by_velocity;
  std::ranges::sort(sorted);
  const double long_path = Quantile(sorted, 0.75);
  std::vector<double> ratios;
  for (std::size_t k = 0; k < by_velocity.size(); ++k) {
    if (by_velocity[k] > 0 && by_velocity[k] >= long_path) {
      ratios.push_back(by_position[k] / by_velocity[k]);
    }
  }
  const double ratio = MedianOf(ratios);
  return ratio > 0 && std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

/// Mean speed, rad/s or m/s, by the ends of chunks, between which noise adds no path.
double MeanSpeed(const Measurements& m) {
  const Index n = m.size(), chunk = std::max<Index>(1, n / kChunks);
  double path = 0;
  for (Index begin = 0; begin + chunk < n; begin += chunk) {
    path += std::abs(m.position[begin + chunk] - m.position[begin]);
  }
  return path / (m.time[n - 1] - m.time[0]);
}

/// The unit of time that makes the paths alike; nothing where none does, or the assumed one.
std::optional<Unit> UnitByPath(const Unit& assumed, std::optional<double> ratio) {
  if (!ratio) return std::nullopt;
  for (const char* name : {"s", "ms", "us", "ns"}) {
    const Unit unit = *MeantUnit(name, {"s"});
    const bool fits = AreAlike(*ratio * assumed.factor / unit.factor);
    if (unit.name != assumed.name && fits) return unit;
  }
  return std::nullopt;
}

}  // namespace

void AddDoubt(std::string sentence, Measurements& measurements) {
  measurements.notes.push_back(sentence);
  measurements.doubts.push_back(std::move(sentence));
}

std::string UndoRestarts(VectorXd& counts) {
  // every step back is by the same range
  const Index n = counts.size();
  if (n < kFewestRows || (counts.tail(n - 1).array() >= counts.head(n - 1).array()).all())
    return "";
  const double slack = kSoonAgain * MedianTick(counts);
  const double back = (counts.head(n - 1) - counts.tail(n - 1)).maxCoeff();
  const double range = RangeOf(back, slack);
  if (range == 0 || counts.maxCoeff() - counts.minCoeff() >= range) return "";

  int restarts = 0;
  VectorXd going_on = counts;
  for (Index i = 1; i < n; ++i) {
    const double step = counts[i] - counts[i - 1];
    if (step < -range / 2) {
      if (range + step > slack) return "";
      ++restarts;
    }
    going_on[i] += restarts * range;
  }
  counts = std::move(going_on);
  return fmt::format("its clock starts again after {:.10g} counts, {} times; unwrapped", range,
                     restarts);
}

void GoOnAtMidnight(VectorXd& time) {
  double midnight = 0;  // s
  for (Index i = 1; i < time.size(); ++i) {
    const double back = time[i] + midnight - time[i - 1];
    if (back < -kDay / 2 && back > -kDay) midnight += kDay;
    time[i] += midnight;
  }
}

StrayRows FindStrayRows(const VectorXd& time) {
  StrayRows stray;
  const Index n = time.size();
  if (n < kFewestRows) return stray;
  const double longest = kOnTheClock * MedianTick(time);
  const double first = time[1] - time[0], last = time[n - 1] - time[n - 2];
  // a counter, or a log, that starts again in the second row goes on from there
  stray.first = first > longest || (first < 0 && time[2] > time[1]);
  stray.last = last > longest;
  const auto describe = [](const char* which, double at, double beside) {
    return fmt::format(
        "the {} row is not on the clock, at time {:.10g} beside {:.10g}, and is left "
        "out",
        which, at, beside);
  };
  if (stray.first) {
    stray.note = describe("first", time[0], time[1]) + ": is it one of factors or channel numbers?";
  }
  if (stray.last) {
    stray.note += (stray.first ? "; " : "") + describe("last", time[n - 1], time[n - 2]);
  }
  return stray;
}

AssumedUnit AssumeUnit(const VectorXd& counts) {
  const Index n = counts.size();
  AssumedUnit assumed{.unit = *MeantUnit("s")};
  if (n < 2) return assumed;
  assumed.first = counts[0];
  assumed.is_whole = (counts.array() == counts.array().floor()).all();
  const double step = std::abs(counts[n - 1] - counts[0]) / static_cast<double>(n - 1);
  for (const char* name : {"s", "ms", "us", "ns"}) {
    const Unit unit = *MeantUnit(name, {"s"});
    const double since = unit.factor * counts[0];
    if (since < kYear2010 || since >= kYear2100 || step * unit.factor > kSlowest) continue;
    assumed.unit = unit;
    assumed.is_epoch = true;
    break;
  }
  return assumed;
}

void CheckAssumedUnit(const AssumedUnit& assumed, const Place& place, Measurements& m) {
  const Index n = m.size();
  const double step = (m.time[n - 1] - m.time[0]) / static_cast<double>(n - 1);
  const std::optional<double> path = PathByVelocity(m);
  const bool confirmed = path && AreAlike(*path);
  const bool is_long = assumed.first >= kLongRun;
  if (step < kFastest || (step > kSlowest && !confirmed)) {
    const auto unit = UnitByPath(assumed.unit, path);
    Refuse(place, "samples are {:.4g} s apart if time is in {}; give its unit: --unit time={}",
           step, assumed.unit.name,
           unit ? fmt::format("{} (so say velocity and positions)", unit->name)
                : "ns, us, ms, s, min, h or d");
  }

  // a counter that runs for long: another unit would make as good a clock
  if (is_long && !confirmed) {
    if (const auto unit = UnitByPath(assumed.unit, path)) {
      Refuse(place,
             "the positions change as the velocity says if time is in {}, not in {}: --unit "
             "time={}",
             unit->name, assumed.unit.name, unit->name);
    }
    const double slow = m.joint == JointKind::rotary ? kSlowJoint : kSlowSlide;
    const bool is_slow = m.position.size() > 0 && MeanSpeed(m) < slow;
    if (is_slow || (assumed.is_whole && !assumed.is_epoch)) {
      Refuse(place,
             "time begins at {:.10g}, which may count s, ms or us; give its unit: --unit time=s, "
             "ms or us",
             assumed.first);
    }
  }
  const std::string counts =
      fmt::format("time counts {} since 1970 by its size", assumed.unit.name);
  if (assumed.is_epoch && assumed.is_whole && !confirmed) {
    AddDoubt(counts + "; if not, give its unit (--unit time=us)", m);
  } else if (assumed.is_epoch && assumed.unit.name != "s") {
    m.notes.push_back(counts);
  } else if (assumed.is_whole && step >= 1 && !confirmed) {
    AddDoubt(fmt::format("samples are {:.4g} s apart; if time is in ms give --unit time=ms", step),
             m);
  } else if (step > kSlowest) {
    m.notes.push_back(
        fmt::format("samples are {:.4g} s apart, as velocity and positions say", step));
  }
}

}  // namespace warmjoint
