#include "tools/design/search_speeds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

constexpr int kStarts = 4;  // why: of which the best is within a few per cent of that of twelve
constexpr int kSpeeds =
    7;  // why: neighbours differ by less than a factor of two over a range of 1 to 20
constexpr size_t kSurvey = 10;   // why: a tenth of the blocks costs a twentieth of the deviation
constexpr int kMostBlocks = 90;  // why: the search grows with the square of their number

/// A rest, and speeds in even ratios.
std::vector<double> Choices(const MotionLimits& limits) {
  std::vector<double> speeds{0};
  const auto [slowest, fastest] = limits.velocity;
  for (int i = 0; i < kSpeeds; ++i) {
    speeds.push_back(slowest * std::pow(fastest / slowest, i / (kSpeeds - 1.0)));
  }
  return speeds;
}

/// Blocks of two strokes, or longer ones of a long motion.
std::vector<SpeedBlock> Blocks(const DesignSettings& settings) {
  const double seconds = 60 * settings.minutes;
  const double fewest = std::ceil(seconds / kMostBlocks / settings.hold);
  const double length = settings.hold * std::max(2.0, fewest);
  const auto n = static_cast<size_t>(std::max(std::round(seconds / length), 1.0));
  return std::vector<SpeedBlock>(n, {seconds / static_cast<double>(n), 0});
}

/// Strokes of one hold each.
std::vector<SpeedBlock> Strokes(const DesignSettings& settings) {
  const double seconds = 60 * settings.minutes;
  const auto n = static_cast<size_t>(std::max(std::round(seconds / settings.hold), 1.0));
  return std::vector<SpeedBlock>(n, {seconds / static_cast<double>(n), 0});
}

/// Whether a block keeps a speed between slowest and fastest, so that the log shows a curve that the law lacks: every tenth one, of motions
/// for one parameter none, nor of those for a friction with a curve, which go there by themselves.
bool IsSurvey(const SpeedSearch& search, size_t block) {
  const AimKind aim = search.settings.aim.kind;
  if (aim == AimKind::parameter) return false;
  if (aim == AimKind::friction && search.joints.front().HasCurve()) return false;
  return block % kSurvey == kSurvey / 2;
}

/// One run of exchanges.
class Exchange {
 public:
  Exchange(const SpeedSearch& search, const std::vector<AimCost>& costs,
           std::vector<SpeedBlock> blocks)
      : search_(search), costs_(costs), blocks_(std::move(blocks)) {
    // the speeds between in turn
    const std::vector<double> choices = Choices(search_.settings.limits);
    size_t next = 0;
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (!IsSurvey(search_, i)) continue;
      blocks_[i].speed = choices[2 + next++ % (choices.size() - 3)];
    }
    best_ = Cost();
  }

  /// Goes over all groups until none changes, or `rounds` times. tried: is called after each trial
  void Run(size_t group, int rounds, const std::function<void()>& tried) {
    const std::vector<double> choices = Choices(search_.settings.limits);
    for (int round = 0; round < rounds; ++round) {
      bool changed = false;
      for (size_t first = 0; first < blocks_.size(); first += group) {
        changed =
            Improve(first, std::min(first + group, blocks_.size()), choices, tried) || changed;
      }
      if (!changed) return;
    }
  }

  double best() const { return best_; }
  std::vector<SpeedBlock> Take() { return std::move(blocks_); }

 private:
  bool Improve(size_t first, size_t last, const std::vector<double>& choices,
               const std::function<void()>& tried) {
    const std::vector<SpeedBlock> before(blocks_.begin() + static_cast<std::ptrdiff_t>(first),
                                         blocks_.begin() + static_cast<std::ptrdiff_t>(last));
    const auto set = [&](double speed) {
      for (size_t i = first; i < last; ++i) {
        if (!IsSurvey(search_, i)) blocks_[i].speed = speed;
      }
    };
    std::optional<double> chosen;
    for (const double speed : choices) {
      set(speed);
      const double cost = Cost();
      tried();
      // why: less than what the deviation is worth
      constexpr double kWorth = 1e-5;
      if (cost < best_ - kWorth) {
        best_ = cost;
        chosen = speed;
      }
    }
    if (chosen) {
      set(*chosen);
    } else {
      std::ranges::copy(before, blocks_.begin() + static_cast<std::ptrdiff_t>(first));
    }
    return chosen.has_value();
  }

  /// The mean over the joints.
  double Cost() const {
    const MotionCells cells =
        CellsOf(LayOut(blocks_, search_.settings.limits, search_.settings.hold),
                CellLength(search_.settings, search_.joints));
    double sum = 0;
    for (size_t j = 0; j < costs_.size(); ++j) {
      sum += costs_[j](search_.joints[j].Information(cells));
    }
    return sum / static_cast<double>(costs_.size());
  }

  const SpeedSearch& search_;
  const std::vector<AimCost>& costs_;
  std::vector<SpeedBlock> blocks_;
  double best_ = 0;
};

}  // namespace

double CellLength(const DesignSettings& settings, const std::vector<PossibleJoint>& joints) {
  // why: losses change from stroke to stroke, and warming by less than a tenth of its time constant in a cell
  double length = std::max(settings.hold / 5, 60 * settings.minutes / 900);
  for (const PossibleJoint& joint : joints) {
    if (joint.friction().thermal) {
      length = std::min(length, joint.friction().thermal->time_constant / 10);
    }
  }
  // why: an hour's motion then has less than a million cells
  return std::max(length, 60 * settings.minutes / 1e6);
}

std::vector<AimCost> CostsOf(const SpeedSearch& search) {
  const MotionCells usual = CellsOf(
      LayOut(RandomSpeeds(search.settings, 0), search.settings.limits, search.settings.hold),
      CellLength(search.settings, search.joints));
  std::vector<AimCost> costs;
  for (const PossibleJoint& joint : search.joints) {
    costs.emplace_back(search.settings.aim, joint, usual);
  }
  return costs;
}

double CostOf(const std::vector<MotionKnot>& knots, const SpeedSearch& search, const AimCost& cost,
              const PossibleJoint& joint) {
  return cost(joint.Information(CellsOf(knots, CellLength(search.settings, search.joints))));
}

std::vector<SpeedBlock> SearchSpeeds(const SpeedSearch& search) {
  const std::vector<AimCost> costs = CostsOf(search);
  const auto n = Blocks(search.settings).size();
  // from a tenth of the motion to single blocks
  const std::vector<std::pair<size_t, int>> passes{
      {std::max<size_t>(n / 10, 1), 3}, {std::max<size_t>(n / 30, 1), 3}, {1, 1}};
  double all = 0, done = 0;
  for (const auto& [group, rounds] : passes) {
    all += kStarts * rounds * std::ceil(static_cast<double>(n) / static_cast<double>(group)) *
           (kSpeeds + 1);
  }
  const auto tried = [&] {
    ++done;
    if (search.watch) search.watch(done / all);
  };

  std::vector<SpeedBlock> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t start = 0; start < kStarts; ++start) {
    // random speeds
    std::vector<SpeedBlock> blocks = Blocks(search.settings);
    RandomStream random({search.settings.seed, start}, Stream::start);
    const auto [slowest, fastest] = search.settings.limits.velocity;
    for (SpeedBlock& block : blocks) block.speed = random.Uniform(slowest, fastest);
    Exchange exchange(search, costs, std::move(blocks));
    for (const auto& [group, rounds] : passes) exchange.Run(group, rounds, tried);
    if (exchange.best() < least) {
      least = exchange.best();
      best = exchange.Take();
    }
  }
  return best;
}

std::vector<SpeedBlock> RandomSpeeds(const DesignSettings& settings, std::uint64_t draw) {
  std::vector<SpeedBlock> blocks = Strokes(settings);
  RandomStream random({settings.seed, draw}, Stream::motion);
  const auto [slowest, fastest] = settings.limits.velocity;
  for (SpeedBlock& block : blocks) block.speed = random.Uniform(slowest, fastest);
  return blocks;
}

std::vector<SpeedBlock> LadderOfSpeeds(const DesignSettings& settings) {
  constexpr int kSteps = 10;
  std::vector<SpeedBlock> blocks = Strokes(settings);
  const auto [slowest, fastest] = settings.limits.velocity;
  for (size_t i = 0; i < blocks.size(); ++i) {
    const int place = static_cast<int>(i % (2 * kSteps));
    const int step = place < kSteps ? place : 2 * kSteps - 1 - place;
    blocks[i].speed = slowest + (fastest - slowest) * step / (kSteps - 1);
  }
  return blocks;
}

}  // namespace warmjoint
