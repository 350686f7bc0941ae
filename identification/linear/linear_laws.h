// Laws as columns of a linear regression, Eqs. (7)-(9).
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>
#include <span>

#include "identification/options.h"
#include "models/foundation/serialize.h"
#include "models/friction/laws.h"

namespace warmjoint {

/// Whether Fn(v; p) is linear in p and depends on all of p, judged by superposition at several
/// speeds and values.
bool IsLinear(const Law& law);

/// One of the laws that are linear in their parameters.
struct LinearLaw {
  const Law* law = FindLaw(ViscousCoulomb::name);

  const Law& operator*() const { return *law; }
  const Law* operator->() const { return law; }
  bool operator==(const LinearLaw&) const = default;
};
std::span<const Word<LinearLaw>> WordsOf(LinearLaw);

/// The option of an identifier that fits one of them.
struct LawOption {
  LinearLaw law;

  template <class A>
  void Serialize(A* a) {
    a->Field("law", &law, {.meaning = "nominal friction law"});
  }
};

/// Regressor A of Fn = A p, one column for each parameter: [v, sign v] for Eq. (2).
/// velocity: [N] rad/s or m/s; returns [N x d]. The law must be linear.
Eigen::MatrixXd LawColumns(const Law& law, const Eigen::VectorXd& velocity);

/// The option of an identifier that can estimate friction that grows with what the joint carries.
struct LoadOption {
  PartFit load = PartFit::none;

  template <class A>
  void Serialize(A* a) {
    a->Field("load", &load,
             {.meaning = "friction that grows with the load, load_gain times |load|: estimated by "
                         "the column load, else by the gravity that is fitted with it; or none"});
  }
};

/// Columns of a law over samples, [N x d], and where it is estimated that of load_gain after them, |load| sign(v). carried: [N] load,
/// without which load_gain cannot be estimated
Eigen::MatrixXd WithLoad(Eigen::MatrixXd of_law, PartFit load, const Eigen::VectorXd& velocity,
                         const std::optional<Eigen::VectorXd>& carried);

/// Regressor of Fn, with the column of load_gain, |load| sign(v), after those of the law's parameters where it is estimated.
/// velocity: [N]; load: [N] of the log; returns [N x d] or [N x d + 1]
Eigen::MatrixXd NominalColumns(const Law& law, PartFit load, const LogSamples& measurements,
                               const Eigen::VectorXd& velocity);

/// The same at the loss velocity of a log, which makes the losses of ClosedLoop::Along; empty where the log has none.
Eigen::MatrixXd LossColumns(const Law& law, const LogSamples& measurements,
                            PartFit load = PartFit::none);

}  // namespace warmjoint
