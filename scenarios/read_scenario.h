// Scenarios as YAML. The layout, with its units and defaults:
//
//   name: table1                 file name where not given
//   plant: ideal                 ideal | mujoco
//   robot: rotary                name of a robot or path of an MJCF or URDF file (mujoco)
//   joint: hinge                 name of the robot's joint (mujoco)
//   joint_kind: rotary           rotary (rad, N.m) | linear (m, N); the robot's where there is one
//   friction:                    as in a friction file, or the path of one
//     law: viscous_coulomb       the law and each of its parameters (`list laws`)
//     parameters: {viscous: 5, coulomb: {uniform: [12, 18]}}
//     thermal: {thermal_gain: -3, thermal_time_constant: 600}
//     gear: 1
//   initial_energy: 0            E(0), N.m or N; a number or a distribution
//   motion:
//     speeds: {uniform: [0.1, 1]}     a list or a distribution, rad/s or m/s
//     hold: 20                        s a segment; or travel: [lower, upper] or joint_limits
//     order: alternating              alternating | shuffled | in_order
//     rests: {run: 600, rest: 600}    s; none where not given
//     phases:                         or, instead of all these, motions in turn, again from the
//       - {duration: 3000, speeds: [0.1, 1], hold: 20}             first until the duration is over
//       - {rest: 600}
//     corners: [[0, 0], [1, 0.5]]     or a velocity that is linear between corners, s and rad/s,
//     start: 0                        from this position on
//     fourier: {period: 10, harmonics: 5, speed: 1}    or a sum of harmonics drawn anew, s; 1; rad/s,
//                                     from `start` on
//     moves: {between: [-1, 1], speed: 1, acceleration: 5, pause: 0.2}     or from place to place,
//                                     drawn anew, rad or m; rad/s; rad/s^2; s
//   controller: {bandwidth: 0, acceleration: 0}            rad/s, rad/s^2 or m/s^2; 0: chosen (README.md)
//   noise: {torque: 0.5, velocity: 0, position: 0}         standard deviations
//   disturbances:                none where not given (disturbances.h)
//     outliers: {fraction: 0.01, size: 5}                  of the samples; N.m or N
//     coloured_noise: {deviation: 0.5, correlation_time: 10}         N.m or N; s
//     periodic_torque: {amplitude: 0.5, period: 30}                  N.m or N; s
//     gravity: {sine: 5, cosine: 0}                        N.m or N; ideal plant, as all below
//     ambient_drift: {amplitude: 1, period: 7200}          N.m or N; s
//     ambient_temperature: {amplitude: 10, period: 7200}   K; s; both plants
//     load_change: {load: 10, gain: 0.1, period: 600}      N.m or N; 1; s
//     second_heat: {thermal_gain: -1, thermal_time_constant: 60}     N.m/W or N/W; s
//   sampling: {rate: 1, sensor_rate: 250, cutoff: 0}       Hz; filter and sensors only in mujoco
//   timestep: 0.001              s, of the engine (mujoco)
//   duration: 3600               s
//   seed: 1
#pragma once

#include <string>

#include "models/foundation/node.h"
#include "scenarios/scenario.h"

namespace warmjoint {

/// Reads a scenario file and applies the settings to it. Unknown keys, wrong types and impossible
/// values throw BadInput with file:line, the value, the bound and the nearest known key.
Scenario ReadScenario(const std::string& path, const Settings& settings = {});

/// The same of a text; file: what refusals name, and where relative paths start.
Scenario ParseScenario(const std::string& text, const std::string& file,
                       const Settings& settings = {});

/// The same for a value that is part of a larger file. name: of the scenario where it gives none.
Scenario ScenarioFrom(const Node& node, const std::string& name);

/// The scenario with settings applied to it, checked like a file.
Scenario WithSettings(const Scenario& scenario, const Settings& settings);

/// The whole scenario, defaults written out; reading it gives the same scenario bit for bit.
std::string ScenarioToYaml(const Scenario& scenario);
Tree ScenarioToTree(const Scenario& scenario);

/// A motion and a duration, s, as settings of a scenario.
Settings MotionSettings(const Motion& motion, double duration);

}  // namespace warmjoint
