// Truth files as JSON, and as they are written again.
#include <warmjoint/simulation.h>

#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;

Truth Parsed(const std::string& text) { return ReadAs<Truth>(ParseJsonNode(text, "truth.json")); }

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  const Truth truth = Parsed(std::string(bytes));
  const Eigen::Index n = truth.velocity.size();
  fuzz::Require(truth.force.size() == n && truth.loss.size() == n && truth.energy.size() == n);
  const std::string written = WriteFields(truth).dump();
  fuzz::Require(WriteFields(Parsed(written)).dump() == written);

  // and from file to file
  const fuzz::ScratchFile file("");
  WriteTruth(truth, file.path());
  fuzz::Require(WriteFields(ReadTruth(file.path())).dump() == written);
}
