// A scenario carried out: a recording, and the truth behind it.
//
//   const Simulation simulation = Simulate("scenario.yaml", {.set = {{"noise.torque", "0.1"}}, .seed = 7});
//   WriteRecording(simulation.measurements, "log.csv");
//   WriteTruth(simulation.truth, "truth.json");
#pragma once

#include <warmjoint/recording.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace warmjoint {

/// The truth behind Measurements of the same N samples.
struct Truth {
  Friction friction;
  double initial_energy = 0;  // E(0), N.m or N
  double torque_noise = 0;    // standard deviation of the noise on the stored torque, N.m or N
  double coloured_noise =
      0;  // of the part of it that remembers, exp(-t/correlation_time); N.m or N
  double correlation_time = 0;  // s; 0 where all of it is white
  std::string plant;            // plant that made the recording

  Eigen::VectorXd velocity;  // [N] rad/s or m/s, without noise
  Eigen::VectorXd force;     // [N] friction F, N.m or N
  Eigen::VectorXd loss;      // [N] W = |F v|, W
  Eigen::VectorXd energy;    // [N] E, N.m or N

  template <class A>
  void Serialize(A* a) {
    // friction, start, plant and noise; its colour where it has any
    constexpr std::string_view needed = "is it a truth file?";
    a->Field("friction", &friction, {.needed = needed});
    a->Field("initial_energy", &initial_energy, {.unit = "N.m", .needed = needed});
    a->Field("plant", &plant, {.needed = needed});
    a->Field("torque_noise", &torque_noise, {.unit = "N.m", .needed = needed});
    constexpr auto left_out = AtDefault::left_out;
    a->Field("coloured_noise", &coloured_noise, {.unit = "N.m", .at_default = left_out});
    a->Field("correlation_time", &correlation_time, {.unit = "s", .at_default = left_out});

    // columns of one length
    a->Field("velocity", &velocity, {.unit = "rad/s", .needed = needed});
    a->Field("force", &force, {.unit = "N.m", .needed = needed});
    a->Field("loss", &loss, {.unit = "W", .needed = needed});
    a->Field("energy", &energy, {.unit = "N.m", .needed = needed});
    constexpr std::string_view like = "as long as velocity: all arrays must be of one length";
    a->Check(force.size() == velocity.size(), "force", like);
    a->Check(loss.size() == velocity.size(), "loss", like);
    a->Check(energy.size() == velocity.size(), "energy", like);
  }
};

/// How well a driven joint followed its motion.
struct Following {
  /// Of the time in which the motion asks for a constant speed other than 0, the share in which the
  /// joint moved within 5 % of it; 1 where it asks for none.
  double share = 1;
  double bandwidth = 0;   // of the drive, rad/s; 0: the plant has none, and follows exactly
  double sufficient = 0;  // bandwidth that does, rad/s
  double timestep = 0;    // s, whole part of the scenario's that allows it; 0: the scenario's does

  /// Whether the recording holds the motion that was asked for.
  bool Follows() const { return share >= 0.8; }

  /// Two sentences on a joint that did not follow its motion: in what share of the time it reached its commanded speed, and
  /// the settings that cure it.
  std::string Words() const;
};

/// A recording and its truth.
struct Simulation {
  Measurements measurements;
  Truth truth;
  Following following{};
  /// [N] What weight and inertia are of the logged torque, N.m or N: what a robot's description takes off. Empty where the plant
  /// has neither.
  Eigen::VectorXd rigid{};
};

/// What changes of a scenario, and what is told of its progress.
struct SimulateSettings {
  std::vector<std::pair<std::string, std::string>>
      set{};                            // key and value, as --set noise.torque=0.1
  std::optional<std::uint64_t> seed{};  // instead of the scenario's
  std::uint64_t realization = 0;        // which of the seed's
  /// Is told which share is done, 0 to 1; what it throws ends it.
  std::function<void(double share)> watch{};
};

/// Carries out a scenario file (YAML). The same seed and realization give the same recording; on CPUs that differ, bit for
/// bit only where glibc's forms with fused multiply-adds are masked. Throws BadInput.
Simulation Simulate(const std::filesystem::path& scenario, const SimulateSettings& settings = {});

/// Reads and writes truth.json as a whole. Throw BadInput and OutputFailed.
Truth ReadTruth(const std::filesystem::path& file);
void WriteTruth(const Truth& truth, const std::filesystem::path& file);

}  // namespace warmjoint
