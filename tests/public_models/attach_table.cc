// attach_table MODEL... [--where-readable MODEL...]: friction onto every joint of each model, in
// both forms, as a table. Those after the option may be no models by themselves (parts that others
// include) or have no joint to carry friction; they are then named on stderr and left out.
// Exit status 1 where a model failed, or left the bounds that the columns have.
#include <fmt/format.h>

#include <string_view>

#include "tests/public_models/robot_trial.h"

namespace warmjoint::test {
namespace {

/// E is a sum of about 500 terms that the plugin and this program round apart, and under RK4 a joint
/// of 1e12 kg.m^2 loses up to 1e3 N.m times 10 ms over its inertia of its speed, 1e-11 rad/s.
constexpr double kHeatError = 1e-10;
/// A held joint rests on a spring and may still swing on it; one that does not hold falls much farther.
constexpr double kMotion = 1;

bool Print(const std::filesystem::path& model, FrictionForm form) {
  const Trial trial = TryRobot(model, form);
  const bool good = trial.failure.empty() && trial.changed == 0 && trial.heat_error <= kHeatError &&
                    trial.motion <= kMotion;
  const auto folder = model.parent_path().filename().string();
  fmt::print("| {}/{} | {} | {}{} | {} | {} | {:.0e} | {:.0e} | {} |\n", folder,
             model.filename().string(), form == FrictionForm::passive ? "passive" : "actuator",
             trial.joints, trial.nameless ? fmt::format(" (+{} nameless)", trial.nameless) : "",
             trial.remedy.empty() ? "-" : trial.remedy, trial.changed, trial.heat_error,
             trial.motion,
             !trial.failure.empty() ? trial.failure
             : good                 ? "ok"
                                    : "OUT OF BOUNDS");
  std::fflush(stdout);
  return good;
}

}  // namespace
}  // namespace warmjoint::test

int main(int count, char** words) {
  using namespace warmjoint;
  fmt::print(
      "| model | form | joints | remedy | arrays changed | heat to (22) | motion / give | |\n"
      "|---|---|---|---|---|---|---|---|\n");
  int tried = 0, bad = 0;
  bool optional = false;
  for (int i = 1; i < count; ++i) {
    if (words[i] == std::string_view("--where-readable")) {
      optional = true;
      continue;
    }
    const std::string obstacle = optional ? test::WhyNoRobot(words[i]) : "";
    if (!obstacle.empty()) {
      fmt::print(stderr, "left out: {}: {}\n", words[i], obstacle);
      continue;
    }
    ++tried;
    for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
      bad += !test::Print(words[i], form);
    }
  }
  fmt::print("\n{} models in both forms, {} rows out of bounds\n", tried, bad);
  return bad == 0 ? 0 : 1;
}
