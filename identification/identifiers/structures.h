// The structures that `auto` chooses from.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identification/identifier.h"
#include "identification/maps/energy_ml_maps.h"

namespace warmjoint::inline identification {

/// An identifier with its options.
struct Structure {
  Identifier identifier;
  std::map<std::string, std::string> given;
  /// Of the prior on a map, where it is chosen for the rows that structures are compared on.
  std::optional<double> strength{};

  /// "energy-ml law=coulomb gravity=sincos"
  std::string Name() const;
  /// What an option was given as; `otherwise` where it was not.
  std::string Given(const std::string& option, const std::string& otherwise) const;
  /// The same with another option.
  Structure With(const std::string& option, const std::string& value) const;

  /// The same with the number and the width of a map's kernels, of those over the motor's angle with the
  /// width.
  Structure WithShapeOf(const FrictionMap& map) const;

  /// Whether it could estimate a lag of the torque, too.
  bool CanTellLag() const;

  /// The identifier's options: what is given, and what those of the input say of E(0), where it asks.
  Options OptionsBeside(const Options& input) const;
  /// Fitted to the samples of the input.
  Fit Fitted(const IdentifierInput& input) const;
  /// The same without what only a reader wants: bands along maps.
  Structure Sketch() const { return identifier.Has("bands") ? With("bands", "none") : *this; }
  /// A sketch for the rows that structures are compared on.
  Structure Quick() const;
  /// Mean squared errors on blocks that it has not seen (BlockedErrors).
  std::optional<Eigen::VectorXd> ErrorsOn(const IdentifierInput& input,
                                          const std::vector<Eigen::Index>& bounds) const;
};

/// Kinds of gravity to try, the simplest first: the one that the option `gravity` names, or none,
/// sincos and paired for a joint that turns, none and paired for one that slides.
std::vector<std::string> GravityKinds(const IdentifierInput& input);

/// Laws that are linear in their parameters beside gravity, without warming and with it.
std::vector<Structure> ColdStructures(const std::string& gravity);
std::vector<Structure> WarmStructures(const std::string& gravity);

/// The Stribeck law, which is fitted without gravity. warming: none or estimated.
Structure StribeckStructure(const std::string& warming);

/// The same with a Coulomb level for each direction of motion.
Structure TwoLevelStribeckStructure(const std::string& warming);

/// Maps whose kernels are chosen already, or nothing where they are not.
struct ChosenKernels {
  std::optional<ChosenMap> position;
  std::optional<ChosenMap> motor;  // over the motor's angle
};

/// Maps, without warming and with it, also beside gravity.
std::vector<Structure> MapStructures(const IdentifierInput& input, const std::string& gravity,
                                     const ChosenKernels& kernels = {});

}  // namespace warmjoint::inline identification
