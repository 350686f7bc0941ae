// Animated PNG.
#pragma once

#include <string>
#include <vector>

#include "tools/report/gl/image.h"

namespace warmjoint::report {

/// The bytes of an animated PNG (APNG 1.0) that repeats for ever; viewers that do not know it show
/// the last frame. frames: at least one, all of one size. seconds: each frame's, 0.001 ... 65.
/// The same frames give the same bytes.
std::string EncodeFilm(const std::vector<Image>& frames, double seconds,
                       const std::string& description);

}  // namespace warmjoint::report
