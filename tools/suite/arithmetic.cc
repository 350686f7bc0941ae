#include "tools/suite/arithmetic.h"

#include <cmath>
#include <cstring>

#include "models/foundation/random_stream.h"
#include "scenarios/parse_suite.h"
#include "tools/store/digest.h"
#include "tools/store/sha256.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/run_realization.h"

namespace warmjoint::inline tools {
namespace {

constexpr int kArguments = 2000;  // of each function; of exp, some in a thousand differ by FMA

/// Both plants, drawn motions and noise, and fits of a closed form and of an iteration.
constexpr const char* kSuite = R"(name: arithmetic
question: Does this machine calculate as another?
realizations: 1
seed: 20
scenario:
  plant: ideal
  friction:
    law: viscous_coulomb
    parameters: {viscous: 5, coulomb: 15}
    thermal: {thermal_gain: -3, thermal_time_constant: 100}
  motion: {speeds: {uniform: [0.1, 1]}, hold: 5, order: alternating}
  noise: {torque: 0.5}
  sampling: {rate: 10}
  duration: 60
ladder:
  variants:
    ideal: {}
    engine: {plant: mujoco, robot: rotary, joint: hinge, duration: 20, controller.bandwidth: 20}
identifiers:
  - name: energy-ml
  - {name: energy-als, options: {iterations: 10}}
)";

/// Collects the bits of numbers.
class Bits {
 public:
  void Add(double value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    bytes_.append(bytes, sizeof value);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string DigestOfRealizations() {
  const Suite suite = ParseSuite(kSuite, "the fixed calculation");
  const std::vector<PreparedIdentifier> identifiers =
      PrepareIdentifiers(suite.identifiers, {suite.name});
  std::string digests;
  // the first realization of each variant, by all identifiers
  for (int variant = 0; variant < suite.variants(); ++variant) {
    const Unit unit{variant, 0};
    const Carried carried = RunRealization(MakeBench(VariantScenario(suite, variant)), identifiers,
                                           unit, RecordingKeeper(""));
    digests += DigestOfResults("", unit, carried.realization.results);
  }
  return digests;
}

}  // namespace

std::string DigestOfFunctions() {
  RandomStream random({20, 0}, Stream::test);
  Bits bits;
  // functions whose last bits depend on the library and the machine
  for (int i = 0; i < kArguments; ++i) {
    const double x = random.Uniform(-20, 20), positive = random.Uniform(0, 20);
    for (const double value :
         {std::exp(x), std::expm1(x), std::sin(x), std::cos(x), std::tan(x), std::atan(x),
          std::sinh(x), std::cosh(x), std::tanh(x), std::erf(x), std::cbrt(x), std::log(positive),
          std::log1p(positive), std::log10(positive), std::pow(positive, x), std::sqrt(positive),
          std::atan2(x, positive), std::hypot(x, positive), std::tgamma(positive)}) {
      bits.Add(value);
    }
  }
  return Sha256(bits.bytes());
}

const std::string& ArithmeticDigest() {
  static const std::string digest =
      Sha256(DigestOfFunctions() + DigestOfRealizations()).substr(0, 16);
  return digest;
}

}  // namespace warmjoint::inline tools
