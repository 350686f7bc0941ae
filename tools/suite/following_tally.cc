#include "tools/suite/following_tally.h"

#include <fmt/format.h>

#include "models/foundation/excerpt.h"

namespace warmjoint::inline tools {

std::string NotFollowingInWords(const Following& following) {
  std::string cure = fmt::format("controller.bandwidth to {:g} rad/s", following.sufficient);
  if (following.timestep != 0) cure += fmt::format(" and timestep to {:g} s", following.timestep);
  return fmt::format(
      "the joint reached its commanded speed in {:.0f} % of the time. Its drive of {:g} "
      "rad/s is too slow for it: set {}",
      100 * following.share, following.bandwidth, cure);
}

void FollowingTally::Add(Unit unit, const Following& following) {
  ++realizations_;
  if (following.Follows()) return;
  // the same one whatever order threads finish in
  const bool worse =
      following.share < worst_.share || (following.share == worst_.share && unit < worst_unit_);
  if (astray_++ > 0 && !worse) return;
  worst_ = following;
  worst_unit_ = unit;
}

std::string FollowingTally::Words(const Suite& suite) const {
  if (astray_ == 0) return "";
  const auto variant = static_cast<std::size_t>(worst_unit_.variant);
  const std::string rung =
      suite.ladder ? " of " + Excerpt(suite.ladder->variants[variant].name) : "";
  return fmt::format(
      "in {} of {} simulated realizations the joint did not follow its motion. In "
      "realization {}{} {}",
      astray_, realizations_, worst_unit_.realization, rung, NotFollowingInWords(worst_));
}

}  // namespace warmjoint::inline tools
