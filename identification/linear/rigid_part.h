// Gravity and inertia in a fit: columns that join those of the friction, and what becomes of them.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>

#include <optional>

#include "identification/identifier.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint::inline identification {

/// The row that an identifier which can tell gravity from friction has in its table of options.
OptionInfo GravityOption();
/// Its name.
inline constexpr const char* kGravityOption = "gravity";

/// The row of an identifier that can follow motion of any kind (seen_samples.h).
OptionInfo MotionOption();

/// Whether an identifier has the row of gravity.
bool TellsGravity(const Identifier& identifier);

/// Gravity and inertia as one fit sees them. Torque = M a + F + G(p), Eqs. (5) and (6): F alone makes
/// heat, so the columns of G and a stand beside the friction, outside of its loss. M is fitted where
/// the log has an acceleration (MovingView). `paired` keeps the samples whose cell of the
/// turn is passed in both directions; because G is fitted together with friction and its warming,
/// the two passes may differ in heat.
struct RigidPart {
  GravityKind kind = GravityKind::sincos;
  std::vector<int> knots;
  Eigen::MatrixXd transform;  // [m x q] from the fitted coefficients to the values of GravityModel
  Eigen::MatrixXd columns;    // [N x q] over all samples, G's and then a; q = 0 where there is none
  bool inertia = false;       // whether the last column is the acceleration
  Selection selection;        // samples that take part
  std::optional<std::string> why;  // why gravity cannot be told from friction: one sentence
  Status status = Status::ok;      // that goes with `why`

  Eigen::Index count() const { return columns.cols(); }
  Eigen::Index gravity_count() const { return columns.cols() - (inertia ? 1 : 0); }

  /// The input with the samples that take part.
  IdentifierInput Of(const IdentifierInput& given) const;
};

/// Gravity as the option `gravity` asks for it, and inertia where the log has an acceleration.
RigidPart PrepareRigid(const IdentifierInput& input);

/// One sentence on columns that the motion cannot tell apart, law parameters before gravity's
/// and inertia's. mixed: indices of columns.
std::string IndistinctColumns(const std::vector<Eigen::Index>& mixed, const Law& law,
                              const RigidPart& gravity, const IdentifierInput& input);

/// Puts both into a fit: their model, and their rows of the table behind those that are there.
/// values: [q] fitted.
void AddRigid(const RigidPart& rigid, const Eigen::VectorXd& values,
              const Measurements& measurements, Fit& fit);

/// [A B].
Eigen::MatrixXd Beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace warmjoint::inline identification
