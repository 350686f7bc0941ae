#include "tools/store/digest.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "tools/store/sha256.h"

namespace warmjoint::inline tools {
namespace {

/// Collects values so that no two different sequences of them give the same text.
class Canonical {
 public:
  Canonical& Add(std::string_view text) {
    text_ += fmt::format("{}:{};", text.size(), text);
    return *this;
  }
  Canonical& Add(int value) {
    text_ += fmt::format("{};", value);
    return *this;
  }
  /// As the database gives it back: one NaN, one zero.
  Canonical& Add(double value) {
    text_ += std::isnan(value) ? "nan;" : fmt::format("{};", value + 0.0);
    return *this;
  }

  std::string Digest() const { return Sha256(text_); }

 private:
  std::string text_;
};

void AddMetrics(Canonical& text, const Metrics& m) {
  text.Add(m.n).Add(m.parameters).Add(m.effective_parameters);
  text.Add(m.rmse).Add(m.mae).Add(m.fit).Add(m.fpe);
}

void AddScore(Canonical& text, const Score& score) {
  // the errors over all parameters, then each parameter in both parametrisations
  text.Add(score.npe_continuous).Add(score.npe_discrete);
  text.Add(score.bound_npe_continuous).Add(score.bound_npe_discrete);
  for (const auto* family : {&score.continuous, &score.discrete}) {
    text.Add("family");
    for (const ParameterScore& one : *family) {
      text.Add(one.name).Add(one.truth).Add(one.estimate).Add(one.bound);
      text.Add(one.estimated ? 1 : 0).Add(one.covered ? (*one.covered ? 1 : 0) : 2);
    }
  }
}

}  // namespace

std::string DigestOfPlan(const RunDescription& description) {
  // what decides which results a run has
  Canonical text;
  text.Add(kSchemaVersion).Add(description.suite_yaml);
  for (const auto& [name, value] : description.versions) text.Add(name).Add(value);
  text.Add("identifiers");
  for (const std::string& label : description.identifiers) text.Add(label);
  text.Add("variants");
  for (const std::string& name : description.variants) text.Add(name);
  return text.Digest();
}

std::string DigestOfResults(const std::string& plan, Unit unit, std::span<const Result> results) {
  Canonical text;
  text.Add(plan).Add(unit.variant).Add(unit.realization);
  // what was answered, without the times that it took
  for (const Result& result : results) {
    text.Add(result.identifier).Add(result.status).Add(result.message);
    if (result.metrics) AddMetrics(text, *result.metrics);
    // a score without parameters is stored as none
    const bool scored =
        result.score && !(result.score->continuous.empty() && result.score->discrete.empty());
    if (scored) AddScore(text, *result.score);
  }
  return text.Digest();
}

std::string DigestOfTrace(const std::string& plan, Unit unit, int identifier,
                          const TraceTable& trace) {
  // where the trace belongs, its columns, and its numbers as they lie in memory
  Canonical text;
  text.Add(plan).Add(unit.variant).Add(unit.realization).Add(identifier);
  for (const std::string& column : trace.columns) text.Add(column);
  text.Add(std::string_view(reinterpret_cast<const char*>(trace.values.data()),
                            trace.values.size() * sizeof(float)));
  return text.Digest();
}

}  // namespace warmjoint::inline tools
