// The load of a joint in the fit of a friction that grows with it.
#pragma once

#include "identification/warming/torque_delay.h"

namespace warmjoint {

/// Whether a fit is asked for friction that grows with the load.
bool AsksForLoad(const IdentifierInput& given);

/// Why there is no load to fit; nothing where there is, or where none is asked for.
std::optional<std::string> WhyNoLoad(const IdentifierInput& given);

/// tau = Fn + c |L| sign(v) + G + M a. Where the log has the column load that is L, and c one more linear parameter. Else L = G:
/// the fit is repeated under the load that its own gravity gives, from a fit without c on, until that changes the torque by no
/// more than a share of the noise's reach. A gravity parameter g then acts through the friction, too: its column of the
/// Jacobian is (1 + c sign(G) sign(v)) dG/dg, and the errors are those of that Jacobian. given: samples as FitLaw has them
Fit FitUnderLoad(const IdentifierInput& given, const FitInTime& fit_under);

}  // namespace warmjoint
