// What rows make of an answer does not depend on their order.
#include "identification/inference/apply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace warmjoint {
namespace {

/// viscous 5 +- 1 and coulomb 15 +- 2, as half widths.
Inference ByNoise() {
  Inference inference;
  inference.message = "fitted";
  inference.gives_friction = true;
  inference.parameters = {{5, 0.5, {{4, 6}}, 0}, {15, 1, {{13, 17}}, 0}};
  return inference;
}

Cause Moves(Source source, Action action, double viscous, double coulomb) {
  return {.source = source,
          .action = action,
          .rows = {0, 1},
          .bias = Eigen::Vector2d(viscous, coulomb)};
}

std::vector<Cause> Rows() {
  std::vector<Cause> rows{Moves(Source::rounding, Action::shift, 0.25, 0),
                          Moves(Source::gaps, Action::widen, -0.5, 1),
                          Moves(Source::findings, Action::widen, 0.5, -1),
                          Moves(Source::open_drift, Action::note, 100, 100)};
  rows[2].spread = Eigen::Vector2d(0, 1);
  rows[1].sentence = "gaps";
  rows[2].sentence = "findings";
  return rows;
}

TEST(Apply, AddsUpWhatRowsDo) {
  const Inference answer = Apply(ByNoise(), Rows());
  EXPECT_EQ(answer.status, Status::ok);
  EXPECT_DOUBLE_EQ(answer.parameters[0].value, 5.25);
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[0], 4 + 0.25 - 1);
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[1], 6 + 0.25 + 1);
  // 1 and 1, and 1.96 of what findings scatter
  EXPECT_DOUBLE_EQ((*answer.parameters[1].interval95)[0], 13 - 3.96);
  EXPECT_DOUBLE_EQ(answer.parameters[1].widened, 3.96);
}

TEST(Apply, CoversTheValueAndTheValueMoved) {
  const Inference far = Apply(ByNoise(), {Moves(Source::held_losses, Action::cover, 100, -100)});
  // of ends far apart each is left on one side alone: 1.645 of 1.96 half widths
  EXPECT_NEAR((*far.parameters[0].interval95)[0], 5 - 1.645 / 1.96, 1e-3);
  EXPECT_NEAR((*far.parameters[0].interval95)[1], 105 + 1.645 / 1.96, 1e-3);
  EXPECT_NEAR((*far.parameters[1].interval95)[0], -85 - 2 * 1.645 / 1.96, 1e-3);
  const Inference near = Apply(ByNoise(), {Moves(Source::held_losses, Action::cover, 1e-9, 0)});
  EXPECT_NEAR((*near.parameters[0].interval95)[1], 6, 1e-3);
}

TEST(Apply, TakesTheRefusalThatSaysMost) {
  std::vector<Cause> rows = Rows();
  rows.push_back({.source = Source::few_samples,
                  .action = Action::refuse,
                  .status = Status::not_identifiable,
                  .sentence = "few"});
  rows.push_back({.source = Source::faults,
                  .action = Action::refuse,
                  .status = Status::bad_data,
                  .sentence = "faulty"});
  rows.push_back({.source = Source::recording,
                  .sentence = "of the log",
                  .sentence_in = SentenceIn::any_answer});
  const Inference answer = Apply(ByNoise(), rows);
  EXPECT_EQ(answer.status, Status::bad_data);
  EXPECT_EQ(answer.message, "faulty");
  EXPECT_EQ(answer.warnings, std::vector<std::string>{"of the log"});
  EXPECT_FALSE(answer.gives_friction || answer.parameters[0].interval95 ||
               answer.parameters[1].std);
  EXPECT_DOUBLE_EQ(answer.parameters[0].value, 5.25);
}

TEST(Apply, DoesNotDependOnTheOrderOfRows) {
  std::vector<Cause> rows = Rows();
  rows.push_back(Moves(Source::held_losses, Action::cover, 0.5, -0.25));
  rows.push_back({.source = Source::hints, .without_interval = {1}});
  const Inference first = Apply(ByNoise(), rows);
  EXPECT_FALSE(first.parameters[1].interval95);
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  do {
    std::vector<Cause> turned;
    for (const int i : order) turned.push_back(rows[static_cast<std::size_t>(i)]);
    const Inference answer = Apply(ByNoise(), turned);
    ASSERT_EQ(answer.warnings, first.warnings);
    ASSERT_DOUBLE_EQ(answer.parameters[0].value, first.parameters[0].value);
    ASSERT_DOUBLE_EQ((*answer.parameters[0].interval95)[0], (*first.parameters[0].interval95)[0]);
    ASSERT_DOUBLE_EQ((*answer.parameters[0].interval95)[1], (*first.parameters[0].interval95)[1]);
  } while (std::ranges::next_permutation(order).found);
}

}  // namespace
}  // namespace warmjoint
