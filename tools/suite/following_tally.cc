#include "tools/suite/following_tally.h"

#include <fmt/format.h>

#include "models/foundation/excerpt.h"

namespace warmjoint {

void FollowingTally::Add(RunUnit unit, const Following& following) {
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
      astray_, realizations_, worst_unit_.realization, rung, worst_.Words());
}

}  // namespace warmjoint
