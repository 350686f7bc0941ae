// Many pictures on one.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// Named pictures in rows of `across`, each kept in proportion. width: points.
/// pictures: at least one.
Figure MakeContactSheet(std::vector<std::pair<std::string, Image>> pictures, int across, int width);

}  // namespace warmjoint::report
