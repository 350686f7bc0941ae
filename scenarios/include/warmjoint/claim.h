// What others claim for an identifier, beside which a leaderboard prints ours.
#pragma once

#include <warmjoint/field.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace warmjoint {

/// A figure that a claim can name.
struct ClaimFigure {
  const char* name;
  std::string_view unit, meaning;
};
inline constexpr std::array kClaimFigures{
    ClaimFigure{"npe_continuous", "", "relative error over k and tau, Eq. (26): 0.05 is 5 %"},
    ClaimFigure{"npe_discrete", "", "the same over ke and te"},
    ClaimFigure{"rmse", "N.m", "root mean square of the residual"},
    ClaimFigure{"mae", "N.m", "mean of its size"},
    ClaimFigure{"fit", "%", "share of the torque that the fit explains"},
    ClaimFigure{"fpe", "(N.m)^2", "final prediction error"}};

/// What another source claims for a row of the leaderboard, printed next to ours.
struct Claim {
  std::string source;
  std::map<std::string, double> figures;  // by their names in kClaimFigures

  template <class A>
  void Serialize(A* a) {
    a->Field("source", &source,
             {.meaning = "who claims it, as \"paper, Fig. 6\"", .needed = "say who claims it"});
    for (const auto& [name, unit, meaning] : kClaimFigures) {
      std::optional<double> figure;
      if (const auto found = figures.find(name); found != figures.end()) figure = found->second;
      a->Field(name, &figure, {.unit = unit, .bounds = {.at_least = 0}, .meaning = meaning});
      if (figure) figures[name] = *figure;
    }
  }

  bool operator==(const Claim&) const = default;
};

}  // namespace warmjoint
