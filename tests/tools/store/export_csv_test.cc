#include "tools/store/export_csv.h"

#include <gtest/gtest.h>

#include <cmath>

namespace warmjoint {
namespace {

std::string ResultsToCsv(const std::vector<Result>& results,
                         const std::vector<std::string>& labels) {
  Suite suite;
  for (const std::string& label : labels) suite.identifiers.push_back({label, label, {}, {}});
  CsvColumns columns;
  for (const Result& result : results) columns.Add(result);
  std::string csv = CsvHeader(columns.Names(), suite);
  for (const Result& result : results) csv += CsvRow(result, columns.Names(), suite);
  return csv;
}

TEST(ExportCsv, WritesOneRowAResultWithEmptyCellsForTheUnknown) {
  Result scored;
  scored.status = "ok";
  scored.metrics = Metrics{10, 2, 2, 0.1, 0.2, 99, 0.3};
  scored.score = Score{{{"viscous", 5, 5.5, true, true, 0.25}},
                       {{"viscous", 5, 5.5, true, true, 0.25}},
                       0.1,
                       0.1,
                       0.05,
                       NAN};
  Result failed;
  failed.identifier = 1;
  failed.status = "crashed";
  failed.message = "said \"no\", twice";
  EXPECT_EQ(ResultsToCsv({scored, failed}, {"ours", "theirs"}),
            "realization,identifier,status,n,parameters,effective_parameters,rmse,mae,fit,fpe,"
            "npe_continuous,npe_discrete,bound_npe_continuous,bound_npe_discrete,"
            "viscous,viscous_truth,viscous_bound,viscous_covered,message\n"
            "0,ours,ok,10,2,2,0.1,0.2,99,0.3,0.1,0.1,0.05,,5.5,5,0.25,1,\n"
            "0,theirs,crashed,,,,,,,,,,,,,,,,\"said \"\"no\"\", twice\"\n");
}

TEST(ExportCsv, NumbersReadBackBitForBit) {
  Result result;
  result.metrics = Metrics{1, 1, 1, 0.1 + 0.2, 1.0 / 3.0, 5e-324, 1e300};
  const std::string csv = ResultsToCsv({result}, {"one"});
  for (const char* digits : {"0.30000000000000004", "0.3333333333333333", "5e-324", "1e+300"}) {
    EXPECT_NE(csv.find(digits), std::string::npos) << digits << " in " << csv;
  }
}

}  // namespace
}  // namespace warmjoint
