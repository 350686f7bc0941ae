// A scenario carried out: a recording, and the truth behind it. What `warmjoint simulate` does.
//
//   const Simulation simulation = Simulate("scenario.yaml", {.set = {{"noise.torque", "0.1"}}, .seed = 7});
//   const Estimate estimate = Identify(simulation.recording);
#pragma once

#include <warmjoint/friction.h>

#include <cstdint>
#include <functional>
#include <utility>

namespace warmjoint::api {

/// What a simulation knows and a robot does not, of the recording's N samples.
struct Truth {
  Friction friction{};
  double initial_energy = 0;  // E(0), N.m or N
  double torque_noise = 0;    // standard deviation of the noise on the torque, N.m or N
  /// Standard deviation of the part of it that remembers, N.m or N, and how long, s; 0: all is white.
  double coloured_noise = 0;
  double correlation_time = 0;
  std::string plant{};  // that made the recording
  std::vector<double> velocity{}, force{}, loss{},
      energy{};  // [N] rad/s or m/s, N.m or N, W, N.m or N
};

/// A recording and its truth.
struct Simulation {
  Recording recording{};
  Truth truth{};
  std::string scenario{};  // YAML, all defaults written out: the same again
  std::string
      not_following{};  // of a joint that did not follow its motion: how much, and what cures it; else empty
};

/// What changes of a scenario.
struct SimulateSettings {
  std::vector<std::pair<std::string, std::string>>
      set{};                            // key and value, as --set noise.torque=0.1
  std::optional<std::uint64_t> seed{};  // instead of the scenario's
  std::uint64_t realization = 0;        // which of the seed's
  std::function<void(double share)>
      watch{};  // is told which share is done, 0 to 1; what it throws ends it
};

/// Carries out a scenario file (YAML). The same seed and realization give the same recording; on CPUs that differ, bit for
/// bit only where glibc's forms with fused multiply-adds are masked, as the command line does. Throws BadInput.
Simulation Simulate(const std::filesystem::path& scenario, const SimulateSettings& settings = {});

/// The same from a text. name: of the scenario in messages.
Simulation SimulateText(const std::string& scenario, const SimulateSettings& settings = {},
                        const std::string& name = "scenario");

/// Writes recording.csv (format csv) or recording.h5 (h5), truth.json and scenario.yaml into a directory, as a whole.
/// Throws BadInput, also where it holds other files, and OutputFailed.
void WriteSimulation(const Simulation& simulation, const std::filesystem::path& directory,
                     const std::string& format = "csv");

/// Reads truth.json. Throws BadInput.
Truth ReadTruth(const std::filesystem::path& file);

}  // namespace warmjoint::api
