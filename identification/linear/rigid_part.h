// Gravity and inertia in a fit: columns that join those of the friction, and their rows of the table.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>

#include <optional>
#include <vector>

#include "identification/fit/identifier.h"
#include "identification/linear/linear_laws.h"
#include "identification/model/least_squares.h"

namespace warmjoint {

inline constexpr FieldInfo kGravityInfo{
    .meaning =
        "gravity, fitted with the friction: none, by sin and cos of the position, or whatever both "
        "directions have in common at one position"};

/// The option of an identifier that can distinguish gravity from friction.
struct GravityOption {
  FittedGravity gravity = FittedGravity::none;

  template <class A>
  void Serialize(A* a) {
    a->Field("gravity", &gravity, kGravityInfo);
  }
};

/// Gravity and inertia in one fit. Torque = M a + F + G(p), Eqs. (5) and (6): F alone makes
/// heat, so the columns of G and a are added to the friction and left out of its loss. M is fitted where
/// the log has an acceleration (PreparedLog::moving). `paired` keeps the samples whose cell of the
/// turn is passed in both directions; because G is fitted together with friction and its warming,
/// the two passes may differ in heat.
struct RigidPart {
  GravityKind kind = GravityKind::sincos;
  std::vector<int> knots;
  Eigen::MatrixXd transform;  // [m x q] from the fitted coefficients to the values of GravityModel
  Eigen::MatrixXd columns;    // [N x q] over all samples, G's and then a; q = 0 where there is none
  bool inertia = false;       // whether the last column is the acceleration
  Selection selection;        // samples that take part

  Eigen::Index count() const { return columns.cols(); }
  Eigen::Index gravity_count() const { return columns.cols() - (inertia ? 1 : 0); }

  /// The input with the samples that take part.
  IdentifierInput Of(const IdentifierInput& given) const { return given.With(selection); }
};

/// Gravity as the option `gravity` asks for it, if there is one, and inertia where the log has an acceleration; or why the log
/// does not determine gravity.
std::optional<Refusal> PrepareRigid(const IdentifierInput& input, RigidPart& fit);

/// Puts both into a fit: their model, and their rows of the table after those that are there.
/// values: [q] fitted.
void AddRigid(const RigidPart& rigid, const Eigen::VectorXd& values, const LogSamples& measurements,
              Fit& fit);

/// [A B].
Eigen::MatrixXd ConcatColumns(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Law, load, gravity and inertia, all linear in their parameters, on usable data.
struct LinearTask {
  const Law& law;
  PartFit load = PartFit::none;
  RigidPart gravity;
  Eigen::MatrixXd columns;         // [N x d] over all samples: law and load, then gravity
  std::optional<Refusal> refusal;  // why nothing can be fitted; there may be no columns then

  int count() const { return static_cast<int>(columns.cols()); }
  /// The number of columns of law and load.
  Eigen::Index law_count() const { return columns.cols() - gravity.count(); }
};

/// As the options `law` and `gravity` ask for it, with inertia where the log has an acceleration, and load_gain where `load`
/// does and the log has the load. more: parameters of the fit in addition to those of law, load, gravity and inertia.
LinearTask BeginLinear(const IdentifierInput& given, int more);

/// Fits the columns of a task to the torque of the kept samples, as if nothing warmed. Refuses the task where the motion
/// cannot distinguish them; empty where it is refused already.
LeastSquares SolveLinear(const IdentifierInput& input, LinearTask& task);

/// That refusal. mixed: indices of columns.
Refusal IndistinctColumns(const std::vector<Eigen::Index>& mixed, const LinearTask& task,
                          const IdentifierInput& input);

}  // namespace warmjoint
