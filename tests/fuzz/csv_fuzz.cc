// Bytes that claim to be a recording. Runs in ctest over a corpus and its mutations; with Clang and
// -DWARMJOINT_FUZZ=ON also as a libFuzzer program: csv_fuzz tests/fuzz/corpus/csv.
#include "tests/fuzz/csv_fuzz.h"

#include <cstdlib>

#include "identification/preparation/check_report.h"
#include "models/foundation/bad_input.h"
#include "models/recording/csv.h"

namespace {

void Require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace warmjoint;
  try {
    const Measurements log = ParseCsv({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    const Eigen::Index n = log.size();
    Require(n >= 3 && log.position.size() == n && log.velocity.size() == n);
    Require(log.position.allFinite() && log.velocity.allFinite() && log.torque.allFinite());
    Require((log.time.tail(n - 1).array() > log.time.head(n - 1).array()).all());
    Require(log.torque.maxCoeff() > log.torque.minCoeff());
    Require(!CheckToText(CheckRecording(log)).empty());
  } catch (const BadInput&) {
    // refused, as it may be
  }
  return 0;
}
