#include "identification/linear/linear_task.h"

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"

namespace warmjoint::inline identification {

OptionInfo LawOption() {
  return {"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"};
}

LinearTask BeginLinear(const IdentifierInput& given, int more) {
  LinearTask task{*FindLaw(given.options.Text("law")), PrepareRigid(given), {}, {}};
  const RigidPart& gravity = task.gravity;

  // gravity that the motion does not tell from friction ends it here
  if (gravity.why) {
    task.refusal = Refusal{gravity.status, *gravity.why};
    return task;
  }

  // finite numbers, more samples than parameters, a torque that changes
  const auto d = static_cast<int>(task.law.parameters.size() + gravity.count());
  if (auto why = Unusable(gravity.Of(given), d + more)) {
    task.refusal = Refusal{Status::bad_data, *why};
    return task;
  }

  // the columns of the law, then gravity and inertia
  task.columns = Beside(LawColumns(task.law, given.measurements.velocity), gravity.columns);
  return task;
}

}  // namespace warmjoint::inline identification
