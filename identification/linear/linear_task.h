// What a fit of a linear law begins with.
#pragma once

#include "identification/linear/rigid_part.h"

namespace warmjoint::inline identification {

/// What a summary adds of samples that accelerate.
inline constexpr const char* kOfAnyMotion = " of motion of any kind, with inertia";

/// The row `law` of an identifier's options, with all linear laws as its words.
OptionInfo LawOption();

/// Law, gravity and inertia, all linear in their parameters, on usable data.
struct LinearTask {
  const Law& law;
  RigidPart gravity;
  Eigen::MatrixXd columns;         // [N x d] over all samples: law, then gravity
  std::optional<Refusal> refusal;  // why nothing can be fitted; then there are no columns

  int count() const { return static_cast<int>(columns.cols()); }
  Eigen::Index law_count() const { return columns.cols() - gravity.count(); }
};

/// As the options `law` and `gravity` ask for it. more: parameters of the fit beside those of law
/// and gravity.
LinearTask BeginLinear(const IdentifierInput& given, int more);

}  // namespace warmjoint::inline identification
