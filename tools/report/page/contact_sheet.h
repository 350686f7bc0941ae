// Many figures on one page.
#pragma once

#include <vector>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// The first plot or picture of each figure under the figure's title, in rows of three, with words
/// as large as everywhere. figures: at least one.
Figure MakeContactSheet(const std::vector<Figure>& figures);

}  // namespace warmjoint::report
