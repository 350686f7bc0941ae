// The charts of pages: dygraphs, from Debian's libjs-dygraphs when the program was built.
#pragma once

#include <string_view>

namespace warmjoint::report {

std::string_view ChartScript();
std::string_view ChartStyle();
/// Its copyright and licence (MIT), as Debian's package states them.
std::string_view ChartLicence();

}  // namespace warmjoint::report
