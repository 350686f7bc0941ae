// Compensators that do not change: `none`, `fixed` (a friction file's cold law, or the line through the day before) and `truth`.
#include "identification/forward/log_trajectory.h"
#include "scenarios/suite.h"
#include "tools/compensate/arms/arm_list.h"

namespace warmjoint {
namespace {

/// What a fixed friction is of.
enum class Knows { cold, before };
inline std::span<const Word<Knows>> WordsOf(Knows) {
  static constexpr std::array words{Word{"cold", Knows::cold}, Word{"before", Knows::before}};
  return words;
}

struct FixedOptions {
  Knows knows = Knows::cold;
  double begin = 0;
  double end = 86400;

  template <class A>
  void Serialize(A* a) {
    a->Field("knows", &knows,
             {.meaning = "the cold law of the friction file, or a line through the day before"});
    a->Field("begin", &begin,
             {.unit = "s", .bounds = {.at_least = 0}, .meaning = "of what counts of that day"});
    a->Field("end", &end, {.unit = "s", .bounds = {.above = 0}, .meaning = "of the same"});
  }
};

Eigen::VectorXd AlongFixed(const CompensatorInput& input) {
  const auto& options = input.options.Get<FixedOptions>();
  if (options.knows == Knows::before) {
    const SpeedLine line = LineOf(input.before, options.begin, options.end);
    return input.log.velocity.unaryExpr([&](double v) { return line.At(v); });
  }
  Friction cold = input.known;
  cold.thermal.reset();
  return PredictFriction(cold, input.log).force;
}

}  // namespace

CompensatorArm NoCompensation() {
  return {"none", "no torque", {}, [](const CompensatorInput& input) -> Eigen::VectorXd {
            return Eigen::VectorXd::Zero(input.log.size());
          }};
}

CompensatorArm FixedFriction() {
  return {"fixed", "viscous and Coulomb friction that never change", FixedOptions{}, AlongFixed};
}

CompensatorArm TrueFriction() {
  return {kTruthCompensator,
          "the true friction",
          {},
          [](const CompensatorInput& input) { return *input.truth; },
          Sees::truth};
}

}  // namespace warmjoint
