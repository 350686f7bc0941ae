#include "identification/forward/bristle_course.h"

#include <algorithm>

namespace warmjoint::inline identification {
namespace {

constexpr double kConstant = 0.02;  // change of the speed below which it counts as constant

}  // namespace

BristleCourse::BristleCourse(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                             const std::vector<Eigen::Index>& starts, const Eigen::VectorXd& torque)
    : velocity_(velocity), torque_(torque), begins_(static_cast<size_t>(velocity.size()), false) {
  begins_[0] = true;
  for (const Eigen::Index start : starts) begins_[static_cast<size_t>(start)] = true;
  end_.reserve(begins_.size());
  end_.push_back(0);
  for (Eigen::Index i = 1; i < velocity.size(); ++i) {
    if (!begins_[static_cast<size_t>(i)]) {
      const double step = time[i] - time[i - 1], from = velocity[i - 1], to = velocity[i];
      if (from * to < 0) {
        // the velocity passes 0 in between
        const double before = step * from / (from - to);
        Cut(before, from, 0);
        Cut(step - before, 0, to);
      } else {
        Cut(step, from, to);
      }
    }
    end_.push_back(pieces_.size());
  }
}

void BristleCourse::Cut(double step, double from, double to) {
  const double change = std::abs(to - from);
  const double most = std::max(std::abs(from), std::abs(to));
  if (!(most > 0) || !(step > 0)) return;
  const int side = Sign(from + to);
  const int count = change > kConstant * most ? kPieces : 1;
  for (int k = 0; k < count; ++k) {
    const double at_begin = std::abs(from + (to - from) * k / count);
    const double at_end =
        k + 1 == count ? std::abs(to) : std::abs(from + (to - from) * (k + 1) / count);
    const double travel = 0.5 * (at_begin + at_end) * step / count;
    if (travel > 0) pieces_.push_back({travel, at_end, side});
  }
}

}  // namespace warmjoint::inline identification
