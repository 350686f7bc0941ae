// The samples of a log to which an identifier is fitted, and the options that select them.
#pragma once

#include <warmjoint/estimate.h>

#include <array>
#include <optional>
#include <span>

#include "identification/fit/identifier.h"

namespace warmjoint {

/// The options of an identifier that can follow motion of any kind.
struct MotionOption {
  MotionKind motion = MotionKind::chosen;
  PartFit inertia = PartFit::estimated;

  template <class A>
  void Serialize(A* a) {
    a->Field("motion", &motion,
             {.meaning = "constant: samples at constant speed; any: all that move, with inertia "
                         "beside friction; chosen: any where the log holds no speeds"});
    a->Field("inertia", &inertia,
             {.meaning = "torque for acceleration, in motion of any kind, or none"});
  }
};

/// The same options with an inertia of 0, where an inertia may be asked for.
Options WithoutInertia(const Options& options);

/// The loss of the residuals that a fit minimises.
enum class LossKind { squares, huber };
inline std::span<const Word<LossKind>> WordsOf(LossKind) {
  static constexpr std::array words{Word{"squares", LossKind::squares},
                                    Word{"huber", LossKind::huber}};
  return words;
}

/// The option of an identifier that can fit data with outliers.
struct LossOption {
  LossKind loss = LossKind::squares;

  template <class A>
  void Serialize(A* a) {
    a->Field("loss", &loss,
             {.meaning = "squares, or Huber's loss, which bounds the pull of outliers"});
  }
};

/// The input with the samples to which the identifier is fitted: those of its view; of one that has the
/// option `motion`, all samples at which the joint moves where that asks for them, or where the log shows no constant speeds.
IdentifierInput SelectSamples(const Identifier& identifier, const IdentifierInput& input);

/// The samples of a log with which a model is compared. With an inertia they are all at which the joint moves. Without one they
/// depend on the purpose: those of its identifier's view, to see how well it fits other logs; at constant speed, to compare
/// torques; raw, to show the log or to score the model on it. inertia: of the model; otherwise: the view of one that has none
const LogView& SeenByModel(const std::optional<double>& inertia, View otherwise,
                           const PreparedLog& log);

}  // namespace warmjoint
