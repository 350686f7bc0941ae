// A motion to record, chosen for what its log will tell: what `warmjoint design` does.
//
//   DesignSettings settings;
//   settings.minutes = 12;
//   settings.aim = AimFrom("thermal_time_constant=5%");
//   const Design design = DesignMotion(settings);
//   for (const auto& [name, text] : FilesOf(design)) std::printf("%s: %zu bytes\n", name.c_str(), text.size());
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/field.h>
#include <warmjoint/friction.h>
#include <warmjoint/identify.h>
#include <warmjoint/prepared_log.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace warmjoint {

/// What is wanted of an answer: everything alike (the determinant of the parameters' covariance, relative to their values), the
/// friction along ordinary motion, cold and warm, or one parameter.
enum class AimKind { everything, friction, parameter };

/// An aim, and how good is good enough.
struct DesignAim {
  AimKind kind = AimKind::everything;
  std::string parameter{};        // of AimKind::parameter
  std::optional<double> share{};  // that the half width of 95 % intervals may be of their values
};

/// "D", "friction", "friction=5%", "NAME", "NAME=5%". Throws BadInput. option: its name in messages
DesignAim AimFrom(const std::string& text, const std::string& option = "--for");
/// The same with a share that must be given.
DesignAim GoalFrom(const std::string& text, const std::string& option = "--until");
/// The inverse.
std::string TextOf(const DesignAim& aim);

/// The half width of the 95 % interval that an aim is about, as a share: of a parameter's value; of friction the largest of all
/// speeds, over the rms friction at them. Nothing where an answer has none, or where the aim is everything. The numbers of an answer that is not ok are none.
std::optional<double> HalfWidthShare(const Estimate& estimate, const DesignAim& aim);

/// Whether a log holds the interval that an aim asks for.
struct Sufficiency {
  bool reached = false;
  double minutes = 0;                    // of the log
  std::optional<double> half_width{};    // HalfWidthShare; none where the answer is not ok
  std::optional<double> minutes_more{};  // of the same motion; none where that is not foretold
  Status status = Status::ok;            // of the answer
  std::string message{};

  template <class A>
  void Serialize(A* a) {
    a->Field("reached", &reached);
    a->Field("minutes", &minutes, {.unit = "min", .meaning = "of the log"});
    a->Field("half_width", &half_width,
             OrNull("of the 95 % interval, as a share; null: there is none"));
    a->Field("minutes_more", &minutes_more,
             {.unit = "min",
              .meaning = "of the same motion, until it is reached; null: not foretold",
              .at_default = AtDefault::null});
    a->Field("status", &status, {.meaning = "of the answer"});
    a->Field("message", &message);
  }
};

/// Identifies the log so far. The minutes that are missing follow from the derivatives of law and heat along the log's motion, were it
/// repeated. aim: with a share. Throws BadInput as Identify does.
Sufficiency LookWhether(const PreparedLog& log, const DesignAim& aim,
                        const IdentifySettings& settings = {});

/// The first part of a log, from its start, that holds the interval; the whole where none does. watch: gets each part that was
/// looked at, and may throw.
Sufficiency LookUntil(const PreparedLog& log, const DesignAim& aim,
                      const IdentifySettings& settings = {},
                      const std::function<void(const Sufficiency&)>& watch = {});

/// What a motion may do. Every stroke begins and ends at rest within `position`.
struct MotionLimits {
  std::optional<std::array<double, 2>> position{};  // lower, upper; none: the joint turns freely
  std::array<double, 2> velocity{0.05, 1};          // slowest, fastest
  double acceleration = 5;
  std::optional<double> torque{};

  template <class A>
  void Serialize(A* a) {
    a->Field("position", &position,
             {.unit = "rad",
              .meaning = "[lower, upper]; null: the joint turns freely",
              .at_default = AtDefault::null});
    a->Field("velocity", &velocity, {.unit = "rad/s", .meaning = "[slowest, fastest] speed"});
    a->Field("acceleration", &acceleration,
             WithDefault("rad/s^2", "between rest and speed", kPositive));
    a->Field("torque", &torque,
             {.unit = "N.m",
              .bounds = kPositive,
              .meaning = "of friction; null: no limit",
              .at_default = AtDefault::null});
    a->Check(velocity[0] > 0 && velocity[0] < velocity[1], "velocity",
             "[slowest, fastest], both above 0");
    a->Check(!position || (*position)[0] < (*position)[1], "position", "[lower, upper]");
  }
};

/// What is asked of a design, each under the name that it has on the command line.
struct DesignSettings {
  double minutes = 20;
  MotionLimits limits{};
  DesignAim aim{};  // --for
  /// A friction file, any number a distribution; an estimate.json, with what it leaves open; empty: broad ranges.
  std::string prior{};
  std::string identifier = "auto";
  StartBelief start = StartBelief::cold;
  std::optional<double> noise{};  // of a torque sample; none: a fiftieth of the level
  double rate = 20;
  double hold = 10;
  JointKind joint = JointKind::rotary;
  std::uint64_t seed = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("minutes", &minutes,
             WithDefault("min", "length of the recording", {.at_least = 1, .at_most = 600}));
    a->Field("limits", &limits, {.meaning = "what the motion may do"});
    a->Field("for", &aim,
             {.meaning = "D: all parameters alike; friction; or a parameter; with =5% the half "
                         "width of the 95 % interval that is enough"});
    a->Field("prior", &prior,
             {.meaning = "file of the friction that is expected: an estimate, or a friction whose "
                         "numbers may be ranges"});
    a->Field("identifier", &identifier, {.meaning = "that will read the log"});
    a->Field("start", &start, {.meaning = "what will be known of the heat at the start"});
    a->Field("noise", &noise,
             {.unit = "N.m",
              .bounds = kPositive,
              .meaning = "standard deviation of a torque sample; null: 2 % of the friction's level",
              .at_default = AtDefault::null});
    a->Field("rate", &rate,
             WithDefault("Hz", "samples in a second", {.at_least = 1, .at_most = 10000}));
    a->Field("hold", &hold,
             WithDefault("s", "longest stroke at one speed", {.at_least = 1, .at_most = 600}));
    a->Field("joint", &joint, {.meaning = "rotary (rad, N.m) or linear (m, N)"});
    a->Field("seed", &seed, {.meaning = "of all random numbers"});
  }
};

/// A knot of the motion, between which the velocity is linear.
struct MotionKnot {
  double time = 0;      // s
  double position = 0;  // rad or m
  double velocity = 0;  // rad/s or m/s
};

/// What a log of the first minutes of the motion will give, were the friction the middle of the prior.
struct ForetoldAnswer {
  double minutes = 0;
  Status status = Status::ok;
  std::string message{};
  std::vector<EstimatedParameter> parameters{};
  std::vector<FrictionAtSpeed> friction_at_speeds{};

  template <class A>
  void Serialize(A* a) {
    a->Field("minutes", &minutes, {.unit = "min"});
    a->Field("status", &status, {.meaning = "of the identifier's answer on a simulated log"});
    a->Field("message", &message);
    a->Named("parameters", &parameters);
    a->Field("friction_at_speeds", &friction_at_speeds);
  }
};

/// As HalfWidthShare of an estimate.
std::optional<double> HalfWidthShare(const ForetoldAnswer& answer, const DesignAim& aim);

/// The standard deviation of what is aimed at, over that of another motion of the same length.
struct DesignRatio {
  std::string against{};  // "random speeds" or "ladder"
  double middle = 1;      // were the friction the middle of the prior
  double worst = 1;       // of the prior's draws the least favourable

  template <class A>
  void Serialize(A* a) {
    a->Field("against", &against, {.meaning = "a motion of the same length within the limits"});
    a->Field("middle", &middle, {.meaning = "for the middle of the prior"});
    a->Field("worst", &worst, {.meaning = "for the least favourable of the prior's draws"});
  }
};

/// A friction that the prior holds possible, with the relative standard deviations that the motion gives.
struct DesignDraw {
  Friction friction{};
  std::vector<std::pair<std::string, double>> deviations{};

  template <class A>
  void Serialize(A* a) {
    a->Field("friction", &friction);
    a->Field("deviations", &deviations,
             {.meaning = "standard deviation of each parameter as a share of its value"});
  }
};

/// A motion, and what its log will tell.
struct Design {
  DesignSettings settings{};
  std::vector<MotionKnot> knots{};
  std::vector<ForetoldAnswer> foretold{};  // ascending minutes, the whole motion last
  std::optional<double> enough{};          // minutes, after which the aim's share is reached
  std::vector<DesignRatio> ratios{};
  std::vector<DesignDraw> draws{};  // that were averaged over, the middle of the prior first

  /// The members of design.json; the motion stands in motion.csv.
  template <class A>
  void Serialize(A* a) {
    a->Field("settings", &settings);
    a->Field("foretold", &foretold,
             {.meaning = "answers of the identifier on a simulated log of the first minutes"});
    a->Field("enough", &enough,
             {.unit = "min",
              .meaning = "after which the interval that `for` asks is there",
              .at_default = AtDefault::null});
    a->Field("ratios", &ratios,
             {.meaning = "standard deviation of what is aimed at over that of other motions"});
    a->Field("draws", &draws, {.meaning = "of the prior, that the design averages over"});
  }
};

/// Searches the sequence of speeds, holds and rests whose log tells the most, on the average over draws of the prior, and carries it
/// out for its middle. The same settings give the same motion. after: an earlier log of the joint, which the identifier gets as well:
/// what it tells counts, and where no prior is given its answer is one. watch: is told what is being done. Throws BadInput.
Design DesignMotion(const DesignSettings& settings, const std::optional<PreparedLog>& after = {},
                    const std::function<void(const std::string& words)>& watch = {});

/// A motion of several joints of a robot at once.
struct RobotDesignSettings {
  std::string robot{};                 // MJCF or URDF file
  std::vector<std::string> joints{};   // names, or patterns of names
  std::map<std::string, double> at{};  // rad or m, where joints begin, and where others stand
  double clearance = 0.01;             // m, between links, and to what stands around
  DesignSettings each{};               // of every joint; its limits count beside the robot's
  std::map<std::string, std::string> priors{};  // files by joint, in place of each.prior
};

/// What a joint's motion does to another one's torque while both move.
struct DesignCoupling {
  std::string joint{};
  std::string by{};
  double torque = 0;  // N.m or N

  template <class A>
  void Serialize(A* a) {
    a->Field("joint", &joint, {.meaning = "whose torque it is"});
    a->Field("by", &by, {.meaning = "the joint that moves"});
    a->Field("torque", &torque,
             {.unit = "N.m", .meaning = "the most that the other's ramps and places change of it"});
  }
};

/// A joint's part of a robot's motion.
struct JointDesign : Design {
  std::string name{};
};

/// Motions of joints that move together.
struct RobotDesign {
  std::vector<JointDesign> joints{};       // in the order of the robot
  std::vector<DesignCoupling> coupling{};  // beyond the noise of a torque sample
  std::vector<std::string> notices{};

  template <class A>
  void Serialize(A* a) {
    a->Named("joints", &joints);
    a->Field("coupling", &coupling,
             {.meaning = "of joints whose torque shows that the other moves"});
    a->Field("notices", &notices);
  }
};

/// One motion for all joints: each joint's own as DesignMotion has it, laid out within the limits of position, velocity and effort that the
/// robot's file has, such that links stay apart and torques, of rigid bodies and friction, below the efforts. A block that would break
/// that is exchanged for one in the other direction, with shorter strokes, or a rest. What is foretold of each joint is so as if its
/// rigid torque were known. after: for one joint. Throws BadInput.
RobotDesign DesignRobotMotion(const RobotDesignSettings& settings,
                              const std::optional<PreparedLog>& after = {},
                              const std::function<void(const std::string& words)>& watch = {});

/// Sets noise and rate to those of a log of the same sensors: the rms residual of the identifier's answer. Throws BadInput where it has
/// none.
void TakeNoiseOf(const PreparedLog& log, DesignSettings& settings);

/// The files of a design, by name with their text: design.json; motion.csv, a row of time, position and velocity for each knot;
/// setpoints.csv, the same every 1/rate seconds; trajectory.yaml, a JointTrajectory; motion.script, for Universal Robots. joint: its name
std::vector<std::pair<std::string, std::string>> FilesOf(const Design& design,
                                                         const std::string& joint = "joint");
/// The same of several joints, each with two columns JOINT_position and JOINT_velocity, without a script.
std::vector<std::pair<std::string, std::string>> FilesOf(const RobotDesign& design);

}  // namespace warmjoint
