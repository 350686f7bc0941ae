// Time of one identification of Table I: 3600 samples at 1 s, on one core.
#include <benchmark/benchmark.h>
#include <warmjoint/prepared_log.h>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/apply.h"
#include "identification/lack_of_fit/find_lack_of_fit.h"
#include "models/foundation/keep_memory.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

void Identify(benchmark::State& state, const char* name,
              const std::map<std::string, std::string>& given) {
  const Measurements recording =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1);
  const Identifier& identifier = FindIdentifier(name);
  const IdentifierInput input{Prepare(recording), identifier.options.Read(given), {}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(IdentifyUnchecked(identifier, input));
  }
}

// as the program does
const bool kKeeps = (KeepFreedMemory(), true);

/// What the verdict costs on top.
void Judge(benchmark::State& state, const char* name) {
  const Measurements recording =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 1), 0.5, 1);
  const Identifier& identifier = FindIdentifier(name);
  const IdentifierInput input{Prepare(recording), identifier.options, {}};
  const Fit fit = identifier.fit(input);
  const Inference inferred = Infer(fit);
  for (auto _ : state) {
    const LackOfFit found =
        FindLackOfFit(identifier, input, fit, inferred,
                      EvaluateModel(fit, inferred, input.measurements, input.selection), {});
    benchmark::DoNotOptimize(Apply(inferred, found.causes));
  }
}

BENCHMARK_CAPTURE(Judge, nominal_ls, "nominal-ls")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Judge, energy_ml, "energy-ml")->Unit(benchmark::kMicrosecond);

BENCHMARK_CAPTURE(Identify, nominal_ls, "nominal-ls", {})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Identify, energy_ml, "energy-ml", {})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Identify, energy_als_50, "energy-als", {{"iterations", "50"}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Identify, energy_als_500, "energy-als", {{"iterations", "500"}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace warmjoint
