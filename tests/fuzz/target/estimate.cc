// Estimates as JSON, and as they are written again.
#include "identification/estimate.h"

#include <nlohmann/json.hpp>

#include "models/foundation/node.h"
#include "tests/fuzz/fuzz.h"

void warmjoint::fuzz::Read(std::string_view bytes) {
  const Place place{"fuzz.json"};
  const Estimate estimate = EstimateFrom(ParseJsonNode(std::string(bytes), place.file));
  const auto written = EstimateToTree(estimate);
  const std::string text = written.dump();
  const auto again = EstimateToTree(EstimateFrom(ParseJsonNode(text, place.file)));
  fuzz::Require(again.dump() == text);

  // what gravity does over some turns
  if (!estimate.gravity) return;
  const Eigen::VectorXd position = Eigen::VectorXd::LinSpaced(50, -20, 20);
  fuzz::Require(estimate.gravity->Torque(position).size() == position.size());
  estimate.gravity->Covers(position[7]);
}
