// A truth that is drawn as an estimate leaves it open.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <iterator>
#include <string>
#include <vector>

#include "models/foundation/node.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {

/// Some of a friction's parameters, known with errors that are normal together.
struct Posterior {
  std::vector<std::string>
      parameters;              // [p] names of the law's, thermal_gain, thermal_time_constant
  Eigen::MatrixXd covariance;  // [p x p] in products of their units

  template <class A>
  void Serialize(A* a) {
    a->Field(
        "parameters", &parameters,
        {.meaning = "names of some of the friction's", .needed = "name some of the friction's"});
    a->Field("covariance", &covariance,
             {.meaning = "a row for each of them",
              .needed = "give a matrix with a row for each parameter"});
    a->Check(covariance.rows() == covariance.cols() && covariance.rows() == std::ssize(parameters),
             "covariance", "a matrix with a row and a column for each parameter");
  }
};

/// {parameters[], covariance[][]}. Throws BadInput for a parameter that `friction` does not
/// have, and for a matrix that is no covariance: not square, not symmetric, or with a negative variance
/// in some direction.
Posterior PosteriorFrom(const Node& node, const Friction& friction);

/// What estimate.json says of its friction's parameters: the rows and columns of its covariance that are
/// the friction's; gravity, inertia and the start are integrated out. Throws BadInput where the estimate
/// has no covariance.
Posterior PosteriorOfEstimate(const Node& estimate, const Friction& friction);

/// A friction drawn from the normal distribution about `friction`, given that its parameters are within
/// their physical bounds: draws outside of them are repeated. Throws BadInput from `place` where 1000
/// draws are outside.
Friction Draw(const Posterior& posterior, const Friction& friction, RandomStream& random,
              const Place& place);

}  // namespace warmjoint
