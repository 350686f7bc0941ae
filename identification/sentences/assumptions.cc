#include "identification/sentences/assumptions.h"

#include <fmt/format.h>

#include <cmath>

namespace warmjoint {
namespace {

/// An assumption as estimate.json has it. meaning: with a place for its size and the torque's unit
struct AssumptionWords {
  Source source;
  const char* meaning;
};

constexpr AssumptionWords kAssumptions[] = {
    {Source::cold_start,
     "the joint was cold at the start, not at a tenth of the warmth that it reaches"},
    {Source::open_start,
     "the joint was cold at the start, though a start whose friction differs by {:.2g} {} from "
     "that of a cold joint would stay unseen"},
    {Source::slow_drift, "nothing outside of the model changed the friction by 1 % over the log"},
    {Source::open_drift,
     "nothing outside of the model changed the friction slowly, though this log cannot rule it "
     "out"},
    {Source::open_curve,
     "friction depends on the speed as the law has it, though this log cannot rule out that it "
     "bends"},
    {Source::open_memory,
     "friction follows the speed at once, though this log cannot rule out that a part of it is "
     "late"},
    {Source::dead_band,
     "the torque's sensor has no dead band, though one of {:.2g} {} would stay unseen"},
    {Source::offset,
     "the torque has no offset and holds no load, though the one direction of the log would not "
     "show {:.2g} {}"},
    {Source::degrees, "positions and speeds are in radians, not both in degrees or revolutions"},
    {Source::clock, "the clock of the log is right, not off by 1 %"},
};

}  // namespace

std::vector<Assumption> AssumptionsOf(const std::vector<Cause>& causes, const Fit& fit,
                                      const std::string& unit) {
  std::vector<Assumption> assumptions;
  for (const AssumptionWords& words : kAssumptions) {
    // rows of one source are ways in which the assumption may be wrong; for each parameter the worst counts
    const Cause* first = nullptr;
    Eigen::VectorXd moves;
    for (const Cause& cause : causes) {
      if (cause.source != words.source || cause.bias.size() == 0) continue;
      if (!first) {
        first = &cause;
        moves = cause.bias;
      }
      moves = (cause.bias.cwiseAbs().array() > moves.cwiseAbs().array()).select(cause.bias, moves);
    }
    if (!first) continue;
    assumptions.push_back({std::string(NameOf(words.source)),
                           fmt::format(fmt::runtime(words.meaning), std::abs(first->size), unit),
                           NamedMoves(first->rows, moves, fit)});
  }
  return assumptions;
}

ParameterMoves NamedMoves(const std::vector<std::size_t>& rows, const Eigen::VectorXd& moves,
                          const Fit& fit) {
  ParameterMoves named;
  if (moves.size() == 0) return named;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    named.emplace_back(fit.parameters[rows[i]].name, moves[static_cast<Eigen::Index>(i)]);
  }
  return named;
}

}  // namespace warmjoint
