// What is wanted of an answer, as a text, and whether an answer has it.
#include "tools/design/aim.h"

#include <fmt/format.h>
#include <warmjoint/design.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {
namespace {

constexpr const char* kEverything = "D";
constexpr const char* kFriction = "friction";

}  // namespace

DesignAim AimFrom(const std::string& text, const std::string& option) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  DesignAim aim;
  if (name == kFriction) {
    aim.kind = AimKind::friction;
  } else if (name != kEverything) {
    aim.kind = AimKind::parameter;
    aim.parameter = name;
  }
  if (name.empty()) {
    Refuse({option},
           "is '{}'; give D, friction or a parameter, and how good is enough: friction=5%",
           Excerpt(text));
  }
  if (equals == std::string::npos) return aim;

  // a share, or per cent
  std::string number = text.substr(equals + 1);
  const bool percent = !number.empty() && number.back() == '%';
  if (percent) number.pop_back();
  const std::optional<double> value = ParseNumber(number);
  const double share = value.value_or(0) / (percent ? 100 : 1);
  if (aim.kind == AimKind::everything || !(share > 0) || !(share < 1)) {
    Refuse({option},
           "is '{}'; the half width of the 95 % interval is a share between 0 % and 100 % of "
           "friction or a parameter, as friction=5%",
           Excerpt(text));
  }
  aim.share = share;
  return aim;
}

std::string TextOf(const DesignAim& aim) {
  std::string text = aim.kind == AimKind::everything ? kEverything
                     : aim.kind == AimKind::friction ? std::string(kFriction)
                                                     : aim.parameter;
  if (aim.share) text += fmt::format("={:g}%", 100 * *aim.share);
  return text;
}

DesignAim GoalFrom(const std::string& text, const std::string& option) {
  const DesignAim goal = AimFrom(text, option);
  if (goal.share) return goal;
  const char* const of = goal.kind == AimKind::everything ? kFriction : text.c_str();
  Refuse({option}, "is '{}'; say how good is enough, as {}=5%", Excerpt(text), of);
}

void ReadValue(const Node& node, DesignAim* value, const FieldInfo&) {
  *value = AimFrom(node.Text(), node.key());
}

Tree WriteValue(const DesignAim& aim) { return TextOf(aim); }

std::optional<double> HalfWidthShare(const Estimate& estimate, const DesignAim& aim) {
  if (estimate.status != Status::ok) return std::nullopt;
  if (aim.kind == AimKind::parameter) {
    const EstimatedParameter* const found = estimate.Find(aim.parameter);
    if (!found || !found->interval95) return std::nullopt;
    return ((*found->interval95)[1] - (*found->interval95)[0]) / 2 / std::abs(found->value);
  }
  // of the warmest joint friction may be near 0: shares are of the rms over all speeds
  if (aim.kind != AimKind::friction || estimate.friction_at_speeds.empty()) return std::nullopt;
  double largest = 0, squares = 0;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    largest = std::max(largest, (one.interval95[1] - one.interval95[0]) / 2);
    squares += one.value * one.value;
  }
  return largest / std::sqrt(squares / static_cast<double>(estimate.friction_at_speeds.size()));
}

std::optional<double> HalfWidthShare(const ForetoldAnswer& answer, const DesignAim& aim) {
  Estimate estimate;
  estimate.status = answer.status;
  estimate.parameters = answer.parameters;
  estimate.friction_at_speeds = answer.friction_at_speeds;
  return HalfWidthShare(estimate, aim);
}

}  // namespace warmjoint
