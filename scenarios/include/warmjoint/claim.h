// What others claim for an identifier, beside which a leaderboard prints ours.
#pragma once

#include <warmjoint/field.h>

#include <array>
#include <map>
#include <optional>
#include <string>

namespace warmjoint {

/// Figures that a claim can name: relative errors (0.05 is 5 %), N.m or N, N.m or N, %, (N.m)^2.
inline constexpr std::array<const char*, 6> kClaimFigures{
    "npe_continuous", "npe_discrete", "rmse", "mae", "fit", "fpe"};

/// What another source claims for a row of the leaderboard, printed beside ours.
struct Claim {
  std::string source;                     // for example "paper, Fig. 6"
  std::map<std::string, double> figures;  // by their names in kClaimFigures

  template <class A>
  void Serialize(A* a) {
    a->Field("source", &source, {.needed = "say who claims it"});
    for (const char* name : kClaimFigures) {
      std::optional<double> figure;
      if (const auto found = figures.find(name); found != figures.end()) figure = found->second;
      a->Field(name, &figure, {.bounds = {.at_least = 0}});
      if (figure) figures[name] = *figure;
    }
  }

  bool operator==(const Claim&) const = default;
};

}  // namespace warmjoint
