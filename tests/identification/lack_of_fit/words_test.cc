// Every number in a finding's words is what it is defined as.
#include "identification/lack_of_fit/words.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <regex>

#include "identification/fit_data.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

/// The numbers in a text, in its order.
std::vector<double> NumbersIn(const std::string& text) {
  static const std::regex number("-?[0-9]+\\.?[0-9]*(?:e[+-]?[0-9]+)?");
  std::vector<double> numbers;
  for (std::sregex_iterator one(text.begin(), text.end(), number), end; one != end; ++one) {
    numbers.push_back(std::stod(one->str()));
  }
  return numbers;
}

/// Examines what an identifier leaves of a log, and reads the words of what was found.
void ExpectWordsMeanWhatTheySay(const char* name, const Measurements& m) {
  const Identifier& identifier = FindIdentifier(name);
  const IdentifierInput input{Prepare(m), identifier.options, {}};
  const Fit fit = identifier.fit(input);
  const Inference inference = Infer(fit);
  ASSERT_EQ(inference.status, Status::ok) << inference.message;
  const Examination examination =
      ExamineResidual(fit, inference, input.measurements, input.selection);
  ASSERT_FALSE(examination.Found().empty()) << name;

  const double residual = std::sqrt(fit.residual().squaredNorm() / examination.samples);
  double squares = 0;
  for (const Finding* finding : examination.Found()) {
    const double rms = examination.Rms(*finding);
    squares += rms * rms;
    // what is found in a residual is a part of it
    EXPECT_LE(rms, residual) << finding->test->name;

    // "...: 1.3 N rms, 3.2 % of the friction, 54 % of the residual's variance"
    const std::string words = DescribeFinding(examination, *finding, input.measurements);
    const std::vector<double> told = NumbersIn(words.substr(words.rfind(": ")));
    ASSERT_EQ(told.size(), 3u) << words;
    EXPECT_NEAR(told[0], rms, 0.006 * rms) << words;
    EXPECT_NEAR(told[1], 100 * rms / examination.friction, 0.06 * told[1]) << words;
    EXPECT_NEAR(told[2], 100 * rms * rms / (residual * residual), 0.51) << words;
  }
  EXPECT_LE(squares, residual * residual * (1 + 1e-9)) << name;
}

TEST(Words, NameSizesAsTheyAreDefined) {
  ExpectWordsMeanWhatTheySay("nominal-ls", test::RecordHour(test::TableOne(), 1));
  Measurements pushed = test::RecordHour(test::TableOne(), 2);
  pushed.torque.array() += 1.5;
  ExpectWordsMeanWhatTheySay("energy-ml", pushed);
  Measurements late = test::RecordHour(test::TableOne(), 3);
  for (Eigen::Index i = late.size() - 1; i > 0; --i)
    late.torque[i] = 0.6 * late.torque[i] + 0.4 * late.torque[i - 1];
  ExpectWordsMeanWhatTheySay("energy-ml", late);
}

TEST(Words, NameSizesOfRipplesAsTheyAreDefined) {
  Friction rippled = test::Cold();
  rippled.maps = {test::PositionLevel(2.5, 1.5)};
  Measurements m =
      test::RecordFriction(rippled, 0.1, test::Travel(12000, 0.1, 2.5, {0.2, 0.5, 0.9}), 0.3, 1);
  m.torque.array() += 4 * m.position.array().sin();
  ExpectWordsMeanWhatTheySay("nominal-ls", m);
}

}  // namespace
}  // namespace warmjoint
