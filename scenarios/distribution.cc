#include "scenarios/distribution.h"

#include <cmath>

namespace warmjoint::inline scenarios {

double Distribution::Draw(RandomStream& random) const {
  switch (kind) {
    case Kind::fixed:
      return a;
    case Kind::uniform:
      return random.Uniform(a, b);
    case Kind::normal:
      return a + b * random.Normal();
    case Kind::log_uniform:
      return a * std::pow(b / a, random.Uniform());
  }
  return a;
}

}  // namespace warmjoint::inline scenarios
