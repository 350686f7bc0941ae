// The samples of a log that an identifier learns from, and the options that say which.
#pragma once

#include <warmjoint/estimate.h>

#include <array>
#include <optional>
#include <span>

#include "identification/identifier.h"

namespace warmjoint {

/// The option of an identifier that can follow motion of any kind.
struct MotionOption {
  MotionKind motion = MotionKind::chosen;

  template <class A>
  void Serialize(A* a) {
    a->Field("motion", &motion,
             {.meaning = "constant: samples at constant speed; any: all that move, with inertia "
                         "beside friction; chosen: any where the log holds no speeds"});
  }
};

/// What a fit minimises over the residuals.
enum class LossKind { squares, huber };
inline std::span<const Word<LossKind>> WordsOf(LossKind) {
  static constexpr std::array words{Word{"squares", LossKind::squares},
                                    Word{"huber", LossKind::huber}};
  return words;
}

/// The option of an identifier that can do with outliers.
struct LossOption {
  LossKind loss = LossKind::squares;

  template <class A>
  void Serialize(A* a) {
    a->Field("loss", &loss,
             {.meaning = "squares, or Huber's loss, which bounds the pull of outliers"});
  }
};

/// The input with the samples that the identifier learns from: those of its view; of one that has the
/// option `motion`, all that move where that asks for them, or where the log shows no constant speeds.
IdentifierInput SelectSamples(const Identifier& identifier, const IdentifierInput& input);

/// The samples of a log beside which a model is laid: with an inertia all that move, whatever for. Without one it depends
/// on that: those of its identifier's view, to see how well that fits others; at constant speed, to compare torques; raw,
/// to show the log or to score the model on it. inertia: of the model; otherwise: the view of one that has none
const LogView& SeenByModel(const std::optional<double>& inertia, View otherwise,
                           const PreparedLog& log);

}  // namespace warmjoint
