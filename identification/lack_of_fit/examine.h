// What the residual of a fit still shows: the whole table of tests for lack of fit on one log.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/fit/cause.h"
#include "identification/inference/inference.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/significance.h"

namespace warmjoint {

/// The outcome of every test, and how much the log's assumptions matter.
struct Examination {
  std::vector<Finding> findings;  // one for each row of the table, in its order
  /// How much the parameters are biased by what no test can see, by what the log does not determine, and by what was found.
  /// Rows that follow from numbers alone have their action; the others are notes.
  std::vector<Cause> causes;
  std::vector<size_t> rows;  // [p] of the fit's table, to which the biases belong
  double friction = 0;       // rms of law and heat over the kept samples, N.m or N
  double samples = 0;
  double squares = 0;  // of the residual

  /// Adds a row. bias: [p], entries after these are ignored; size: by how much an assumption was taken to be wrong
  void Add(Source source, Action action, Eigen::VectorXd bias, double size = 0);

  /// Rms over the kept samples of what a finding explains, N.m or N.
  double Rms(const Finding& finding) const;

  /// The findings of the tests that reject, the largest first.
  std::vector<const Finding*> Found() const;

  /// The findings of tests that do not reject, but would before the p-values were adjusted for the number of tests.
  std::vector<const Finding*> FoundUnadjusted() const;
};

/// Makes all tests at one error level (significance.h). A test that cannot be made says why.
/// model: of the fit, or none where it was refused; by_noise: what noise says of the fit.
Examination ExamineResidual(const std::optional<FittedModel>& model, const Fit& fit,
                            const Inference& by_noise, const LogSamples& measurements);

/// The table of tests where none is made: for one reason, or, where that is empty, for the reason of each test.
std::vector<Finding> NotMade(const std::string& reason);

}  // namespace warmjoint
