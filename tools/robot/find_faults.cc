#include "tools/robot/find_faults.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "identification/model/normal_equations.h"
#include "sim/robot/regressor.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMostSamples = 800;  // why: five unknowns a joint are told by far fewer
constexpr double kFalls =
    2;  // a description that is wrong by a tenth leaves less between right and wrong columns
constexpr double kRises = 1.1;
constexpr Index kFewest = 60;
constexpr double kRepaired =
    .5;  // of the friction: what a joint's own answer may leave (ReportJoint)
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kZeroStep = 45 * kDegree;    // from one zero that is tried to the next
constexpr double kZeroFinest = .1 * kDegree;  // why: a description's errors hide less

/// A thinned motion of all joints.
struct Motion {
  MatrixXd q, v, a, torque;  // [N x n]
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> keep;
};

Motion ThinnedOf(const RobotSamples& s) {
  const Index every = std::max<Index>(1, s.time.size() / kMostSamples);
  const auto thin = Eigen::seq(0, s.time.size() - 1, every);
  return {s.joint_position(thin, Eigen::all), s.joint_velocity(thin, Eigen::all),
          s.joint_acceleration(thin, Eigen::all), s.torque(thin, Eigen::all),
          s.keep(thin, Eigen::all)};
}

/// What the last link may carry that the description lacks.
enum class Load { none, any };

/// Columns of each joint's least squares: rigid torque, speed, both directions, rotor, and those of mass and place of a load. [n] of [N x 5 or 9]
std::vector<MatrixXd> ColumnsAlong(const RobotData& data, const VectorXd& parameters,
                                   const Motion& m, Load load = Load::none) {
  const Index n = m.q.cols();
  const RobotMotion motion(data.robot, m.q, m.v, m.a);
  const MatrixXd speed = m.v * data.coupling.transpose(), rate = m.a * data.coupling.transpose();
  const MatrixXd inverse = data.coupling.inverse();
  std::vector<MatrixXd> all;
  for (Index j = 0; j < n; ++j) {
    const MatrixXd regressor = motion.Regressor(VectorXd(inverse.col(j)), Accelerations::counted);
    MatrixXd& columns = all.emplace_back(m.q.rows(), load == Load::any ? 9 : 5);
    columns.leftCols(5) << regressor * parameters, speed.col(j),
        (speed.col(j).array() > 0).cast<double>(), (speed.col(j).array() < 0).cast<double>(),
        rate.col(j);
    if (load == Load::any)
      columns.rightCols(4) = regressor.middleCols(10 * LastLink(data.robot), 4);
  }
  return all;
}

/// What the least squares of each joint leave and find, rms; NaN of one that hardly moves. [n]
struct Residuals {
  VectorXd left, friction;
};

Residuals ResidualsOf(const std::vector<MatrixXd>& columns, const Motion& m) {
  const Index n = std::ssize(columns);
  Residuals found{VectorXd::Constant(n, std::nan("")), VectorXd::Constant(n, std::nan(""))};
  for (Index j = 0; j < n; ++j) {
    std::vector<Index> kept;
    for (Index i = 0; i < m.keep.rows(); ++i) {
      if (m.keep(i, j)) kept.push_back(i);
    }
    if (std::ssize(kept) < kFewest) continue;
    const MatrixXd x = columns[static_cast<std::size_t>(j)](kept, Eigen::all);
    const VectorXd y = m.torque.col(j)(kept);
    const VectorXd solved = SolveScaled(x.transpose() * x, x.transpose() * y);
    const double root = std::sqrt(static_cast<double>(kept.size()));
    found.left[j] = (y - x * solved).norm() / root;
    found.friction[j] = (x.middleCols(1, 3) * solved.segment(1, 3)).norm() / root;
  }
  return found;
}

/// What a change that undoes a fault leaves as it is.
enum class Keeps { torques, motion, neither };

/// The zero of a rotary joint.
struct ZeroOf {
  Index joint = 0;
  double angle = 0;  // rad, that the log reads where the description is at 0
};

/// A change that undoes a fault.
struct Undoing {
  std::string sentence;
  std::function<void(Motion&)> apply;
  Keeps keeps = Keeps::torques;
  std::vector<Index> joints{};        // that it has to repair, whatever else falls
  std::pair<Index, Index> torques{};  // columns that it swaps
  std::optional<ZeroOf> zero{};
};

/// Names and changes of the faults that are tried.
class Faults {
 public:
  Faults(const RobotData& data, const NumberOfJoints& gears) : data_(data), gears_(gears) {}

  std::vector<Undoing> All() const {
    std::vector<Undoing> all;
    AddSwaps(all);
    for (Index j = 0; j < Count(); ++j) AddOfJoint(j, all);
    AddUnits(all);
    return all;
  }

  Undoing Zero(const ZeroOf& zero) const {
    const auto& [j, angle] = zero;
    return {.sentence = fmt::format("the zero of {} is off by {:.3g} degrees (--zero {}={:.4g})",
                                    Name(j), angle / kDegree, Name(j), angle),
            .apply = [zero](Motion& m) { m.q.col(zero.joint).array() -= zero.angle; },
            .zero = zero};
  }

 private:
  Index Count() const { return std::ssize(data_.robot.joints); }
  const std::string& Name(Index j) const {
    return data_.robot.joints[static_cast<std::size_t>(j)].name;
  }

  void AddSwaps(std::vector<Undoing>& all) const {
    constexpr const char* remedy = "(--joints names the joints in the order of the columns";
    for (Index i = 0; i < Count(); ++i) {
      for (Index j = i + 1; j < Count(); ++j) {
        const auto positions = [i, j](Motion& m) {
          for (MatrixXd* one : {&m.q, &m.v, &m.a}) one->col(i).swap(one->col(j));
          m.keep.col(i).swap(m.keep.col(j));
        };
        const auto torques = [i, j](Motion& m) { m.torque.col(i).swap(m.torque.col(j)); };
        const auto named = [&](const char* what, const char* map) {
          return fmt::format("the {} of {} and {} are swapped {}{})", what, Name(i), Name(j),
                             remedy, map);
        };
        all.push_back({named("columns", ""),
                       [positions, torques](Motion& m) { positions(m), torques(m); },
                       Keeps::neither,
                       {i, j},
                       {i, j}});
        all.push_back({named("positions", ", --map 'position={a|b|..}' each column"),
                       positions,
                       Keeps::torques,
                       {i, j}});
        all.push_back({named("torques", ", --map 'torque={a|b|..}' each column"),
                       torques,
                       Keeps::motion,
                       {i, j},
                       {i, j}});
      }
    }
  }

  void AddOfJoint(Index j, std::vector<Undoing>& all) const {
    const auto scaled = [j](double factor) {
      return [j, factor](Motion& m) {
        for (MatrixXd* one : {&m.q, &m.v, &m.a}) one->col(j) *= factor;
      };
    };
    all.push_back(
        {fmt::format("the position of {} is turned (--scale {}.position=-1)", Name(j), Name(j)),
         scaled(-1)});
    const double gear = NumberOf(gears_, Name(j), 0);
    if (gear != 0 && std::abs(gear) != 1) {
      all.push_back(
          {fmt::format("the position of {} is that of its motor (--scale {}.position={:.6g})",
                       Name(j), Name(j), 1 / gear),
           scaled(1 / gear)});
    }
    if (data_.robot.joints[static_cast<std::size_t>(j)].kind != JointKind::rotary) return;
    for (int step = -3; step <= 4; ++step) {
      if (step != 0) all.push_back(Zero({j, step * kZeroStep}));
    }
  }

  void AddUnits(std::vector<Undoing>& all) const {
    for (const auto& [words, factor] :
         {std::pair("positions are in degrees (--unit position=deg)", kDegree),
          std::pair("positions are in rad (--unit position=rad)", 1 / kDegree)}) {
      all.push_back({words, [factor = factor](Motion& m) {
                       for (MatrixXd* one : {&m.q, &m.v, &m.a}) *one *= factor;
                     }});
    }
  }

  const RobotData& data_;
  const NumberOfJoints& gears_;
};

/// A log as it is, against which undone faults are judged.
class Comparison {
 public:
  Comparison(const RobotData& data, const RobotRows& rows)
      : data_(data),
        parameters_(rows.parameters),
        given_(ThinnedOf(rows.samples.front())),
        columns_(ColumnsAlong(data, parameters_, given_)),
        before_(ResidualsOf(columns_, given_)) {}

  /// By how much a load at the last link lets the residuals fall, any of its own for each joint: the sum of logarithms.
  double FallsOfLoad() const {
    const Residuals loaded =
        ResidualsOf(ColumnsAlong(data_, parameters_, given_, Load::any), given_);
    double falls = 0;
    for (Index j = 0; j < before_.left.size(); ++j) {
      const double left = loaded.left[j];
      if (std::isfinite(before_.left[j]) && left > 0) falls += std::log(before_.left[j] / left);
    }
    return falls;
  }

  /// The fault, where undoing it explains the log better throughout.
  std::optional<RobotFault> Judge(const Undoing& undoing) const {
    Motion undone = given_;
    undoing.apply(undone);
    const Residuals after = ResidualsOf(
        undoing.keeps == Keeps::motion ? columns_ : ColumnsAlong(data_, parameters_, undone),
        undone);
    RobotFault fault{undoing.sentence, {}};
    for (Index j = 0; j < before_.left.size(); ++j) {
      // of the same torque as before
      const auto& [first, second] = undoing.torques;
      const Index from = j == first ? second : j == second ? first : j;
      const double left = after.left[from];
      if (!std::isfinite(before_.left[j]) || !std::isfinite(left) || !(left > 0)) continue;
      const double falls = before_.left[j] / left;
      fault.falls += std::log(falls);
      if (falls * kRises < 1) return std::nullopt;
      if (falls < kFalls) continue;
      fault.joints.push_back(j);
      if (left > kRepaired * after.friction[from]) return std::nullopt;
    }
    const bool repairs = std::ranges::all_of(undoing.joints, [&](Index j) {
      const double left = after.left[j];
      return !std::isfinite(left) || left <= kRepaired * after.friction[j];
    });
    if (fault.joints.empty() || !repairs) return std::nullopt;
    return fault;
  }

 private:
  const RobotData& data_;
  const VectorXd& parameters_;
  Motion given_;
  std::vector<MatrixXd> columns_;
  Residuals before_;
};

}  // namespace

std::vector<RobotFault> FindFaults(const RobotData& data, const RobotRows& rows,
                                   const NumberOfJoints& gears) {
  const Comparison log(data, rows);
  const Faults faults(data, gears);
  std::optional<RobotFault> best;
  std::optional<ZeroOf> zero;
  const auto try_one = [&](const Undoing& undoing) {
    std::optional<RobotFault> fault = log.Judge(undoing);
    if (!fault || (best && fault->falls <= best->falls)) return false;
    best = std::move(fault);
    zero = undoing.zero;
    return true;
  };
  for (const Undoing& undoing : faults.All()) try_one(undoing);
  // what a load explains as well is no fault of the log: a zero of the last joint turns its mass as another tool does
  if (!best || best->falls <= log.FallsOfLoad()) return {};

  // a zero lies anywhere between those that were tried
  for (double step = kZeroStep / 2; zero && step > kZeroFinest; step /= 2) {
    const ZeroOf at = *zero;
    if (!try_one(faults.Zero({at.joint, at.angle + step}))) {
      try_one(faults.Zero({at.joint, at.angle - step}));
    }
  }
  return {std::move(*best)};
}

}  // namespace warmjoint
