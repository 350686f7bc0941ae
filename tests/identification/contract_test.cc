// What every identifier of the list owes, whatever its method.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "identification/answer/identify.h"
#include "identification/estimate.h"
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"
#include "models/friction/friction_json.h"
#include "tests/support/bristle_recording.h"
#include "tests/support/judging.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// The recording with a load (N.m) and a temperature (degC) that friction does not care for.
Measurements WithMoreColumns(Measurements recording) {
  recording.load = (0.1 * recording.time.array()).sin();
  recording.temperature = 30 + 5 * (0.007 * recording.time.array()).sin();
  return recording;
}

class Contract : public ::testing::TestWithParam<Identifier> {
 protected:
  Estimate Identify(const Measurements& measurements, const Selection& selection) const {
    // one that iterates may do so until it has arrived
    std::map<std::string, std::string> given;
    for (const OptionInfo& option : GetParam().options.List()) {
      if (option.name == "iterations") given["iterations"] = "500";
      if (option.name == "motion")
        given["motion"] = "constant";  // the selection says which samples
      // few kernels of one width: what is owed does not depend on their number
      if (option.name == "width") given["width"] = "1";
      if (option.name.ends_with("kernels") && option.name != "velocity_kernels" &&
          option.name != "energy_kernels") {
        given[option.name] = "8";
      }
    }
    return IdentifyUnchecked(GetParam(), {Prepare(measurements, selection),
                                          GetParam().options.Read(given), StartKey{{11, 3}}});
  }
  Estimate Identify(const Measurements& measurements) const {
    return Identify(measurements, SelectMoving(measurements));
  }
  Estimate IdentifyRich() const { return Identify(Rich()); }

  /// Expects of a log that was made of the rich one what `change` makes of that one's parameters.
  void ExpectOf(const Measurements& log,
                const std::function<void(EstimatedParameter&)>& change) const {
    const Estimate estimate = Identify(log), original = IdentifyRich();
    ASSERT_FALSE(original.parameters.empty()) << original.message;
    ASSERT_EQ(estimate.parameters.size(), original.parameters.size()) << estimate.message;
    for (EstimatedParameter expected : original.parameters) {
      change(expected);
      const EstimatedParameter* found = estimate.Find(expected.name);
      ASSERT_TRUE(found) << expected.name;
      // 1e-6: iterative optimisers (golden/README)
      EXPECT_NEAR(found->value, expected.value, 1e-6 * std::abs(expected.value)) << expected.name;
    }
  }

  /// What shows all that the identifier identifies.
  static const Measurements& Rich() {
    if (GetParam().name == "lugre") return Turning();
    return GetParam().name == "stribeck" ? Slow() : Warm();
  }

  /// Two hours at 1 s, from cold, with rests of 10 min that let the joint cool.
  static const Measurements& Warm() {
    static const Measurements recording = WithMoreColumns(
        test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(7200, 1, 600), 0.1, 1));
    return recording;
  }
  /// Twelve minutes at 0.1 s of a cold joint with the Stribeck effect, at speeds that show it.
  static const Measurements& Slow() {
    static const Measurements recording =
        test::RecordFriction(test::StribeckJoint(), 0.1, test::SlowAndFast(7200, 1), 0.1, 1);
    return recording;
  }
  /// Two minutes at 0.01 s of a cold joint with a bristle, with turns that show it.
  static const Measurements& Turning() {
    static const Measurements recording =
        test::RecordBristle(test::LuGreJoint(), test::TurningMotion(120, 1), 120, 100, 0.3, 0.1, 1);
    return recording;
  }
  /// The same motions of joints whose friction falls by 5 N.m a rad/s, which no law allows.
  static Measurements Falling(const Friction& warm_or_cold) {
    const auto falling = [](Friction friction) {
      friction.parameters["viscous"] = -5;
      return friction;
    };
    if (GetParam().name == "lugre") {
      Measurements recording = Turning();
      recording.torque -= 10 * recording.velocity;
      return recording;
    }
    if (GetParam().name == "stribeck") {
      return test::RecordFriction(falling(test::StribeckJoint()), 0.1, test::SlowAndFast(7200, 1),
                                  0.1, 1);
    }
    Friction friction = falling(warm_or_cold);
    friction.parameters["coulomb"] = 30;
    return WithMoreColumns(
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(7200, 1, 600), 0.1, 1));
  }
  /// The motion of Warm, of a joint that does not warm.
  static const Measurements& Cold() {
    static const Measurements recording = WithMoreColumns(
        test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(7200, 1, 600), 0.1, 1));
    return recording;
  }
};

/// Truth of Table I, of its joint with the Stribeck effect and of that with a bristle, by name;
/// each sign of the Coulomb level alike.
std::map<std::string, double> Truths() {
  std::map<std::string, double> truths = test::TruthOf(test::TableOne());
  truths.merge(test::TruthOf(test::LuGreJoint()));
  truths["coulomb_positive"] = truths["coulomb_negative"] = truths["coulomb"];
  const DiscreteThermal discrete = Discretise(*test::TableOne().thermal, 1);
  truths["thermal_gain_discrete"] = discrete.gain;
  truths["thermal_pole"] = discrete.pole;
  return truths;
}

/// No member of an estimate that was not a finite number (which JSON shows as null), but those
/// that may be absent.
void ExpectFinite(const Estimate& estimate) {
  for (const EstimatedParameter& parameter : estimate.parameters) {
    EXPECT_TRUE(std::isfinite(parameter.value)) << parameter.name;
    EXPECT_TRUE(std::isfinite(parameter.std.value_or(0))) << parameter.name;
    if (!parameter.interval95) continue;
    EXPECT_LE((*parameter.interval95)[0], (*parameter.interval95)[1]) << parameter.name;
    EXPECT_TRUE(std::isfinite((*parameter.interval95)[0])) << parameter.name;
    EXPECT_TRUE(std::isfinite((*parameter.interval95)[1])) << parameter.name;
  }
  if (estimate.metrics) {
    for (const auto& [key, value] : EstimateToTree(estimate)["metrics"].items()) {
      EXPECT_TRUE(value.is_number()) << key;
    }
  }
  for (const TraceEntry& entry : estimate.trace) {
    EXPECT_TRUE(std::isfinite(entry.rmse));
    for (const auto& [name, value] : entry.parameters) EXPECT_TRUE(std::isfinite(value)) << name;
  }
}

/// What a failure may hold: a reason, and no friction that someone could use.
void ExpectHonest(const Estimate& estimate) {
  EXPECT_FALSE(estimate.message.empty());
  ExpectFinite(estimate);
  if (estimate.status == Status::ok) return;
  EXPECT_FALSE(estimate.friction) << estimate.message;
  for (const EstimatedParameter& parameter : estimate.parameters) {
    EXPECT_FALSE(parameter.interval95) << parameter.name << ": " << estimate.message;
  }
}

TEST_P(Contract, DocumentsItselfAndItsOptions) {
  const Identifier& identifier = GetParam();
  for (const char letter : identifier.name) {
    EXPECT_TRUE(std::islower(letter) || std::isdigit(letter) || letter == '-') << identifier.name;
  }
  EXPECT_FALSE(identifier.summary.empty());
  for (const OptionInfo& option : identifier.options.List()) {
    EXPECT_FALSE(option.meaning.empty()) << option.name;
    // the default passes the option's own check
    EXPECT_NO_THROW(identifier.options.Read({{option.name, option.value}}, Place{option.name}));
  }
}

TEST_P(Contract, RecoversTheTruthOfRichData) {
  // an identifier without warming is shown a joint that does not warm
  const Estimate rich = IdentifyRich();
  const bool warms = rich.Find("thermal_gain") != nullptr;
  const bool cold = &Rich() == &Warm() && !warms;
  const Estimate estimate = cold ? Identify(Cold()) : rich;
  EXPECT_EQ(estimate.identifier, GetParam().name);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_TRUE(estimate.friction);
  for (const auto& [name, truth] : Truths()) {
    const EstimatedParameter* found = estimate.Find(name);
    if (!found) continue;
    // 2 %: twice what the noise of 0.1 N.m leaves of tau, the least certain one; energy-als stops
    // within 1 % of its fixed point
    EXPECT_NEAR(found->value, truth, 0.02 * std::abs(truth)) << name;
    EXPECT_LT(found->std.value_or(0), 0.01 * std::abs(truth)) << name;
  }
  // an rmse of 0.1 N.m, known to 1 / sqrt(2 n) = 1.2 %
  EXPECT_NEAR(estimate.metrics->rmse, 0.1, 0.1 * 0.06);
}

TEST_P(Contract, GivesNoFrictionOutsideOfPhysicalBounds) {
  // an identifier without warming is shown a joint that does not warm
  const bool warms = IdentifyRich().Find("thermal_gain") != nullptr;
  const Estimate estimate = Identify(Falling(warms ? test::TableOne() : test::Cold()));
  if (GetParam().name == "auto" && !estimate.Find("viscous")) {
    // a law without a slope is left, and its values are within their bounds
    EXPECT_TRUE(estimate.Find("coulomb")) << estimate.FullMessage();
    ASSERT_TRUE(estimate.friction);
    EXPECT_NO_THROW(CheckFriction(*estimate.friction, {"auto"}));
    ExpectHonest(estimate);
    return;
  }
  EXPECT_FALSE(estimate.friction);
  EXPECT_THAT(estimate.FullMessage(),
              ::testing::ContainsRegex("viscous is -[0-9.]+ N.m.s/rad, below its bound 0, "));
  ExpectHonest(estimate);
  EXPECT_EQ(estimate.status, Status::inadequate_model);
}

TEST_P(Contract, AnswersAwkwardDataWithAStatusAndASentence) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(Measurements&)>> spoilers{
      [](Measurements& m) { m.torque.setZero(); },
      [](Measurements& m) { m.torque.setConstant(3); },
      [](Measurements& m) { m.velocity.setZero(); },
      [](Measurements& m) { m.torque = -m.torque; },
      [](Measurements& m) { m.torque *= 1e150; },
      [](Measurements& m) { m.torque *= 1e-200; },
      [](Measurements& m) { m.velocity *= 1e-150; },
      [&](Measurements& m) { m.torque[100] = nan; },
      [&](Measurements& m) { m.velocity[100] = nan; },
      [](Measurements& m) { m.velocity = m.velocity.cwiseAbs(); },
      [](Measurements& m) { m.time *= 1e9; },
      [](Measurements& m) { m.torque = m.velocity; },
  };
  for (size_t i = 0; i < spoilers.size(); ++i) {
    SCOPED_TRACE(i);
    Measurements spoilt = Rich();
    spoilers[i](spoilt);
    ::testing::internal::CaptureStderr();
    EXPECT_NO_THROW(ExpectHonest(Identify(spoilt)));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "the sentence is all that users get";
  }
}

TEST_P(Contract, AnswersVeryShortRecords) {
  for (Eigen::Index n : {2, 3, 5, 8, 30}) {
    SCOPED_TRACE(n);
    const Measurements brief =
        test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(n, 5), 0.5, 5);
    ExpectHonest(Identify(brief));
  }
}

TEST_P(Contract, GivesNoNumbersForOneSpeed) {
  if (GetParam().name == "auto") GTEST_SKIP() << "takes a law without slope";
  Eigen::VectorXd velocity(3600);
  for (Eigen::Index i = 0; i < 3600; ++i) velocity[i] = i / 20 % 2 ? 0.5 : -0.5;
  const Estimate estimate = Identify(test::RecordFriction(test::TableOne(), 1, velocity, 0.5, 1));
  EXPECT_EQ(estimate.status, Status::not_identifiable) << estimate.message;
  EXPECT_TRUE(estimate.parameters.empty());
  EXPECT_FALSE(estimate.metrics);
  EXPECT_FALSE(estimate.friction);
  EXPECT_THAT(estimate.message, HasSubstr("viscous"));
  EXPECT_THAT(estimate.message, HasSubstr("coulomb"));
}

TEST_P(Contract, AnswersASelectionThatKeepsNothing) {
  Selection none = SelectMoving(Rich());
  none.keep = false;
  const Estimate estimate = Identify(Rich(), none);
  EXPECT_EQ(estimate.status, Status::bad_data);
  EXPECT_TRUE(estimate.parameters.empty());
  EXPECT_FALSE(estimate.metrics);
  ExpectHonest(estimate);
}

TEST_P(Contract, GivesTheSameBitsTwice) {
  EXPECT_EQ(EstimateToTree(IdentifyRich()).dump(), EstimateToTree(IdentifyRich()).dump());
}

/// Whether a map goes over one turn of the joint, as a sliding joint's cannot.
bool HasTurnOfTheJoint(const std::optional<Friction>& friction) {
  if (!friction) return false;
  return std::ranges::any_of(friction->maps, [](const FrictionMap& map) {
    const MapAxis* axis = FindAxis(map, MapQuantity::position);
    return axis && axis->kernels.period;
  });
}

TEST_P(Contract, CarriesTheUnitsOfALinearJoint) {
  Measurements linear = Rich();
  linear.joint = JointKind::linear;
  linear.torque_unit = "N";
  const Estimate estimate = Identify(linear);
  const Estimate rotary = IdentifyRich();
  ASSERT_EQ(estimate.parameters.size(), rotary.parameters.size());
  const bool alike = !HasTurnOfTheJoint(rotary.friction);
  // a field over the position has knots that are even in rad, of which an answer depends by far less than its errors
  const double few = GetParam().name == "auto" ? 0.1 : 0;
  for (const EstimatedParameter& parameter : estimate.parameters) {
    const EstimatedParameter& other = *rotary.Find(parameter.name);
    if (alike) {
      EXPECT_NEAR(parameter.value, other.value, few * other.std.value_or(0)) << parameter.name;
    }
    EXPECT_EQ(parameter.unit.find("rad"), std::string::npos) << parameter.name;
    EXPECT_EQ(parameter.unit.find("N.m"), std::string::npos) << parameter.name;
  }
}

TEST_P(Contract, ScalesWithTheTorque) {
  Measurements scaled = Rich();
  scaled.torque *= 2.5;
  ExpectOf(scaled, [](EstimatedParameter& parameter) {
    // gain (N.m/W), times, speeds and exponents keep their values, all others are torques over
    // speeds
    const bool same = parameter.name.starts_with("thermal") || !parameter.unit.starts_with("N.m");
    if (!same) parameter.value *= 2.5;
  });
}

TEST_P(Contract, TreatsBothDirectionsAlike) {
  Measurements reversed = Rich();
  reversed.velocity = -reversed.velocity;
  reversed.position = -reversed.position;
  reversed.torque = -reversed.torque;
  ExpectOf(reversed, [](EstimatedParameter& parameter) {
    std::string& name = parameter.name;
    if (name == "coulomb_positive") {
      name = "coulomb_negative";
    } else if (name == "coulomb_negative") {
      name = "coulomb_positive";
    }
  });
}

TEST_P(Contract, DoesNotMindWhenTheClockStarted) {
  Measurements later = Rich();
  later.time.array() += 86400;
  ExpectOf(later, [](EstimatedParameter&) {});
}

TEST_P(Contract, GetsASlowLogSplitAtItsSwitchesOnlyForSteadyMotion) {
  // forwards for 19.5 s, then backwards, at 1 Hz
  Measurements log = test::RecordFriction(test::TableOne(), 1, Eigen::VectorXd::Ones(40), 0, 1);
  log.velocity.tail(20).setConstant(-1);
  log.position = 19.5 - (log.time.array() - 19.5).abs();
  const Selection selection = SelectMoving(log);
  const PreparedLog prepared = Prepare(log, selection);
  const IdentifierInput seen = SelectSamples(GetParam(), {prepared, GetParam().options, {}});
  const bool steady = GetParam().view == View::constant_speed;
  EXPECT_EQ(seen.measurements.size(), steady ? 41 : 40);
  EXPECT_GT(prepared.unresolved_path(), 0);
}

TEST_P(Contract, LearnsFromChangesOfSpeedOnlyThroughTheRawView) {
  // the first has rests, the second turns that are no constant speed
  const bool steady = GetParam().view == View::constant_speed;
  const Measurements& log = steady ? Warm() : Turning();
  const Selection selection = SelectConstantSpeed(log);
  ASSERT_LT(selection.count(), log.size());
  Measurements other = log;
  other.torque = selection.keep.select(other.torque, 0);
  const auto answer = [&](const Measurements& m) {
    return EstimateToTree(Identify(m, selection)).dump();
  };
  EXPECT_EQ(answer(other) == answer(log), steady);
}

INSTANTIATE_TEST_SUITE_P(Identifiers, Contract, ::testing::ValuesIn(Identifiers()), test::NameOf);

TEST(Identifiers, HaveDistinctNames) {
  std::set<std::string> names;
  size_t count = 0;
  for (const Identifier& identifier : Identifiers()) {
    // what it was called is no name of another
    for (const std::string& name : {identifier.name, identifier.earlier_name}) {
      if (name.empty()) continue;
      names.insert(name);
      ++count;
    }
  }
  EXPECT_EQ(names.size(), count);
}

TEST(Identifiers, AreFoundByNameOrRefusedWithTheNearest) {
  EXPECT_EQ(FindIdentifier("energy-als").name, "energy-als");
  EXPECT_EQ(FindIdentifier("energy-em").name, "energy-als") << "its earlier name";
  EXPECT_EQ(CurrentName("energy-em"), "energy-als");
  EXPECT_EQ(CurrentName("mine"), "mine");
  EXPECT_THROW(FindIdentifier(""), BadInput);
  EXPECT_THAT(test::RefusalOf([] { FindIdentifier("energy-asl"); }),
              HasSubstr("did you mean 'energy-als'?"));
}

}  // namespace
}  // namespace warmjoint
