// Identifier `nominal-ls`: a nominal law by linear least squares, Eqs. (7)-(9).
//
// x = argmin |A x - tau|, rows of A as in Eq. (9): [v, sign v] for law (2). Standard deviations
// as in uncertainty.h, right for coloured noise too.
#include "identification/fields/fit_fields.h"
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/fit_law.h"
#include "identification/warming/torque_delay.h"

namespace warmjoint {

Identifier NominalLs() {
  static constexpr const char* name = "nominal-ls";
  return {name, "a nominal law by linear least squares, without warming",
          OptionGroups<LawOption, GravityOption, LoadOption, MotionOption, LossOption, LagOption,
                       DelayOption, FieldOption>{},
          [](const IdentifierInput& input) {
            return FitWithFields(input, [](const IdentifierInput& given) {
              return FitLaw(name, given, PartFit::none);
            });
          }};
}

}  // namespace warmjoint
