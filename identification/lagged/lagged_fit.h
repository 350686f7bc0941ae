// The fit to a torque that has passed a lag.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/lagged/lag_search.h"
#include "identification/lagged/lagged_rows.h"
#include "identification/options.h"

namespace warmjoint {

/// The option of an identifier that can estimate a lag.
struct LagOption {
  PartFit torque_lag = PartFit::none;

  template <class A>
  void Serialize(A* a) {
    a->Field("torque_lag", &torque_lag,
             {.meaning = "the torque's first-order lag, estimated where the log shows one"});
  }
};

/// Whether options have it, and it asks for a lag.
bool AsksForLag(const Options& options);

/// Why the other options or the log rule out a lag that the options ask for; nothing where they do not, or
/// where no lag is asked for.
std::optional<std::string> WhyNoLag(const IdentifierInput& input);

/// A model fitted at one time constant of the lag.
struct LaggedModel {
  double squares = kInfinity;  // of its mapped rows
  Eigen::VectorXd torque;      // [N] of the model, without the lag; empty where there is no fit
};

/// How a model is fitted with a lag.
struct LagFits {
  /// At one time constant, to rows of the lag.
  std::function<LaggedModel(const LaggedRows& rows)> fit_at;
  /// With the time constant as one more unknown (RefineLag), from the latest fit on.
  std::function<double(const RowsOfLag& rows_of, double lag, const LagBracket& bracket)> refine;
};

/// The rows of the best lag, the noise of white colour or, where that would be wrong beyond doubt
/// (IsSurelyColoured), of the likelier of two: the one that the residual shows, and that of white
/// noise which the lag has passed, AR(1) with exp(-h / T). Nothing where no lag is seen (SeesLag), either
/// in the residual of the fit without one or in that of the best.
/// measured: [n]; without: [n] torque of that fit, empty where it failed.
std::shared_ptr<const LaggedRows> SearchLag(const std::shared_ptr<const KeptRuns>& runs,
                                            const Eigen::VectorXd& measured,
                                            const Eigen::VectorXd& without, const LagFits& fits);

/// Adds the lag to a fit of the model to those rows: its row of the table, its effect on
/// the model's torque and Jacobian, and the errors of all estimated values together. The fit has its
/// table, model and used samples, `jacobian` of the model without lag, and prior of the errors.
/// model: [N] torque of the model without lag.
void AddLag(const std::shared_ptr<const LaggedRows>& rows, const Eigen::VectorXd& model,
            const LogSamples& measurements, Fit& fit);

}  // namespace warmjoint
