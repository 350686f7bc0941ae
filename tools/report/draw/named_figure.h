// Families of figures: one list for each kind of thing that is drawn.
#pragma once

#include <optional>
#include <string>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// One figure of a family; nothing where `view` has no data for it.
template <typename View>
struct NamedFigure {
  std::string name;     // of the file
  std::string summary;  // what it shows, one line
  std::optional<Figure> (*make)(const View& view);
  std::string needs;  // what a view without it lacks
};

}  // namespace warmjoint::report
