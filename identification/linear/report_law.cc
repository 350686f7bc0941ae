#include "identification/linear/report_law.h"

#include "identification/fit_data.h"

namespace warmjoint::inline identification {

void ReportLaw(const Law& law, const Eigen::VectorXd& values, const Uncertainty& known,
               const Measurements& measurements, Estimate& estimate) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const ParameterInfo& info = law.parameters[static_cast<size_t>(i)];
    estimate.parameters.push_back(WithInterval(std::string(info.name), values[i],
                                               UnitFor(info, measurements), known.Deviation(i),
                                               known.freedom));
  }
}

}  // namespace warmjoint::inline identification
