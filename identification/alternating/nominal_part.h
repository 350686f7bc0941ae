// What Algorithm 1 fits by Eq. (24): a nominal law with gravity or with a map over position beside
// it.
#pragma once

#include <array>
#include <span>

#include "identification/layout.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/identify_maps.h"

namespace warmjoint {

/// Whether a map stands beside the law.
enum class NominalMap { none, map };
inline std::span<const Word<NominalMap>> WordsOf(NominalMap) {
  static constexpr std::array words{Word{"none", NominalMap::none}, Word{"map", NominalMap::map}};
  return words;
}

/// A map beside the law, and how it is made.
struct NominalMapOptions : AddedMapOptions {
  NominalMap position = NominalMap::none;

  template <class A>
  void Serialize(A* a) {
    a->Field("position", &position, {.meaning = "a map over position beside the law"});
    AddedMapOptions::Serialize(a);
  }
};

struct NominalPart {
  Selection moving;         // samples that take part: kept, and not at rest
  RigidPart gravity;        // none beside a map
  Eigen::MatrixXd columns;  // [N x p] over all samples: law (d), then gravity or kernels (q)
  /// [p x p] (A^T A + s P)^-1 over the moving samples; P: 1 on the kernels' diagonal.
  Eigen::MatrixXd cofactor;
  Eigen::VectorXd solution;        // [p] the fit without warming
  std::vector<FrictionMap> maps;   // shapes
  double strength = 0;             // s
  double effective = 0;            // of the p parameters
  std::optional<Refusal> refusal;  // why there is no such part

  /// Of the p columns, law, gravity and kernels, and the heat that the fit has behind them.
  Layout layout() const;

  /// Maps with their weights. nominal: [p]
  std::vector<FrictionMap> MapsOf(const Eigen::VectorXd& nominal) const;
};

/// As the options law, gravity and position ask for it. The map's shape and strength are chosen on
/// the torque as it is, warming included. identifier: the name of the one that asks.
NominalPart PrepareNominalPart(const IdentifierInput& given, const std::string& identifier);

}  // namespace warmjoint
