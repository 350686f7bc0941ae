#include "models/friction/bristle_state.h"

#include <algorithm>
#include <cmath>

#include "models/friction/sign.h"

namespace warmjoint {
namespace {

constexpr double kConstant = 0.02;  // change of the speed below which it counts as constant

}  // namespace

MotionPieces::MotionPieces(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                           const std::vector<Eigen::Index>& starts)
    : velocity_(velocity), begins_(static_cast<size_t>(velocity.size()), false) {
  if (velocity.size() == 0) return;

  // where the path begins anew
  begins_[0] = true;
  for (const Eigen::Index start : starts) begins_[static_cast<size_t>(start)] = true;

  // the path from each sample to the next, cut where it turns
  end_.reserve(begins_.size());
  end_.push_back(0);
  for (Eigen::Index i = 1; i < velocity.size(); ++i) {
    if (!begins_[static_cast<size_t>(i)]) {
      const double step = time[i] - time[i - 1], from = velocity[i - 1], to = velocity[i];
      if (from * to < 0) {
        // the velocity passes 0 in between
        const double turn = from / (from - to);
        Cut(step, 0, turn, from, 0);
        Cut(step, turn, 1, 0, to);
      } else {
        Cut(step, 0, 1, from, to);
      }
    }
    end_.push_back(pieces_.size());
  }
}

void MotionPieces::Cut(double step, double begin, double end, double from, double to) {
  const double change = std::abs(to - from);
  const double most = std::max(std::abs(from), std::abs(to));
  const double time = step * (end - begin);
  if (!(most > 0) || !(time > 0)) return;
  const int side = Sign(from + to);
  // a speed that hardly changes makes one piece
  const int count = change > kConstant * most ? kPieces : 1;
  const auto between = [count](double first, double last, int k) {
    return k == count ? last : first + (last - first) * k / count;
  };
  for (int k = 0; k < count; ++k) {
    const double at_begin = std::abs(between(from, to, k));
    const double at_end = std::abs(between(from, to, k + 1));
    const double travel = 0.5 * (at_begin + at_end) * time / count;
    if (!(travel > 0)) continue;
    pieces_.push_back({travel, at_end, side, between(begin, end, k), between(begin, end, k + 1)});
  }
}

}  // namespace warmjoint
