// The structures that `auto` chooses from.
#pragma once

#include <warmjoint/friction_model.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "identification/fields/fit_fields.h"
#include "identification/fit/identifier.h"
#include "identification/holdout/hold_out.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/nonlinear/stribeck_fit.h"

namespace warmjoint {

/// An identifier, whose options are the structure's.
struct Structure {
  Identifier identifier;
  /// The option that its name has even at its default; or empty.
  std::string_view named_option{};
  /// The strength of the prior on a map, where it is chosen for the rows on which structures are compared.
  std::optional<double> strength{};

  /// "energy-ml gravity=sincos law=coulomb"
  std::string Name() const;
  /// The same with another group of options of that type.
  template <class T>
  Structure With(const T& group) const {
    Structure other = *this;
    other.identifier.options = identifier.options.With(group);
    return other;
  }
  /// Its gravity; none where it has no such option.
  FittedGravity gravity() const;

  /// The same with the number and the width of a map's kernels, of those over the motor's angle with the
  /// width.
  Structure WithShapeOf(const FrictionMap& map) const;

  /// Whether it fits law and warming together.
  bool CanWarm() const;

  /// Whether it could estimate a lag of the torque, too.
  bool CanEstimateLag() const;

  /// Whether it estimates a delay of the torque relative to motion of any kind.
  bool CanEstimateDelay() const;

  /// Whether it can have fields.
  bool CanHaveFields() const;

  /// Its options, E(0) as those of the input have it, where it asks.
  Options OptionsWith(const Options& input) const;
  /// Fitted to the samples of the input.
  Fit Fitted(const IdentifierInput& input) const;
  /// The same without bands along maps, which only a reader needs.
  Structure PointEstimate() const;
  /// A sketch for the rows that structures are compared on.
  Structure Quick() const;
  /// What it leaves of samples that it has not seen (UnseenResiduals).
  std::optional<Eigen::VectorXd> UnseenOn(const IdentifierInput& input,
                                          const std::vector<Eigen::Index>& bounds) const;
};

/// A kind of gravity, or none: the one to try is chosen.
struct GravityToTry {
  std::optional<FittedGravity> kind;
  bool operator==(const GravityToTry&) const = default;
};
std::span<const Word<GravityToTry>> WordsOf(GravityToTry);

/// The options of `auto` alone.
struct AutoOptions {
  int blocks = 6;
  GravityToTry gravity;
  FieldSet fields = FieldSet::All();

  template <class A>
  void Serialize(A* a) {
    a->Field("blocks", &blocks,
             {.bounds = {.at_least = 3, .at_most = 50},
              .meaning = "contiguous parts of the recording to hold out"});
    a->Field("gravity", &gravity, kGravityInfo);
    a->Field("fields", &fields, kFieldsInfo);
  }
};

/// Kinds of gravity to try, the simplest first: the one that the option `gravity` names, or none,
/// sincos and paired for a joint that turns, none and paired for one that slides.
std::vector<FittedGravity> GravityKinds(const IdentifierInput& input);

/// Laws that are linear in their parameters with gravity, without warming and with it.
std::vector<Structure> ColdStructures(FittedGravity gravity);
std::vector<Structure> WarmStructures(FittedGravity gravity);

/// The Stribeck law with gravity.
Structure StribeckStructure(PartFit warming, FittedGravity gravity);

/// The same with a Coulomb level for each direction of motion.
Structure TwoLevelStribeckStructure(PartFit warming, FittedGravity gravity);

/// Maps whose kernels are chosen already, or nothing where they are not.
struct ChosenKernels {
  std::optional<ChosenMap> position;
  std::optional<ChosenMap> motor;  // over the motor's angle
};

/// Maps, without warming and with it, also with gravity.
std::vector<Structure> MapStructures(const IdentifierInput& input, FittedGravity gravity,
                                     const ChosenKernels& kernels = {});

/// The lag, s, that a structure with the option torque_lag finds on every sample; nothing where the
/// log shows none to the model, the same structure's without lag. start: of that model.
std::optional<double> LagOf(const Structure& structure, const TorqueModel& without,
                            const ThermalStart& start, const IdentifierInput& input);

/// By how much the torque of motion of any kind is late beyond chance.
struct LateTorque {
  double delay = 0;  // s
  double harm = 0;   // change of the friction, rms, where it is left out, as a share
};

/// The delay that the richest linear law, with gravity, estimates; nothing where the log shows no such delay, or holds speeds.
std::optional<LateTorque> FindLateTorque(const IdentifierInput& input);

/// The selection without the first five time constants of each run, after which 1/150 of what the lag
/// held is left, or without half of the run where it is shorter: the samples for structures without
/// a lag.
Selection Settled(const LogSamples& measurements, Selection selection, double lag);

}  // namespace warmjoint
