// Knows warmjoint by its targets alone: 0 where a step of Eq. (22) is the closed form.
#include <cmath>

#include "models/friction/friction_description.h"
#include "models/friction/thermal.h"
#include "models/recording/unwrap.h"

int main() {
  using namespace warmjoint;
  const DiscreteThermal step = Discretise({-3, 600}, 60);
  const bool is_closed_form = std::abs(step.pole - std::exp(-0.1)) < 1e-15;
  return is_closed_form && FindLaw("viscous_coulomb") != nullptr ? 0 : 1;
}
