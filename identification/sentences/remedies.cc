#include "identification/sentences/remedies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace warmjoint {
namespace {

/// How it acts, before what else is said; nothing of what acts otherwise.
std::string_view Begin(RippleActs acts) {
  return acts == RippleActs::alike ? "it acts alike in both directions, as " : "";
}

}  // namespace

std::string RemedyForShortLog(double duration, double shortest) {
  return fmt::format(
      "within {:.3g} s a warming cannot be distinguished from what else changes (load, sensor, "
      "grease): record {:.0f} s or longer, from cold",
      duration, shortest);
}

std::string AskForWarmStart(std::string_view remedy) {
  return fmt::format("was the joint warm at the start? {}", remedy);
}

std::string RemedyForBothLevels() {
  return fmt::format(
      "{}; identify the samples of each direction as a recording of its own, by --identifier "
      "stribeck",
      kLawHasBothLevels);
}

std::string RemedyForOtherJoints(std::string_view joints) {
  return fmt::format(
      "something acts on the joint in a rhythm of its own, perhaps other joints of the robot ({}): "
      "record this joint while they rest, or log their force on it as load",
      joints);
}

std::string RemedyByLongHolds(double hold, double trim) {
  return fmt::format(
      "hold each speed for {:.2g} s or longer, and leave out what has not settled: --trim {:.2g}",
      hold, trim);
}

std::string RemedyByTrim(double trim) {
  return fmt::format("cut the ends of each speed (--trim {:g})", trim);
}

std::string AskForLateTorque(std::string_view remedy) {
  return fmt::format("is the torque filtered or late? {}", remedy);
}

std::string AskForLateTorqueOr(std::string_view remedy) {
  return fmt::format("is the torque filtered or late? {}, or ", remedy);
}

std::string ExplainByLoad(RippleActs acts) {
  return fmt::format("{}a load does that depends on position: ", Begin(acts));
}

std::string ExplainByMotor(RippleActs acts, const std::vector<int>& gears) {
  const std::string_view data_sheet =
      gears.size() > 1 ? "its data sheet says which" : "or as its data sheet says";
  return fmt::format("{}it may be the motor's, with a gear of {} ({}): ", Begin(acts),
                     fmt::join(gears, " or "), data_sheet);
}

std::string RemedyForFineRipple(RippleActs acts, const FineRipple& ripple, JointKind joint) {
  return fmt::format(
      "{}it returns {:.0f} times over the travel, and a map follows {} periods at most: record it "
      "within {:.2g} {}",
      Begin(acts), ripple.periods, ripple.most, ripple.longest, kPositionUnit.For(joint));
}

}  // namespace warmjoint
