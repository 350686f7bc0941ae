#include "identification/find_parameter.h"

#include <gtest/gtest.h>

#include "identification/fit_parameters.h"

namespace warmjoint {
namespace {

/// With parameters of these names, whose values are their places.
Estimate WithNames(const std::vector<std::string>& names) {
  Estimate estimate;
  for (const std::string& name : names) {
    estimate.parameters.push_back(
        {name, static_cast<double>(estimate.parameters.size()), "1", {}, {}});
  }
  return estimate;
}

TEST(FindParameter, FindsWhatTheRowsOfAFitAreCalled) {
  Measurements m;
  std::vector<FitParameter> rows = HeatParameters({-3, 600}, m);
  rows.push_back(StartParameter(1, m));
  for (FitParameter& row : JumpParameters(Eigen::VectorXd::Zero(11), m)) rows.push_back(row);
  rows.push_back(InertiaParameter(2, m));
  rows.push_back(TorqueLagParameter(0.1, m));

  std::vector<std::string> names;
  for (const FitParameter& row : rows) names.push_back(row.name);
  const Estimate estimate = WithNames(names);
  std::map<Role, int> which;
  for (size_t i = 0; i < rows.size(); ++i) {
    const EstimatedParameter* found = Find(rows[i].role, estimate, which[rows[i].role]++);
    ASSERT_TRUE(found) << rows[i].name;
    EXPECT_EQ(found->value, static_cast<double>(i)) << rows[i].name;
  }
}

TEST(FindParameter, FindsNoRoleThatItLacks) {
  const Estimate estimate = WithNames({"viscous", "energy_jump_2"});
  EXPECT_FALSE(Find(Role::heat, estimate));
  EXPECT_FALSE(Find(Role::jump, estimate));
  EXPECT_TRUE(Find(Role::jump, estimate, 1));
}

TEST(FindParameter, FindsAPartOfAnyLaw) {
  const Estimate estimate =
      WithNames({"gravity_sine", "viscous", "coulomb_positive", "coulomb_negative"});
  EXPECT_EQ(Find(LawPart::slope, estimate)->name, "viscous");
  EXPECT_EQ(Find(LawPart::level, estimate)->name, "coulomb_positive");
  EXPECT_FALSE(Find(LawPart::bristle, estimate));
}

}  // namespace
}  // namespace warmjoint
