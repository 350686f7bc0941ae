// Structures that are tried on one log and compared on parts of it that they have not seen.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "identification/identifiers/condense.h"
#include "identification/identifiers/structures.h"
#include "identification/inference/inference.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {

/// A structure that fits the recording.
struct StructureCandidate {
  std::string name;
  Eigen::VectorXd left;   // [n] of the torque of rows that it has not seen, N.m or N
  double parameters = 0;  // effective number

  /// (N.m)^2 or N^2, over the rows
  double MeanSquare() const { return left.squaredNorm() / static_cast<double>(left.size()); }
};

/// n ln(mean squared error) + d ln(n), Schwarz 1978. mean_square: of the fit to all samples.
double Bic(double mean_square, double parameters, double samples);

struct Choice {
  size_t chosen = 0;
  size_t best = 0;  // of the least mean error; the chosen one may be a simpler one
};

/// The simplest contender that is not worse than the best beyond what the best of m richer ones gains by chance. Let r be what
/// the best leaves of unseen rows, and r + d what a simpler one leaves. The best gains D = sum(d^2 + 2 r d). Where the simpler
/// one is right, D is that of noise, on average below 0, with a variance of 4 var(sum r d) at most, which the sums over
/// kParts parts of the log show however the noise is coloured within them. The structure stays unless
///
///     D > t 2 sqrt(sum over parts (sum r d)^2),   t: the quantile 1 - 0.05/m of Student's t (Bonferroni)
///
/// so that one log in twenty, at most, gets a structure by chance. A gain in a few parts alone, as of a warming, does not
/// count as noise. Of equally simple ones, the one of the least error. contenders: at least one, over the same rows in time.
Choice ChooseStructure(const std::vector<StructureCandidate>& contenders);

/// Whether the weight of what a joint carries, a sine of its position, explains most of what a linear law leaves without it: the
/// law with that weight leaves less than half as large a square of rows that it has not seen, beyond chance (ChooseStructure).
/// input: of an identifier without gravity. False where the position does not tell, or nothing fits.
bool ShowsWeight(const IdentifierInput& input);

/// The result of a structure on the rows that are compared.
struct Trial {
  Structure structure;
  Fit fit{};
  bool gives_friction = false;
  Inference inferred{};   // of one that gives no friction: why
  std::string dropped{};  // why it is no contender; empty for one that is
  bool outdone = false;   // whether it was dropped in favour of another that is still a contender
  std::optional<Eigen::VectorXd> unseen{};  // [N] of a contender, UnseenResiduals

  double Parameters() const { return fit.rows.effective_parameters; }
  /// (N.m)^2 or N^2; of exact fits that of rounding, so that none is better than another.
  double MeanSquare() const {
    return std::max(fit.rows.residual().squaredNorm() / static_cast<double>(fit.rows.torque.size()),
                    RoundingVariance(fit.rows.torque));
  }
};

/// Everything that is tried on one log.
class ModelComparison {
 public:
  /// On rows that hold the means of neighbouring samples. selection: of the samples that take part. What
  /// the input refers to must outlive it.
  ModelComparison(const IdentifierInput& input, const Selection& selection);
  ModelComparison(const ModelComparison&) = delete;
  ModelComparison& operator=(const ModelComparison&) = delete;

  /// Fits structures. Of maps, the shapes that they chose are kept from then on.
  void Add(const std::vector<Structure>& structures);
  /// Reports structures that are not tried.
  void LeaveOut(const std::vector<Structure>& structures, const std::string& why);

  /// The structure that BIC prefers so far, of those that fit all rows; none where nothing does.
  const Structure* Best() const;

  /// The lag, s, that the best so far finds where every sample shows one; nothing where none does. all: the
  /// input with every sample.
  std::optional<double> LagOfBest(const IdentifierInput& all) const;
  /// The same of a delay of the torque of motion of any kind. Where the best is refused on every sample, by FindLateTorque.
  std::optional<double> DelayOfBest(const IdentifierInput& all) const;

  /// Whether a map may help: the best so far leaves structure over place, or nothing fits.
  bool MayHaveMap() const;

  /// The kernels of maps that suit the log, chosen once, given the warming of the best so far. gravity: its
  /// kind, fitted together with the maps.
  ChosenKernels KernelsGivenBest(FittedGravity gravity) const;

  /// Whether a warming may be identifiable together with gravity, which has been tried without warming: a linear law
  /// is identifiable with that gravity, or the best so far has it.
  bool MayWarmWith(FittedGravity gravity) const;

  /// Whether the Stribeck law with warming may be identifiable, which costs more than either by itself: so far the Stribeck law
  /// is identifiable without warming, or a linear law with it.
  bool MayBendAndWarm(FittedGravity gravity) const;

  /// Whether a level for each direction may help the Stribeck law with that warming: what it leaves
  /// pushes in one direction. Where it does not fit, the residual of the linear law decides; with warming, which costs
  /// more, that two levels fit without it.
  bool MayHaveTwoLevels(PartFit warming, FittedGravity gravity) const;

  /// Drops laws without a slope over speed where the same structure with a slope was fitted: a slope that is not significant is
  /// not 0, and its interval shows how large it may be. Laws without a slope are kept where the motion does not determine a slope.
  void DropWithoutSlope();

  /// Drops those that cannot be chosen whatever the blocks say, because another one that is not dropped is simpler and
  /// preferred by BIC, or leaves half of the residual.
  void DropDominated();

  /// Drops the trial of a structure that leaves its bounds on every sample, though not on the rows that are compared.
  void DropBeyondBounds(const Structure& structure);

  /// The structure that is not dropped, where it is the only one, so that there is nothing to compare; else null.
  const Structure* OnlyOne() const;

  /// What those that are not dropped leave of blocks that they have not seen, of the rows that all of them predict. Where one
  /// fails without a block, those that were dropped in favour of it return.
  std::vector<StructureCandidate> Compare(int blocks);
  /// The structure of the i-th contender of the last comparison.
  const Structure& Contending(size_t i) const { return trials_[standing_[i]].structure; }

  const Trial& First() const { return trials_.front(); }
  /// All trials, for a reader.
  std::vector<StructureTrial> Reported() const;

 private:
  const Trial* BestTrial() const;
  /// Finds what a trial leaves of unseen blocks between bounds; false, and why, where it fails without one.
  bool HoldOut(Trial& trial, const std::vector<Eigen::Index>& bounds);
  /// Whether a linear law with warming is identifiable.
  bool MayWarm() const;
  double BicOf(const Trial& one) const { return Bic(one.MeanSquare(), one.Parameters(), rows_); }
  /// The trial of a structure; null where it was not tried.
  const Trial* Find(const Structure& structure) const;
  /// The same structure as one whose law has no slope over speed, with a slope, where that gives friction; else null.
  const Trial* WithSlope(const Trial& trial) const;
  /// Whether the residual has a mean for which BIC would accept one more parameter.
  bool Pushes(const Fit& fit) const;
  /// Why one cannot be chosen given another; empty where it can.
  std::string WhyDominated(const Trial& one, const Trial& other) const;

  const CondensedLog log_;
  const IdentifierInput quick_;
  double rows_;
  std::vector<Trial> trials_;
  std::vector<size_t> standing_;  // places of the contenders among the trials
};

}  // namespace warmjoint
