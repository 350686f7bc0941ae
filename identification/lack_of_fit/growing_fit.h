// A fit that grows by the structure found in its residual.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "identification/lack_of_fit/orthonormal.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/uncertainty/noise_model.h"

namespace warmjoint {

/// Features that a residual may depend on, which are tested together. They are the best of several candidates.
struct Features {
  Eigen::MatrixXd columns;       // [m x q]; q = 0: nothing to test
  int candidates = 1;            // of which these explain most
  double period = 0;             // of those, or time constant, s; 0 where they have none
  std::string_view absent = {};  // why there are none, where TestWords::absent does not say it
};

/// A fit over rows each of which is the mean of some samples, decomposed once (QR) for all that is asked about
/// it. Rows are weighed by the root of the number of samples.
struct WeighedFit {
  /// samples: [m] of each row; derivatives: J [m x p] dF/dx
  WeighedFit(const Eigen::VectorXd& samples, const Eigen::MatrixXd& derivatives);

  Eigen::VectorXd weight;   // [m] samples
  Eigen::VectorXd root;     // [m] of that
  Eigen::VectorXd norms;    // [p] of the weighed derivatives
  Eigen::MatrixXd columns;  // [m x (p + ...)] weighed, of norm 1
  Basis qr;                 // of the columns

  /// Columns weighed. [m x q]
  Eigen::MatrixXd Weighed(const Eigen::MatrixXd& some) const { return root.asDiagonal() * some; }
  /// Columns weighed and scaled to norm 1, so that units do not count; a column of zeros stays zero.
  /// [m x q]
  Eigen::MatrixXd Normed(const Eigen::MatrixXd& some) const;
  /// Subtracts from weighed columns their projection on the fit. [m x q]; returns their products with
  /// its basis, [r x q].
  Eigen::MatrixXd TakeOff(Eigen::Ref<Eigen::MatrixXd> weighed) const;
  /// Omitted-variable bias with its sign turned: the change of x once a force f, N.m or N, is
  /// known, -(J^T W J)^-1 J^T W f. forces: [m x q]; returns [p x q].
  Eigen::MatrixXd BiasBy(const Eigen::MatrixXd& forces) const;
  /// The most that a force of 1 N.m or N at most in each row biases x, [p].
  Eigen::VectorXd MostMoves() const;
  /// Whether no parameter is a mix of the others.
  bool IsFullRank() const { return qr.basis.cols() == norms.size(); }
};

/// The fit to which features are added one after the other, and relative to which they are tested.
class GrowingFit {
 public:
  /// fit: where it begins; residual: [m] N.m or N; place: the places of the m rows in time.
  GrowingFit(WeighedFit fit, const Eigen::VectorXd& residual, const Selection& place);

  /// Estimates the noise from what the fit and all features that will be tested leave together.
  void LearnNoise(const std::vector<Features>& all);

  /// What features explain beyond the fit, with the probability that noise alone explains as much.
  /// The coefficients are tested by Hotelling's T^2 against two estimates of their scatter: that
  /// of the noise as an autoregressive model (noise_model.h), and that of the scores of the rest
  /// over kParts parts of the recording, where enough of them carry the features. The smaller
  /// probability counts twice, and times the candidates (Bonferroni). p = 1 where the fit holds the
  /// features already.
  Finding Test(const Features& features) const;

  /// Lets features join the fit.
  void Take(const Features& features);

  /// [m] what the fit leaves of the residual, N.m or N.
  Eigen::VectorXd Left() const { return left_.cwiseQuotient(fit_.root); }
  /// [m] what the fit takes up of the residual, N.m or N.
  Eigen::VectorXd Explained() const { return (residual_ - left_).cwiseQuotient(fit_.root); }
  /// Squares of the weighted residual that each column explains by itself in addition to the fit.
  /// columns: [m x c]; returns [c], 0 for a column that the fit holds.
  Eigen::VectorXd ExplainedBy(const Eigen::MatrixXd& columns) const;
  /// The same of steps, which are `height` in all rows after a place. part: [m] places before each
  /// row; height: [m]; returns [places].
  Eigen::VectorXd ExplainedBySteps(const std::vector<Eigen::Index>& part, Eigen::Index places,
                                   const Eigen::VectorXd& height) const;
  /// The coefficient of a column that joins the fit's, by least squares; 0 for one that the fit holds.
  double CoefficientOf(const Eigen::VectorXd& column) const;

  Eigen::Index size() const { return residual_.size(); }

 private:
  /// The scatter of coefficients, and the probability that noise alone makes them as large.
  struct Evidence {
    Eigen::MatrixXd scatter;  // [q x q]
    double p = 1;
  };

  /// Counts the samples that determine the noise's variance along the features: noise whose variance there is R times its
  /// mean over all frequencies counts as AR(1) noise of that R does, m/(2 R - 1), less the columns that were there
  /// when it was learned.
  /// own: [m x q] orthonormal, the part of features that is orthogonal to the fit; b: [q] its products with the residual
  Evidence ByColour(const Eigen::MatrixXd& own, const Eigen::VectorXd& b) const;
  Evidence ByParts(const Eigen::MatrixXd& own, const Eigen::VectorXd& b) const;
  /// How much larger the noise model makes the scatter of coefficients than its parts by
  /// themselves do: at least 1, about 1 where the noise forgets within a part. own: [m x q]
  double AcrossParts(const Eigen::MatrixXd& own) const;
  /// Finds what the fit leaves of the residual.
  void Refit();

  Selection place_;
  std::vector<Eigen::Index> ends_;  // of the parts of the recording, one past the last row
  WeighedFit fit_;                  // with the features that joined
  Eigen::VectorXd residual_;        // [m] weighed
  Eigen::VectorXd left_;            // [m] weighed
  NoiseModel noise_;
  double taken_ = 0;  // columns of the fit when the noise was estimated, in samples
};

}  // namespace warmjoint
