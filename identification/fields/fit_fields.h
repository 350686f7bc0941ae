// A fit with fields beside its law: what they hold, and what they add to its intervals.
#pragma once

#include <functional>
#include <vector>

#include "identification/fields/field_set.h"
#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"

namespace warmjoint {

/// The option of an identifier that can have them.
struct FieldOption {
  FieldSet fields;

  template <class A>
  void Serialize(A* a) {
    a->Field("fields", &fields, kFieldsInfo);
  }
};

/// A fit with the fields that its options ask for; without such options the fit itself. Fields are further unknowns, normal about 0
/// with the kernels of MakeFields; their amplitudes and lengths and the noise's correlation follow from the marginal likelihood
/// (field_evidence.h), over which the answer is averaged. Rows are means over about 40 ms. With x the unknowns of the table and u those of
/// the fields,
///     tau - f(x0) + J x0 = J x + B u + e
/// about the fit x0 to what the fields leave of the torque, J its Jacobian; both alternate until x rests.
///
/// Without heat, level and slope of a law are those of the line through the friction at the 10 % and the 90 % quantile of |v|,
///     F(s) = law(s) + v(s) + mean of r over the places seen + mean of d over the times seen.
/// With heat they are those of the best line, from which the losses follow, and friction has no field over time: a drift is told from a
/// warming by the tests for lack of fit. The friction at speeds is F with the covariance of all unknowns; the maps are r, q and what
/// F has beyond the law. A symmetric law has a constant torque beside it where both directions move, which is part of q.
/// The fit is without fields, with a remark, where it has maps, a lag, or another loss than squares, and where the log has fewer than
/// 60 such rows. make: the fit without fields; input: its samples
Fit FitWithFields(const IdentifierInput& input,
                  const std::function<Fit(const IdentifierInput&)>& make);

}  // namespace warmjoint
