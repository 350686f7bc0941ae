#include <warmjoint/friction.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/friction/along_motion.h"
#include "models/friction/check_friction.h"
#include "models/friction/friction_json.h"
#include "models/friction/joint_friction.h"
#include "models/friction/settled_energy.h"
#include "models/recording/course_of.h"
#include "tools/interface/convert_friction.h"
#include "tools/interface/convert_numbers.h"
#include "tools/interface/convert_recording.h"
#include "tools/interface/guarded.h"

namespace warmjoint::api {
namespace {

ParameterInfo FromInfo(const models::ParameterInfo& info) {
  return {std::string(info.name),
          std::string(info.symbol),
          std::string(info.unit.rotary),
          std::string(info.unit.linear),
          info.lower,
          info.upper,
          info.default_value,
          std::string(info.meaning)};
}

/// A column of n samples, or none.
Eigen::VectorXd Column(const std::vector<double>& values, const char* name, std::size_t n) {
  // a column is there as a whole or not at all
  if (!values.empty() && values.size() != n) {
    models::Refuse({"motion"}, "{} has {} values and time has {}; give one for each sample or none",
                   name, values.size(), n);
  }

  // and holds numbers
  for (const double value : values) {
    if (!std::isfinite(value)) models::Refuse({"motion"}, "{} holds {}, no number", name, value);
  }
  return ToEigen(values);
}

models::JointCourse ToCourse(const Motion& motion) {
  const std::size_t n = motion.time.size();
  // time and velocity are the least that a motion needs
  if (n == 0 || motion.velocity.empty()) {
    models::Refuse({"motion"}, "has {} times and {} velocities; give one of both for each sample",
                   n, motion.velocity.size());
  }

  // time increases from sample to sample
  for (std::size_t i = 1; i < n; ++i) {
    if (motion.time[i] > motion.time[i - 1]) continue;
    models::Refuse({"motion"}, "time of sample {} is {} s, after {} s; it must increase", i + 1,
                   motion.time[i], motion.time[i - 1]);
  }
  models::JointCourse course{
      Column(motion.time, "time", n),         Column(motion.velocity, "velocity", n),
      Column(motion.position, "position", n), Column(motion.motor_position, "motor_position", n),
      Column(motion.load, "load", n),         Column(motion.ambient_rise, "ambient_rise", n)};

  // recordings that were joined begin cold, in order
  std::size_t last = 0;
  for (const std::size_t start : motion.starts) {
    if (start <= last || start >= n) {
      models::Refuse({"motion"}, "starts has {} after {}; they must ascend between 0 and {}", start,
                     last, n);
    }
    last = start;
    course.starts.push_back(static_cast<Eigen::Index>(start));
  }
  return course;
}

models::JointPlace ToPlace(const JointPlace& place) {
  return {place.position, place.energy, place.load, place.motor_position};
}

FrictionState FromState(const models::FrictionState& state) {
  return {state.bristle, state.energy, state.second_energy, state.slip};
}

}  // namespace

std::vector<LawInfo> Laws() {
  std::vector<LawInfo> laws;
  // each law with the table of its parameters
  for (const models::Law& law : models::Laws()) {
    LawInfo info{std::string(law.name), std::string(law.equation), {}};
    for (const models::ParameterInfo& row : law.parameters) {
      info.parameters.push_back(FromInfo(row));
    }
    laws.push_back(std::move(info));
  }
  return laws;
}

void CheckFriction(const Friction& friction) {
  Guarded([&] { ToDescription(friction); });
}

Friction ReadFriction(const std::filesystem::path& file) {
  return Guarded([&] { return FromDescription(models::ReadFrictionFile(file)); });
}

Friction FrictionFromJson(const std::string& text, const std::string& name) {
  return Guarded(
      [&] { return FromDescription(models::FrictionFrom(models::ParseJsonNode(text, name))); });
}

std::string FrictionToJson(const Friction& friction) {
  return Guarded([&] { return models::FrictionToTree(ToDescription(friction)).dump(2) + "\n"; });
}

std::optional<std::vector<double>> SettledEnergy(const Friction& friction, double velocity) {
  return Guarded([&] {
    if (!std::isfinite(velocity)) models::Refuse({"velocity"}, "is {}, no number", velocity);
    return models::SettledEnergy(ToDescription(friction), velocity);
  });
}

Motion MotionOf(const Recording& recording) {
  return Guarded([&] {
    // a motion is its velocity, which the friction does not find by itself
    if (recording.velocity.empty()) {
      models::Refuse({recording.source}, "has no velocity, without which there is no motion");
    }
    const models::JointCourse course = models::CourseOf(ToMeasurements(recording));
    Motion motion{FromEigen(course.time),
                  FromEigen(course.velocity),
                  FromEigen(course.position),
                  FromEigen(course.motor_position),
                  FromEigen(course.load),
                  FromEigen(course.ambient_rise),
                  {course.starts.begin(), course.starts.end()}};
    return motion;
  });
}

struct FrictionModel::State {
  models::JointFriction joint;
  models::AlongMotion along;
};

FrictionModel::FrictionModel(const Friction& friction, double timestep)
    : state_(Guarded([&] {
        // checked once, so that steps need no checks
        if (!(std::isfinite(timestep) && timestep > 0)) {
          models::Refuse({"timestep"}, "is {}; it must be a finite number above 0, s", timestep);
        }
        const models::FrictionDescription made = ToDescription(friction);
        auto state =
            std::make_shared<State>(State{models::JointFriction(made), models::AlongMotion(made)});
        state->joint.SetTimestep(timestep);
        return std::shared_ptr<const State>(std::move(state));
      })) {}

double FrictionModel::Force(double velocity, const JointPlace& place) const {
  return velocity == 0 ? 0 : state_->joint.SlidingForce(velocity, ToPlace(place));
}

double FrictionModel::HoldingLevel() const { return state_->joint.HoldingLevel(); }

FrictionStep FrictionModel::Step(const FrictionState& state, const JointMotion& motion) const {
  const models::FrictionStep step = state_->joint.Step(
      {state.bristle, state.energy, state.second_energy, state.slip},
      {motion.position, motion.velocity, motion.inertia, motion.load, motion.ambient_rise});
  return {step.force, step.loss, FromState(step.next)};
}

FrictionCourse FrictionModel::Along(const Motion& motion, double energy,
                                    double second_energy) const {
  return Guarded([&] {
    const models::Prediction made =
        state_->along.Predict(ToCourse(motion), {energy, second_energy, {}});
    return FrictionCourse{FromEigen(made.force), FromEigen(made.energy), FromEigen(made.loss),
                          FromState(made.end)};
  });
}

}  // namespace warmjoint::api
