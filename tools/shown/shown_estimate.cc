#include "tools/shown/shown_estimate.h"

#include <fmt/format.h>
#include <warmjoint/friction.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string_view>

#include "identification/fit/cause.h"
#include "identification/fit/fit_parameters.h"
#include "identification/sentences/friction.h"
#include "models/friction/thermal.h"

namespace warmjoint {
namespace {

/// Whether the parameter repeats others, for a program that steps by the sampling interval.
bool IsOfOneStep(const EstimatedParameter& one) {
  return one.name == kDiscreteGainName || one.name == kPoleName;
}

/// Whether the parameter is a delay that may be there by chance: it is fitted to every log of motion, and an interval that leaves out 0
/// is one in 20; two half widths are 4 standard errors, one in 16,000.
bool IsNoDelay(const EstimatedParameter& one) {
  return one.name == NameOf(Role::delay) && one.interval95 &&
         std::abs(one.value) <= one.interval95->back() - one.interval95->front();
}

/// Whether only friction at speeds is known, and not this parameter of the law.
bool IsShared(const Estimate& estimate, const EstimatedParameter& one) {
  if (estimate.friction_at_speeds.empty() || one.interval95) return false;
  const Law* law = estimate.friction ? FindLaw(estimate.friction->law) : nullptr;
  return law && std::ranges::any_of(law->parameters, [&](const ParameterInfo& info) {
           return info.name == one.name;
         });
}

constexpr std::size_t kBriefly = 3;  // remarks

/// Whether the stop at `i` ends a sentence: behind a word or a bracket and before a capital, so neither
/// that of "0.5 N.m" nor that of "Eq. (22)".
bool IsFullStop(std::string_view text, std::size_t i) {
  if (text[i] != '.' || i == 0 || i + 2 >= text.size()) return false;
  const auto before = static_cast<unsigned char>(text[i - 1]);
  const auto next = static_cast<unsigned char>(text[i + 2]);
  return (std::isalpha(before) || before == ')') && std::isupper(next);
}

/// Where a sentence or a clause ends: after "; " or ". " outside of brackets; the end of the text else.
std::size_t EndOfClause(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    const bool ends = text[i] == ';' || IsFullStop(text, i);
    if (depth <= 0 && ends && text[i + 1] == ' ') return i;
  }
  return text.size();
}

std::vector<std::string> Clauses(std::string_view text) {
  std::vector<std::string> sentences;
  while (!text.empty()) {
    const std::size_t end = EndOfClause(text);
    if (end > 0) sentences.push_back(AsSentence(std::string(text.substr(0, end))));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
  return sentences;
}

/// A warning's first clause and its last: what was found, and what would help.
std::string Shortened(const std::string& warning) {
  const std::vector<std::string> clauses = Clauses(warning);
  if (clauses.size() < 3) return AsSentence(warning);
  return clauses.front() + " " + clauses.back();
}

}  // namespace

std::vector<EstimatedParameter> OwnParameters(const Estimate& estimate) {
  std::vector<EstimatedParameter> own;
  for (const EstimatedParameter& one : estimate.parameters) {
    if (!IsShared(estimate, one) && !IsOfOneStep(one) && !IsNoDelay(one)) own.push_back(one);
  }
  return own;
}

std::vector<EstimatedParameter> ShownParameters(const Estimate& estimate) {
  std::vector<EstimatedParameter> shown;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    shown.push_back({NameOfFriction(one), one.value, one.unit, one.std, one.interval95});
  }
  std::ranges::move(OwnParameters(estimate), std::back_inserter(shown));
  return shown;
}

std::optional<std::string> RangeAtBound(const EstimatedParameter& one) {
  if (!one.interval95) return std::nullopt;
  const auto [lower, upper] = *one.interval95;
  // an interval that no bound cuts has its value in the middle, or for a logarithm near it
  const double at_end = 0.01 * (upper - lower);
  if (one.value - lower > at_end && upper - one.value > at_end) return std::nullopt;
  const auto end = [&](double value) {
    return std::abs(value) < 1e-9 * (upper - lower) ? 0 : value;
  };
  return fmt::format("{:.2g} to {:.2g}", end(lower), end(upper));
}

std::vector<Assumption> ShownAssumptions(const Estimate& estimate) {
  std::vector<Assumption> shown = estimate.assumptions;
  const bool is_stated = estimate.recording && estimate.recording->read.unit.contains("position");
  std::erase_if(shown, [&](const Assumption& one) {
    return is_stated && one.name == NameOf(Source::degrees);
  });
  return shown;
}

std::string AsSentence(std::string clause) {
  const std::size_t word = clause.find_first_of(" :_.=");
  const bool is_word = word == std::string::npos || clause[word] == ' ' || clause[word] == ':';
  if (is_word && !clause.empty()) {
    clause[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(clause[0])));
  }
  const bool stops =
      !clause.empty() && std::string_view(".?!").find(clause.back()) != std::string_view::npos;
  return stops ? clause : clause + ".";
}

std::vector<std::string> Remarks(const Estimate& estimate) {
  std::vector<std::string> remarks = Clauses(estimate.message);
  for (const std::string& warning : estimate.warnings) remarks.push_back(AsSentence(warning));
  return remarks;
}

std::vector<std::string> BriefRemarks(const Estimate& estimate) {
  const std::vector<std::string> message = Clauses(estimate.message);
  std::vector<std::string> brief;
  if (!message.empty()) brief.push_back(message.front());
  if (estimate.status != Status::ok && message.size() > 1) brief.push_back(message.back());
  for (const std::string& warning : estimate.warnings) {
    if (brief.size() < kBriefly) brief.push_back(Shortened(warning));
  }
  return brief;
}

}  // namespace warmjoint
