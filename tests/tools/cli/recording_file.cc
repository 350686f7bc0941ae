#include "tests/tools/cli/recording_file.h"

#include <fmt/format.h>

#include <cmath>

#include "models/foundation/atomic_file.h"
#include "models/friction/sign.h"

namespace warmjoint {

void WriteRecordingFile(const std::filesystem::path& path, int samples,
                        const std::function<double(int)>& velocity,
                        const std::function<double(int)>& level) {
  std::string text = "time,position,velocity,torque\n";
  double position = 0;
  for (int i = 0; i < samples; ++i) {
    const double v = velocity(i);
    const double torque = 5 * v + (15 + level(i)) * Sign(v) + 0.2 * std::sin(12.9898 * i);
    text += fmt::format("{},{},{},{}\n", i, position, v, torque);
    position += v;
  }
  WriteWholeFile(path, text);
}

}  // namespace warmjoint
