// Friction from a recording: what `warmjoint identify` does.
//
//   IdentifySettings settings;
//   settings.identifier = "energy-ml";
//   settings.options["law"] = "asymmetric";
//   const Estimate estimate = Identify(ReadRecording("log.csv"), settings);
#pragma once

#include <warmjoint/estimate.h>

namespace warmjoint::api {

/// One option of an identifier.
struct OptionInfo {
  std::string name, default_value;
  std::string
      allowed;  // "text", "range", words with | between them, or "number" or "integer" and bounds
  std::string meaning;
};

/// An identifier: its name, what it does, and its options.
struct IdentifierInfo {
  std::string name, summary;
  std::vector<OptionInfo> options{};
};

/// All identifiers, as `warmjoint list identifiers` has them.
std::vector<IdentifierInfo> Identifiers();

/// What becomes of the numbers of a model that the verdict finds inadequate.
enum class VoidNumbers {
  withhold,
  show,  // as --force: with a status and a message that call them void
};

/// What is asked; each member is called as its option of the command line, with the same default.
struct IdentifySettings {
  std::string identifier = "energy-ml";
  std::map<std::string, std::string> options{};  // as --set: {"law", "asymmetric"}
  std::string gravity = "none";                  // none, sincos or paired
  std::string start = "cold";                    // cold, unknown or estimated
  double relevance =
      0.1;  // change of the friction by lack of fit, a share, from which a model is refused
  double holdout = 0.3;  // share of the recording's end for figures on unseen data; 0: none
  std::optional<PreparedLog> holdout_log{};  // another recording for them, instead
  VoidNumbers void_numbers = VoidNumbers::withhold;
  std::string motion = "chosen";  // constant, any, or chosen: any where the log holds no speeds
  /// As --follows: of the recording before this one, whose heat is there at the start, less what cooled
  /// in the pause between, s; without one the stamps of both tell it.
  std::optional<Estimate> follows{};
  std::optional<double> pause{};
};

/// Fits, judges and reports. The verdict is the estimate's status, with a message and data (diagnostics); mathematics that
/// fails does not throw. Throws BadInput for names, options and numbers that cannot be used. Several threads may identify
/// at once.
Estimate Identify(const PreparedLog& log, const IdentifySettings& settings = {});

}  // namespace warmjoint::api
