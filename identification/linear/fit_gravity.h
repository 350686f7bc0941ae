// Gravity in a fit: columns that join those of the friction, and what becomes of them.
#pragma once

#include <optional>

#include "identification/gravity.h"
#include "identification/identifier.h"
#include "identification/uncertainty/uncertainty.h"
#include "models/friction/law.h"

namespace warmjoint::inline identification {

/// The row that an identifier which can tell gravity from friction has in its table of options.
OptionInfo GravityOption();

/// Whether an identifier has that row.
bool TellsGravity(const Identifier& identifier);

/// Gravity as one fit sees it. Torque = F + G(p), Eq. (6): F alone makes heat, so the columns of G
/// stand beside the friction, outside of its loss. `paired` keeps the samples whose cell of the
/// turn is passed in both directions; because G is fitted together with friction and its warming,
/// the two passes may differ in heat.
struct GravityFit {
  GravityKind kind = GravityKind::sincos;
  std::vector<int> knots;
  Eigen::MatrixXd transform;  // [m x q] from the fitted coefficients to the values of GravityModel
  Eigen::MatrixXd columns;    // [N x q] over all samples; q = 0 where there is no gravity
  Selection selection;        // samples that take part
  std::optional<std::string> why;  // why gravity cannot be told from friction: one sentence
  Status status = Status::ok;      // that goes with `why`

  Eigen::Index count() const { return columns.cols(); }

  /// The input with the samples that take part.
  IdentifierInput Of(const IdentifierInput& given) const;
};

/// Gravity as the option `gravity` asks for it.
GravityFit PrepareGravity(const IdentifierInput& input);

/// One sentence on columns that the motion cannot tell apart, law parameters before gravity's.
/// mixed: indices of columns.
std::string IndistinctColumns(const std::vector<Eigen::Index>& mixed, const Law& law,
                              const GravityFit& gravity, const IdentifierInput& input);

/// Puts gravity into a fit: its model, and its rows of the table behind those that are there.
/// values: [q] fitted.
void AddGravity(const GravityFit& gravity, const Eigen::VectorXd& values,
                const Measurements& measurements, Fit& fit);

/// [A B].
Eigen::MatrixXd Beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace warmjoint::inline identification
