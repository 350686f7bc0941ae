#include "models/robot_log/column_pattern.h"

#include <fmt/format.h>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {
namespace {

using Words = std::vector<std::string>;

/// The text of braces for joint j.
std::string Expanded(const std::string& inside, const Words& joints, std::size_t j) {
  if (inside == "j") return std::to_string(j);
  if (inside == "name") return joints[j];
  const auto refuse = [&](std::size_t count) {
    Refuse({"--map"}, "{{{}}} stands for {} joints, and there are {}", Excerpt(inside), count,
           joints.size());
  };
  if (const std::size_t dots = inside.find(".."); dots != std::string::npos) {
    const auto first = ParseNumber(inside.substr(0, dots)),
               last = ParseNumber(inside.substr(dots + 2));
    if (first && last && *last >= *first) {
      const auto count = static_cast<std::size_t>(*last - *first) + 1;
      if (count < joints.size()) refuse(count);
      return fmt::format("{:.0f}", *first + static_cast<double>(j));
    }
  }
  Words parts(1);
  for (const char c : inside) {
    if (c == '|')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (parts.size() > 1) {
    if (parts.size() < joints.size()) refuse(parts.size());
    return parts[j];
  }
  Refuse({"--map"}, "{{{}}} is none of {{j}}, {{name}}, {{0..5}} and {{a|b|c}}", Excerpt(inside));
}

}  // namespace

std::string ColumnOfJoint(const std::string& pattern, const Words& joints, std::size_t j) {
  std::string column;
  std::size_t at = 0;
  for (std::size_t open; (open = pattern.find('{', at)) != std::string::npos;) {
    const std::size_t close = pattern.find('}', open);
    if (close == std::string::npos) break;
    column += pattern.substr(at, open - at);
    column += Expanded(pattern.substr(open + 1, close - open - 1), joints, j);
    at = close + 1;
  }
  if (at == 0 && joints.size() > 1) {
    Refuse({"--map"}, "'{}' names one column for {} joints; put {{j}} where their number stands",
           Excerpt(pattern), joints.size());
  }
  return column + pattern.substr(at);
}

}  // namespace warmjoint
