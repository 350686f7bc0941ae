// The family of nominal friction laws, and its one list.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "models/friction/parameter_info.h"
#include "models/friction/pre_sliding.h"

namespace warmjoint::inline models {

/// A nominal law behind one interface, made from the law's own struct.
struct Law {
  std::string_view name;
  std::string_view equation;
  std::span<const ParameterInfo> parameters;
  /// Force of steady sliding in N.m or N at velocity v (rad/s or m/s); p: one value for each of
  /// `parameters`.
  double (*force)(double v, const double* p);
  /// The load in N.m or N that a joint at rest bears before it slides to `side`, 1 or -1.
  double (*holding_level)(int side, const double* p);
  PreSliding pre_sliding;
};

/// All laws, in the order of law_list.h.
const std::vector<Law>& Laws();

/// The law of that name, or nullptr.
const Law* FindLaw(std::string_view name);

/// Names of all laws, in the order of the list.
std::vector<std::string> LawNames();

/// What the parameter of that name is in the laws that have it, for what was read from a file;
/// LawPart::other where none has.
LawPart PartOf(std::string_view name);

/// The place in the law's table of the first parameter that is that part; nothing where there is
/// none.
std::optional<size_t> PlaceOf(LawPart part, const Law& law);

/// Row of the regressor at velocity v: dF/dp, one entry for each parameter.
/// Exact for laws that are linear in their parameters: the force for each unit vector.
void Regressor(const Law& law, double v, double* row);

}  // namespace warmjoint::inline models
