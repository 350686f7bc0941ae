// What to try where friction falls with speed in a way that a law without a curve cannot follow.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint {

/// Whether a law has a Coulomb level for each direction of motion.
bool TellsDirections(std::string_view law);

/// "stribeck" with its options: the law with a level for each direction where `law`, a fit's, has two,
/// and the warming that is asked for. warming: none or estimated.
std::string CurveCommand(std::string_view law, std::string_view warming);

/// An identifier of linear laws, with the option for a level for each direction where `law` has two.
std::string LinearCommand(std::string_view identifier, std::string_view law);

}  // namespace warmjoint
