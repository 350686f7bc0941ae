// The golden numbers of tests/golden.
#pragma once

#include <Eigen/Core>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "models/friction/along_motion.h"
#include "models/friction/friction_json.h"
#include "tests/support/folders.h"

namespace warmjoint::test {

/// The content of tests/golden/NAME.json.
inline nlohmann::json ReadGolden(const std::string& name) {
  const auto path = SourceFolder() / "tests/golden" / (name + ".json");
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  return nlohmann::json::parse(stream);
}

/// The numbers of the paper's equations.
inline const nlohmann::json& Golden() {
  static const nlohmann::json golden = ReadGolden("paper");
  return golden;
}

/// [N] from a list of numbers.
inline Eigen::VectorXd ToVector(const nlohmann::json& list) {
  Eigen::VectorXd vector(list.size());
  for (size_t i = 0; i < list.size(); ++i) vector[i] = list[i].get<double>();
  return vector;
}

/// A recording of generate.py, without noise.
struct GoldenMotion {
  Friction friction;
  JointTrajectory trajectory;  // evenly sampled
  Eigen::VectorXd force;       // [N] N.m
  Eigen::VectorXd energy;      // [N] E of all stages, N.m
  Eigen::VectorXd bristle;     // [N] N.m; empty where the law has none
  double initial_energy = 0;
};

/// name: of a law, or "everything".
inline GoldenMotion ReadGoldenMotion(const std::string& name) {
  const nlohmann::json golden = ReadGolden(name);
  const auto column = [&](const char* key) {
    return golden.contains(key) ? ToVector(golden.at(key)) : Eigen::VectorXd();
  };
  GoldenMotion motion;
  motion.friction = FrictionFrom({Tree(golden.at("friction")), name});
  JointTrajectory& trajectory = motion.trajectory;
  trajectory.velocity = column("velocity");
  trajectory.step = golden.at("step");
  const Eigen::Index n = trajectory.velocity.size();
  trajectory.time = Eigen::VectorXd::LinSpaced(n, 0, trajectory.step * static_cast<double>(n - 1));
  trajectory.position = column("position");
  trajectory.load = column("load");
  trajectory.ambient_rise = column("ambient_rise");
  motion.force = column("force");
  motion.energy = column("energy");
  motion.bristle = column("bristle");
  motion.initial_energy = golden.value("initial_energy", 0.0);
  return motion;
}

}  // namespace warmjoint::test
