// Small recordings for tests.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace warmjoint {

/// Writes `samples` rows of time (every second), position, velocity and torque of a joint that
/// turns with velocity(i) rad/s under 5 v + 15 sign(v) N.m and a little ripple in place of noise.
/// level(i): what joins the level at each sample, N.m.
void WriteRecordingFile(
    const std::filesystem::path& path, int samples, const std::function<double(int)>& velocity,
    const std::function<double(int)>& level = [](int) { return 0.0; });

}  // namespace warmjoint
