// The answers of a suite's identifiers, each to its last digit, on the path that users take.
//
//   answers_study SUITE.yaml [REALIZATIONS [VARIANT...]]
//
// A line for each identifier of each log, "variant realization identifier status", and behind it for each
// number "name value lower upper", with nan where there is no interval: segments of constant speed, samples in
// them, parameters, friction at speeds, bands of maps. What changes an answer changes a line.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <warmjoint/prepared_log.h>

#include <array>
#include <cmath>
#include <optional>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "scenarios/suite.h"
#include "sim/plant/plant.h"
#include "tests/studies/for_each_variant.h"

namespace warmjoint {
namespace {

using Interval = std::optional<std::array<double, 2>>;

void PrintNumber(const std::string& name, double value, const Interval& interval) {
  const auto [lower, upper] = interval.value_or(std::array{std::nan(""), std::nan("")});
  fmt::print(" {} {:.17g} {:.17g} {:.17g}", name, value, lower, upper);
}

void Print(const Estimate& estimate) {
  for (const EstimatedParameter& one : estimate.parameters) {
    PrintNumber(one.name, one.value, one.interval95);
  }
  for (size_t i = 0; i < estimate.friction_at_speeds.size(); ++i) {
    const FrictionAtSpeed& at = estimate.friction_at_speeds[i];
    PrintNumber(fmt::format("speed{}", i), at.value, at.interval95);
  }
  for (size_t map = 0; map < estimate.bands.size(); ++map) {
    const MapBand& band = estimate.bands[map];
    for (size_t i = 0; i < band.value.size(); ++i) {
      PrintNumber(fmt::format("map{}.{:.4g}", map, fmt::join(band.points[i], ",")), band.value[i],
                  band.interval95[i]);
    }
  }
  fmt::print("\n");
}

void Study(const Suite& suite, int variant, int realizations) {
  const std::unique_ptr<Plant> plant = MakePlant(VariantScenario(suite, variant));
  const std::string name =
      suite.ladder ? suite.ladder->variants[static_cast<size_t>(variant)].name : suite.name;
  for (int r = 0; r < realizations; ++r) {
    const PreparedLog log = Prepare(plant->Run(static_cast<std::uint64_t>(r)).measurements);
    for (const SuiteIdentifier& one : suite.identifiers) {
      const Identifier& identifier = FindIdentifier(one.name);
      const Estimate estimate = IdentifyAndCheck(
          identifier, {log, identifier.options.Read(one.options, {one.label}), {}});
      fmt::print("{} {} {} {}", name, r, one.label, StatusName(estimate.status));
      const Selection& kept = log.constant_speed().selection;
      PrintNumber("segments", static_cast<double>(kept.segments.size()), std::nullopt);
      PrintNumber("samples", static_cast<double>(kept.count()), std::nullopt);
      Print(estimate);
    }
  }
}

}  // namespace
}  // namespace warmjoint

int main(int count, char** arguments) {
  return warmjoint::StudyVariants("answers_study", count, arguments, warmjoint::Study);
}
