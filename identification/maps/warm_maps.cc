#include "identification/maps/warm_maps.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>
#include <vector>

#include "identification/explain.h"
#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/bounds.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/holes.h"
#include "identification/maps/map_blocks.h"
#include "identification/uncertainty/penalised_uncertainty.h"
#include "identification/warming/fit_law.h"
#include "identification/warming/law_problem.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

// rounds; why four: three differences, one for each way in which a warming is mistaken for a map (how far, how soon, from
// where), span what converges slowly. The fixed point does not depend on it
constexpr size_t kRemembered = 4;

/// A fixed point x = g(x), by Anderson's method (J. ACM 12, 1965): the step is the combination of the
/// latest four rounds whose residual g(x) - x is the smallest in squares.
class AndersonMixing {
 public:
  /// Where to go on. x, g: [N] the point of this round, and g(x).
  Eigen::VectorXd Next(const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
    rounds_.push_back({g - x, g});
    if (rounds_.size() > kRemembered) rounds_.pop_front();
    const auto differences = static_cast<Eigen::Index>(rounds_.size()) - 1;
    if (differences == 0) return g;

    // each round against the one before it
    Eigen::MatrixXd of_residual(g.size(), differences), of_image(g.size(), differences);
    for (Eigen::Index i = 0; i < differences; ++i) {
      const Round& before = rounds_[static_cast<size_t>(i)];
      const Round& after = rounds_[static_cast<size_t>(i) + 1];
      of_residual.col(i) = after.residual - before.residual;
      of_image.col(i) = after.image - before.image;
    }
    // the combination of the differences that comes nearest to the latest residual
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(of_residual);
    Eigen::VectorXd next = g - of_image * solver.solve(rounds_.back().residual);
    return next.allFinite() ? next : g;
  }

 private:
  struct Round {
    Eigen::VectorXd residual;  // [N] g(x) - x
    Eigen::VectorXd image;     // [N] g(x)
  };
  std::deque<Round> rounds_;
};

constexpr int kMostRounds = 50;
constexpr double kAtRest = 1e-6;  // of gain and time constant between rounds, relative
constexpr WarmingContext kContext{" beside the maps", "position-ridge"};

bool HasConverged(const Thermal& a, const Thermal& b) {
  return std::abs(a.gain - b.gain) <= kAtRest * std::abs(b.gain) &&
         std::abs(a.time_constant - b.time_constant) <= kAtRest * b.time_constant;
}

/// What warming takes of the residual, in variances of the noise, round after round.
class Visibility {
 public:
  /// cold: squares without warming; torque: [n] to which was fitted, N.m or N
  Visibility(double cold, Eigen::VectorXd torque)
      : cold_(cold), torque_(std::move(torque)), samples_(static_cast<double>(torque_.size())) {}

  /// squares: what is left; degrees_of_freedom: samples less parameters.
  double Of(double squares, double degrees_of_freedom) const {
    return ExplainedVariances(cold_, squares, degrees_of_freedom, torque_);
  }
  /// After a round that leaves so many squares.
  void Follow(double squares) {
    before_last_ = std::exchange(last_, std::exchange(latest_, Of(squares, samples_)));
  }
  double latest() const { return latest_; }

  /// Whether further rounds leave it below half of what can be seen. Blocks in turn grow by a geometric series,
  /// of which three terms tell the limit (Aitken).
  bool StaysUnseen() const {
    const double growth = latest_ - last_, before = last_ - before_last_;
    const double ratio = std::abs(growth) < std::abs(before) ? growth / before : 1;
    return latest_ + growth * ratio / (1 - ratio) < 0.5 * kVisibleWarming;
  }

 private:
  double cold_;
  Eigen::VectorXd torque_;
  double samples_;
  double latest_ = 0, last_ = 0, before_last_ = 0;
};

/// How sure law, maps and warming are together. Order: law, rigid part, weights, heat, start, jumps.
struct JointUncertainty {
  Layout layout;
  Uncertainty known;
  double end_energy_std = 0;  // of E at the end of the log, N.m or N
};

/// Law, maps and warming as one fit of a law that has the kernels as further columns.
ThermalFit Joined(const WarmMaps& warm) {
  const ThermalFit& warming = warm.warming;
  const Layout &of = warming.layout, &maps = warm.fit.layout;
  ThermalFit joined;
  joined.layout = Layout::InOrder({{&Layout::law, maps.law.size + maps.weights.size},
                                   {&Layout::heat, of.heat.size},
                                   {&Layout::start, of.start.size},
                                   {&Layout::jumps, of.jumps.size},
                                   {&Layout::rigid, maps.rigid.size}});
  const Eigen::Index heat = of.rigid.begin - of.heat.begin;
  joined.x.resize(joined.layout.size());
  joined.x << warm.fit.law(), warm.fit.weights(), warming.x.segment(of.heat.begin, heat),
      warm.fit.rigid();
  joined.prior = Eigen::VectorXd::Zero(joined.layout.size());
  joined.prior.segment(joined.layout.heat.begin, heat) = warming.prior.segment(of.heat.begin, heat);
  return joined;
}

/// The unknowns of a joined fit by their parts. maps: of law and maps; joined: of that fit
Layout JoinedParts(const Layout& maps, const Layout& joined) {
  return Layout::InOrder({{&Layout::law, maps.law.size},
                          {&Layout::weights, maps.weights.size},
                          {&Layout::heat, joined.heat.size},
                          {&Layout::start, joined.start.size},
                          {&Layout::jumps, joined.jumps.size},
                          {&Layout::rigid, maps.rigid.size}});
}

/// Rows of the derivatives of law, maps and warming together, made block by block along the log: all of them at once are
/// far larger than it. Unknowns in the order of `layout`.
class JointRows {
 public:
  JointRows(const IdentifierInput& input, const WarmMaps& warm)
      : m_(input.measurements),
        warm_(warm),
        joined_(Joined(warm)),
        parameters_(joined_.law()),
        points_(PointsOf(m_)),
        law_(LawColumns(*warm.task.law, m_.velocity)),
        of_loss_(LossColumns(*warm.task.law, m_)),
        loop_(ClosedLoop::Along(m_, Eigen::MatrixXd(m_.size(), 0)).WithJumps(Behind(warm.gaps))) {
    const Layout parts = JoinedParts(warm.fit.layout, joined_.layout);
    layout_ = parts.Reordered(&Layout::law, &Layout::rigid, &Layout::weights, &Layout::heat,
                              &Layout::start, &Layout::jumps);
    order_ = parts.PlacesOf(layout_);
    for (Eigen::Index n = 0; n < m_.size(); ++n) {
      if (input.selection.keep[n]) kept_.push_back(n);
    }
    FollowLoop();
  }

  const Layout& layout() const { return layout_; }
  Eigen::VectorXd prior() const { return joined_.prior(order_); }  // [p]
  const Eigen::MatrixXd& gram() const { return gram_; }            // [p x p] of the kept rows

  /// dE/dx at the end of the log, [p].
  Eigen::VectorXd OfEnd() const {
    Eigen::VectorXd of_end = Eigen::VectorXd::Zero(joined_.layout.size());
    of_end.head(joined_.layout.rigid.begin) =
        OfEstimated(begins_.back().at.slopes.transpose(), joined_.layout).transpose();
    return of_end(order_);
  }

  /// Rows first <= i < last of the kept samples. [last - first x p]
  Eigen::MatrixXd Between(Eigen::Index first, Eigen::Index last) const {
    Eigen::MatrixXd rows(last - first, layout_.size());
    if (first == last) return rows;
    // from the block that holds the first of them
    const Eigen::Index begin = kept_[static_cast<size_t>(first)];
    const auto behind = std::ranges::upper_bound(begins_, begin, {}, &Begin::sample);
    LoopEnd at = (behind - 1)->at;
    for (Eigen::Index n = (behind - 1)->sample, done = first; done < last;) {
      const Eigen::Index end = std::min(n + kBlock, kept_[static_cast<size_t>(last - 1)] + 1);
      const Eigen::MatrixXd block = Along(n, end, at);
      for (; done < last && kept_[static_cast<size_t>(done)] < end; ++done) {
        rows.row(done - first) = block.row(kept_[static_cast<size_t>(done)] - n);
      }
      n = end;
    }
    return rows;
  }

 private:
  static constexpr Eigen::Index kBlock = 4096;  // samples

  /// The loop where a block begins.
  struct Begin {
    Eigen::Index sample;
    LoopEnd at;
  };

  /// Rows of all samples first <= n < last. at: of the loop at the first, led on to the last; [last - first x p]
  Eigen::MatrixXd Along(Eigen::Index first, Eigen::Index last, LoopEnd& at) const {
    const Eigen::Index size = last - first;
    const Eigen::MatrixXd kernels = DenseKernels(warm_.fit.maps, points_, first, last);
    LoopColumns columns{first, ConcatColumns(law_.middleRows(first, size), kernels)};
    if (of_loss_.size() > 0) {
      columns.loss = ConcatColumns(of_loss_.middleRows(first, size), kernels);
    }
    const Eigen::MatrixXd slopes =
        loop_.SlopesAlong(columns, parameters_, joined_.thermal(), joined_.jumps(), at);
    return ConcatColumns(OfEstimated(slopes, joined_.layout),
                         warm_.task.rigid.columns.middleRows(first, size))(Eigen::all, order_);
  }

  /// Remembers where blocks begin, the last with the last sample, and sums the products of their kept rows.
  void FollowLoop() {
    gram_ = Eigen::MatrixXd::Zero(layout_.size(), layout_.size());
    LoopEnd at{joined_.initial_energy(),
               Eigen::VectorXd::Zero(parameters_.size() + 3 + joined_.layout.jumps.size)};
    at.slopes[parameters_.size() + 2] = 1;
    const Eigen::Index end = m_.size() - 1;
    size_t next = 0;
    for (Eigen::Index n = 0; n <= end;) {
      begins_.push_back({n, at});
      const Eigen::Index last = n == end ? m_.size() : std::min(n + kBlock, end);
      const Eigen::MatrixXd block = Along(n, last, at);
      // those of its rows that are kept
      std::vector<Eigen::Index> kept;
      for (; next < kept_.size() && kept_[next] < last; ++next) kept.push_back(kept_[next] - n);
      // Eigen divides by the number of rows
      if (!kept.empty()) {
        gram_.selfadjointView<Eigen::Lower>().rankUpdate(block(kept, Eigen::all).transpose());
      }
      n = last;
    }
    gram_.triangularView<Eigen::StrictlyUpper>() = gram_.transpose();
  }

  const LogSamples& m_;
  const WarmMaps& warm_;
  ThermalFit joined_;
  Eigen::VectorXd parameters_;  // [d + weights]
  MapPoints points_;            // [N x 5]
  Eigen::MatrixXd law_;         // [N x d]
  Eigen::MatrixXd of_loss_;     // [N x d], or empty where the losses have the same
  ClosedLoop loop_;             // without columns of its own
  Layout layout_;
  std::vector<Eigen::Index> order_;  // of `layout_` in a joined fit
  std::vector<Eigen::Index> kept_;   // [n] samples
  std::vector<Begin> begins_;
  Eigen::MatrixXd gram_;
};

/// residual: [n] of law, maps and heat, N.m or N
JointUncertainty JointCovariance(const IdentifierInput& input, const WarmMaps& warm,
                                 const Eigen::VectorXd& residual) {
  const JointRows joint(input, warm);
  const Eigen::MatrixXd& gram = joint.gram();
  const Eigen::VectorXd prior = joint.prior();
  const Eigen::Index d = gram.cols();

  // columns of norm 1 for the inverse: the gain's are far from the others'
  const Slice& weights = warm.fit.layout.weights;
  Eigen::MatrixXd penalised = gram;
  auto of_weights = penalised.block(weights.begin, weights.begin, weights.size, weights.size);
  of_weights += PenaltyOf(warm.fit.maps, of_weights, warm.fit.unseen, warm.fit.strength);
  // what is known of the heat beforehand
  penalised.diagonal() += prior;
  const Eigen::VectorXd scale = penalised.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factors(scale.asDiagonal() * penalised * scale.asDiagonal());
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() * factors.solve(Eigen::MatrixXd::Identity(d, d)) * scale.asDiagonal();
  const auto rows = [&](Eigen::Index first, Eigen::Index last) {
    return joint.Between(first, last);
  };
  // independent weights: with those that go together gain and time constant are off by half of what is said
  JointUncertainty result;
  result.layout = joint.layout();
  result.known = PenalisedCovariance({gram, inverse, warm.fit.free(), warm.fit.weights(),
                                      warm.fit.strength, warm.fit.unseen, prior},
                                     rows, residual, input.selection);
  const Eigen::VectorXd of_end = joint.OfEnd();
  result.end_energy_std = std::sqrt(of_end.dot(result.known.covariance * of_end));
  return result;
}

/// Of law and heat without the weights between them.
Uncertainty WithoutWeights(Uncertainty known, const MapFit& maps) {
  std::vector<Eigen::Index> places(static_cast<size_t>(known.covariance.cols()));
  std::iota(places.begin(), places.end(), 0);
  places.erase(places.begin() + maps.layout.weights.begin,
               places.begin() + maps.layout.weights.end());
  return Picked(std::move(known), places);
}

/// Adds the warming to a fit of law and maps. known: JointCovariance
void AddHeat(const WarmMaps& warm, const Uncertainty& known, const LogSamples& measurements,
             Fit& fit) {
  const ThermalFit& warming = warm.warming;
  fit.friction.thermal = warming.thermal();
  fit.initial_energy = warming.initial_energy();
  fit.jump_samples = Behind(warm.gaps);
  // rows of the heat, with errors that law, maps and warming share
  const std::vector<FitParameter> rows = HeatTable(warming, warm.gaps, measurements);
  Append(rows, fit);
  fit.errors.known = WithoutWeights(known, warm.fit);
  fit.count += static_cast<int>(rows.size());
  fit.effective_parameters += static_cast<double>(rows.size());
  fit.causes.insert(fit.causes.begin(),
                    Remark(ExplainWarmingBesideMaps(warm.rounds), SentenceIn::message));
  RemarkOnHeat(warming, warm.gaps, measurements, fit);
}

}  // namespace

std::optional<WarmMaps> FitWarmMaps(const IdentifierInput& input, const MapTask& task,
                                    const InitialEnergy& initial) {
  // maps as if nothing warmed, then warming and maps in turns, each beside the other
  MapBlock block(input, task);
  if (!block.ChooseGiven({})) return std::nullopt;
  WarmingBlock warming(input, task, initial);
  Visibility visibility(block.Squares(), Kept(input.measurements.torque, input.selection));

  // what the rounds carry on
  WarmMaps warm;
  std::optional<Thermal> before;
  Eigen::VectorXd energy;  // [N] beside which law and maps are fitted, N.m or N
  AndersonMixing mixing;
  for (warm.rounds = 1; warm.rounds <= kMostRounds; ++warm.rounds) {
    if (!warming.FitGiven(block)) break;
    // at rest: the warming of this round is that of the last
    const Thermal thermal = warming.fit().thermal();
    warm.converged = before && HasConverged(*before, thermal);
    if (warm.converged) break;
    before = thermal;

    // shape and strength are chosen once more where a warming is seen, now that E is known, then kept
    energy = warm.rounds < 3 ? warming.energy() : mixing.Next(energy, warming.energy());
    if (!block.FitGiven(energy)) return std::nullopt;
    visibility.Follow(block.Squares());
    if (warm.rounds != 2) continue;
    warm.visible = visibility.latest();
    if (visibility.StaysUnseen()) return warm;
    if (!block.ChooseGiven(energy)) return std::nullopt;
  }
  // the last round, and how much less it leaves than maps alone
  warm.warming = warming.fit();
  warm.gaps = warming.gaps();
  warm.task = block.Settled();
  warm.fit = block.Complete();
  const auto n = static_cast<double>(warm.fit.fitted.size());
  warm.visible = visibility.Of(block.Squares(), n - warm.fit.effective - 2);
  return warm;
}

Fit AsFit(const IdentifierInput& input, const WarmMaps& warm) {
  const std::string& name = warm.task.identifier;
  const LogSamples& m = input.measurements;
  if (auto why = InsignificantWarming(warm.visible, kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  if (!warm.converged) {
    return Refused(name, Status::not_converged,
                   fmt::format("maps and warming still move after {} rounds; does the torque "
                               "column hold friction?",
                               warm.rounds));
  }

  // law and maps, as sure as the warming beside them leaves them
  const Eigen::VectorXd residual = Kept(m.torque, input.selection).col(0) - warm.fit.fitted -
                                   TorqueOfEnergy(input, warm.task.energy);
  const JointUncertainty joint = JointCovariance(input, warm, residual);
  const Uncertainty& known = joint.known;
  Fit fit = AsFit(input, warm.task, warm.fit, known);
  if (fit.refusal) return fit;

  // the warming; the friction predicts its own energy from here on
  const double log_deviation = known.Deviation(joint.layout.log_time_constant());
  const double time_constant = warm.warming.thermal().time_constant;
  if (auto why = UnidentifiableWarming({.explained = warm.visible,
                                        .log_deviation = log_deviation,
                                        .time_constant = time_constant,
                                        .step = MedianStep(m.time)},
                                       kContext)) {
    return Refused(name, Status::not_identifiable, *why);
  }
  AddHeat(warm, known, m, fit);
  fit.end_energy_std = joint.end_energy_std;
  if (!GivesFriction(fit)) return fit;
  // a friction that drives itself by its own heat is no model
  const FittedGravity gravity = input.options.OrDefault<GravityOption>().gravity;
  if (const auto at = PredictFriction(fit.friction, m, fit.Start()).first_driving; at < m.size()) {
    return Refused(name, Status::inadequate_model,
                   ExplainDriving(m.time[at], RemedyForNonDissipative(fit.friction.law, gravity)));
  }
  return fit;
}

}  // namespace warmjoint
