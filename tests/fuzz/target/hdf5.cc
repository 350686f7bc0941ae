// Recordings as HDF5. The library crashes and hangs on damaged files; what may not happen is that this process does.
#include <functional>

#include "models/recording/read_recording.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;
using fuzz::Require;

constexpr double kPatience =
    0.05;  // s; some inputs make the library run for ever, good ones take 5 ms

void Read(std::string_view bytes) {
  const fuzz::ScratchFile file(bytes, ".h5");
  // half of the inputs by columns of matrices in groups
  ReadSettings layout;
  if (std::hash<std::string_view>()(bytes) % 2 == 1) {
    layout.map = {{"position", "m[1]"}, {"torque", "g/m[0]"}};
  }
  const Measurements log = ReadRecordingFile(file.path().string(), layout, kPatience);
  const Eigen::Index n = log.size();
  Require(n >= 3 && log.position.size() == n);
  Require(log.velocity.size() == n || log.velocity.size() == 0);
  Require(log.position.allFinite() && log.velocity.allFinite() && log.torque.allFinite());
  Require((log.time.tail(n - 1).array() > log.time.head(n - 1).array()).all());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::MayRefuse(Read, fuzz::Text(data, size));
  return 0;
}
