#include "identification/nominal_ls.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/least_squares.h"
#include "identification/linear_laws.h"
#include "identification/report_law.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "nominal-ls";

Estimate Identify(const IdentifierInput& input) {
  const Law& law = *FindLaw(input.options.Text("law"));
  const auto d = static_cast<int>(law.parameters.size());
  if (auto why = Unusable(input, d)) return Failed(kName, Status::bad_data, *why);

  // rows of (9) on the samples that satisfy (6)
  const Eigen::MatrixXd A =
      LawColumns(law, Kept(input.measurements.velocity, input.selection).col(0));
  const Eigen::VectorXd torque = Kept(input.measurements.torque, input.selection);
  const LeastSquares fit = SolveLeastSquares(A, torque);
  if (fit.rank < d) {
    std::vector<std::string> mixed;
    for (const Eigen::Index i : fit.mixed) mixed.emplace_back(law.parameters[i].name);
    return Failed(kName, Status::not_identifiable,
                  Indistinct(mixed, input.measurements, input.selection));
  }

  Estimate estimate;
  estimate.identifier = kName;
  const Eigen::VectorXd fitted = A * fit.solution;
  const Uncertainty known = JudgeUncertainty(A, fit.cofactor, torque - fitted, input.selection);
  ReportLaw(law, fit.solution, known, input.measurements, estimate);
  estimate.metrics = ComputeMetrics(torque, fitted, d, d);
  estimate.message = fmt::format("law {} by least squares on {} samples{}", law.name, torque.size(),
                                 ColourOf(known.noise));
  DescribeFriction(law, input.measurements, estimate);
  return estimate;
}

}  // namespace

Identifier NominalLs() {
  return {kName,
          "a nominal law by linear least squares, without warming",
          {{"law", "viscous_coulomb", LinearLawWords(), "nominal friction law"}},
          &Identify};
}

}  // namespace warmjoint
