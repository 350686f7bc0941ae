// A made-up run for tests of pictures: two identifiers, known errors.
#pragma once

#include <cmath>

#include "models/foundation/random_stream.h"
#include "tools/figures/run/run_view.h"

namespace warmjoint::figures {

inline constexpr Eigen::Index kExampleRealizations = 40;

/// Estimates about the truth with a relative deviation, [R].
inline ParameterColumn ExampleColumn(const std::string& name, double truth, double deviation,
                                     RandomStream& random) {
  ParameterColumn column{name, "N·m", {}, {}, {}, 40, 38};
  column.truth = Eigen::VectorXd::Constant(kExampleRealizations, truth);
  column.bound = Eigen::VectorXd::Constant(kExampleRealizations, deviation * std::abs(truth));
  column.estimate = column.truth;
  for (double& value : column.estimate) value += deviation * std::abs(truth) * random.Normal();
  return column;
}

inline RunRow ExampleRow(const std::string& label, const std::string& identifier, double npe,
                         RandomStream& random) {
  RunRow row;
  row.label = label;
  row.identifier = identifier;
  row.runs = kExampleRealizations;
  row.variant = Eigen::VectorXi::LinSpaced(kExampleRealizations, 0, 1);
  row.realization = Eigen::VectorXi::LinSpaced(kExampleRealizations, 0, kExampleRealizations - 1);
  row.npe = row.rmse = row.fit = row.fpe = row.mae = Eigen::VectorXd(kExampleRealizations);
  for (Eigen::Index i = 0; i < kExampleRealizations; ++i) {
    row.npe[i] = npe * std::exp(0.3 * random.Normal());
    row.rmse[i] = 0.5 + 0.01 * random.Normal();
    row.fit[i] = 93 + random.Normal();
  }
  row.fpe = row.rmse.cwiseAbs2();
  row.mae = 0.8 * row.rmse;
  row.parameters = {ExampleColumn("viscous", 5, 0.01, random),
                    ExampleColumn("coulomb", 15, 0.02, random),
                    ExampleColumn("thermal_time_constant", 600, 0.03, random)};
  return row;
}

/// A trace of 200 iterations from twice the truth to the truth.
inline ParameterTrace ExampleTrace() {
  ParameterTrace trace;
  trace.iteration = Eigen::VectorXd::LinSpaced(200, 1, 200);
  const Eigen::RowVectorXd fall = (-0.05 * trace.iteration.transpose().array()).exp();
  const Eigen::VectorXd spread = Eigen::VectorXd::LinSpaced(kExampleRealizations, 0.5, 1.5);
  trace.npe = spread * fall;
  trace.rmse = (0.5 + (spread * fall).array()).matrix();
  trace.names = {"viscous", "thermal_pole"};
  trace.parameters = {(5 * (1 + (spread * fall).array())).matrix(), trace.npe};
  return trace;
}

/// energy-ml, and an energy-als of which 12 runs failed.
inline RunView ExampleRun() {
  RandomStream random({11, 0}, Stream::test);
  RunView run;
  run.suite = "table1";
  run.question = "Which identifier?";
  run.realizations = kExampleRealizations;
  run.torque_unit = "N·m";
  run.rungs = {"noise.torque", "N.m", Eigen::Vector2d(0.1, 1), {}};
  run.bound_npe = 0.012;
  run.noise = 0.5;
  run.rows = {ExampleRow("energy-ml", "energy-ml", 0.011, random),
              ExampleRow("energy-als, 50 iterations", "energy-als", 0.2, random)};
  RunRow& em = run.rows[1];
  em.failures["not_converged"] = 12;
  em.npe.head(12).setConstant(std::nan(""));
  em.trace = ExampleTrace();
  run.bound_covariance = Eigen::Vector3d(1, 4, 9).asDiagonal();
  return run;
}

}  // namespace warmjoint::figures
