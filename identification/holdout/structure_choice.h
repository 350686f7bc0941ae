// Which of several structures to believe, from their errors on data that they have not seen.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace warmjoint {

/// A structure that fits the recording.
struct StructureCandidate {
  std::string name;
  Eigen::VectorXd errors;  // [blocks] mean squared error on each block that it has not seen
  double in_sample = 0;    // mean squared error of the fit to all samples
  double parameters = 0;   // effective number
};

/// n ln(mean squared error) + d ln(n), Schwarz 1978. mean_square: of the fit to all samples.
double Bic(double mean_square, double parameters, double samples);

struct Choice {
  size_t chosen = 0;
  size_t best = 0;    // of the least mean error; the chosen one may be a simpler one
  double excess = 0;  // mean error of the chosen less that of the best
  double doubt = 0;   // standard error of that difference over the blocks
};

/// The simplest contender that is not worse than the best beyond doubt: its mean error exceeds the
/// best one's by no more than one standard error of their difference over the blocks (Breiman et
/// al. 1984, 3.4.3, on paired differences), or BIC prefers it on all samples. Of equally simple
/// ones, the one of the least error. contenders: at least one; samples: n of BIC.
Choice ChooseStructure(const std::vector<StructureCandidate>& contenders, double samples);

}  // namespace warmjoint
