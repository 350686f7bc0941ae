#include "identification/linear/rigid_part.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/gravity.h"
#include "identification/linear/linear_laws.h"
#include "identification/sentences/law.h"

namespace warmjoint {
namespace {

constexpr int kFewest = 3;       // samples of each direction in a cell
constexpr int kFewestCells = 4;  // 0.4 rad
constexpr double kFewestShare = 0.5;

/// Whether each cell of the turn is passed in both directions.
std::array<bool, kGravityKnots> PairedCells(const IdentifierInput& input) {
  const LogSamples& m = input.measurements;
  // how often each cell is passed in each direction
  std::array<int, kGravityKnots> forwards{}, backwards{};
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (!input.selection.keep[i]) continue;
    if (m.velocity[i] > 0) ++forwards[CellOf(m.position[i])];
    if (m.velocity[i] < 0) ++backwards[CellOf(m.position[i])];
  }
  // a cell counts where both directions are there
  std::array<bool, kGravityKnots> paired{};
  for (int i = 0; i < kGravityKnots; ++i) {
    paired[i] = std::min(forwards[i], backwards[i]) >= kFewest;
  }
  return paired;
}

/// Keeps paired samples; returns a refusal where there are too few.
std::optional<Refusal> SelectPairs(const IdentifierInput& input, RigidPart& fit) {
  const LogSamples& m = input.measurements;
  const auto paired = PairedCells(input);
  // in cells passed in one direction only, friction and gravity cannot be distinguished
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    fit.selection.keep[i] = fit.selection.keep[i] && paired[CellOf(m.position[i])];
  }

  // a knot at each end of every paired cell
  for (int i = 0; i < kGravityKnots; ++i) {
    if (paired[i] || paired[(i + kGravityKnots - 1) % kGravityKnots]) fit.knots.push_back(i);
  }

  // the cells that are left must be wide enough, and hold most of the log
  const auto cells = std::count(paired.begin(), paired.end(), true);
  const double share = static_cast<double>(fit.selection.count()) /
                       static_cast<double>(std::max<Eigen::Index>(input.selection.count(), 1));
  if (cells >= kFewestCells && share >= kFewestShare) return std::nullopt;
  return Refusal{
      Status::not_identifiable,
      ExplainFewPairs({.share = share, .range = static_cast<double>(cells) * kKnotSpacing},
                      {.share = kFewestShare, .range = kFewestCells * kKnotSpacing})};
}

/// Combinations of the hats that the kept samples fill, orthogonal over them and of mean square 1.
/// hats: [n x m]; returns [m x q].
Eigen::MatrixXd FilledDirections(const Eigen::MatrixXd& hats) {
  const auto n = static_cast<double>(hats.rows());

  // eigenvectors of the mean squares, those next to 0 left out
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hats.transpose() * hats / n);
  const Eigen::VectorXd& values = solver.eigenvalues();
  const Eigen::Index q = (values.array() > 1e-6 * values.maxCoeff()).count();
  return solver.eigenvectors().rightCols(q) *
         values.tail(q).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Sets the columns of G and their transform, or says why there are none.
std::optional<Refusal> PrepareGravity(const IdentifierInput& input, FittedGravity asked,
                                      RigidPart& fit) {
  const LogSamples& m = input.measurements;

  // a linear joint carries the same weight at all positions
  const bool linear = m.joint == JointKind::linear;
  fit.kind = asked == FittedGravity::sincos ? GravityKind::sincos
             : linear                       ? GravityKind::constant
                                            : GravityKind::paired;
  if (linear && asked == FittedGravity::sincos) {
    return Refusal{Status::bad_data, kSineOfLinearJoint};
  }
  if (m.position_integrated) {
    return Refusal{Status::not_identifiable, kGravityWithoutPositions};
  }
  if (!m.position.allFinite()) {
    return Refusal{Status::bad_data, kGravityWithoutSomePosition};
  }

  // hats are replaced by the combinations that the kept samples fill
  const bool paired = fit.kind == GravityKind::paired;
  if (paired) {
    if (auto why = SelectPairs(input, fit)) return why;
  }
  const Eigen::MatrixXd columns = GravityColumns(fit.kind, fit.knots, m.position);
  fit.transform = paired ? FilledDirections(Kept(columns, fit.selection))
                         : Eigen::MatrixXd::Identity(columns.cols(), columns.cols());
  fit.columns = columns * fit.transform;
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> PrepareRigid(const IdentifierInput& input, RigidPart& fit) {
  // the samples that take part so far, and no columns yet
  fit.selection = input.selection;
  fit.columns.resize(input.measurements.size(), 0);
  const FittedGravity gravity = input.options.OrDefault<GravityOption>().gravity;
  if (gravity != FittedGravity::none) {
    if (auto why = PrepareGravity(input, gravity, fit)) return why;
  }

  // the inertia, after gravity
  const auto& acceleration = input.measurements.acceleration;
  const PartFit asked = input.options.OrDefault<MotionOption>().inertia;
  fit.inertia = acceleration.has_value() && asked == PartFit::estimated;
  if (fit.inertia) fit.columns = ConcatColumns(fit.columns, *acceleration);
  return std::nullopt;
}

void AddRigid(const RigidPart& rigid, const Eigen::VectorXd& values, const LogSamples& measurements,
              Fit& fit) {
  const Eigen::Index q = rigid.gravity_count();
  if (q > 0) {
    fit.model.gravity = GravityModel{rigid.kind, rigid.knots, rigid.transform * values.head(q)};
    fit.rows.gravity = rigid.transform;
    Append(WithValues(GravityUnknowns(rigid.kind, q, UnitsOf(measurements)), values.head(q)), fit);
  }
  if (!measurements.acceleration) return;
  // without a column it is given, as 0
  fit.model.inertia = rigid.inertia ? values[q] : 0;
  Unknown row = WithValue(InertiaUnknown(UnitsOf(measurements)), *fit.model.inertia);
  row.estimated = row.has_interval = rigid.inertia;
  Append({row}, fit);
}

Eigen::MatrixXd ConcatColumns(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

LinearTask BeginLinear(const IdentifierInput& given, int more) {
  LinearTask task{*given.options.Get<LawOption>().law, PartFit::none, {}, {}, {}};
  if (given.measurements.load) task.load = given.options.OrDefault<LoadOption>().load;
  RigidPart& gravity = task.gravity;

  // where the motion does not distinguish gravity from friction, the task is refused
  task.refusal = PrepareRigid(given, gravity);
  if (task.refusal) return task;

  // finite numbers, more samples than parameters, a torque that changes
  const Eigen::MatrixXd nominal =
      NominalColumns(task.law, task.load, given.measurements, given.measurements.velocity);
  const auto d = static_cast<int>(nominal.cols() + gravity.count());
  if (auto why = Unusable(gravity.Of(given), d + more)) {
    task.refusal = Refusal{Status::bad_data, *why};
    return task;
  }

  // the columns of law and load, then gravity and inertia
  task.columns = ConcatColumns(nominal, gravity.columns);
  return task;
}

LeastSquares SolveLinear(const IdentifierInput& input, LinearTask& task) {
  if (task.refusal) return {};
  LeastSquares solved = SolveLeastSquares(Kept(task.columns, input.selection),
                                          Kept(input.measurements.torque, input.selection));
  if (solved.rank < task.count()) task.refusal = IndistinctColumns(solved.mixed, task, input);
  return solved;
}

Refusal IndistinctColumns(const std::vector<Eigen::Index>& mixed, const LinearTask& task,
                          const IdentifierInput& input) {
  const Law& law = task.law;
  const RigidPart& gravity = task.gravity;
  const Eigen::Index d = task.law_count(), of_law = std::ssize(law.parameters);
  // those of law and load by their names, then gravity and inertia
  MixedColumns columns;
  for (const Eigen::Index i : mixed) {
    if (i < of_law) columns.names.emplace_back(law.parameters[static_cast<size_t>(i)].name);
    if (i >= of_law && i < d) columns.names.push_back(NameOf(Role::load));
    if (i >= d + gravity.gravity_count()) columns.has_inertia = true;
    if (i >= d && i < d + gravity.gravity_count()) columns.gravity = gravity.kind;
  }
  // columns of the law alone have a sentence of their own
  if (!columns.gravity && !columns.has_inertia) {
    return {Status::not_identifiable,
            Indistinct(columns.names, input.measurements, input.selection)};
  }
  return {Status::not_identifiable, ExplainMixedColumns(columns)};
}

}  // namespace warmjoint
