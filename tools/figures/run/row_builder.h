// One identifier's results as they come, for pictures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenarios/suite.h"
#include "tools/figures/run/run_view.h"
#include "tools/store/run_store.h"

namespace warmjoint::figures {

/// The results of one identifier, in the order of units: all are counted, and the numbers of those that
/// are drawn are kept.
class RowBuilder {
 public:
  void Count(const Result& result);
  void Draw(const Result& result);

  RunRow Row(const RunStore& store, const Suite& suite, const SuiteIdentifier& identifier) const;

 private:
  using Numbers = std::vector<double>;

  /// One parameter of the truth.
  struct ParameterNumbers {
    std::string name;
    int intervals = 0, covered = 0;
    Numbers estimate, truth, bound;
  };

  std::vector<RunUnit> units_;  // the first ones, for courses
  int runs_ = 0;
  int identifier_ = 0;
  std::map<std::string, int> failures_;
  std::vector<int> variant_, realization_;
  Numbers npe_, rmse_, fit_, fpe_, mae_;
  std::vector<ParameterNumbers> parameters_;  // of the first score on
};

}  // namespace warmjoint::figures
