// warmjoint check RECORDING: what a log holds, and what can be identified from it.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "identification/preparation/check_report.h"
#include "tools/cli/command.h"
#include "tools/cli/recording_options.h"

namespace warmjoint::inline tools {
namespace {

struct CheckArguments {
  RecordingArguments recording;
  std::string format = "text";
};

ExitStatus Check(const CheckArguments& arguments) {
  // an object for one recording, a list of them for several
  nlohmann::json checks = nlohmann::json::array();
  std::string text;
  for (const Measurements& recording : ReadRecordings(arguments.recording)) {
    const RecordingCheck check = CheckRecording(recording);
    checks.push_back(CheckToJson(check));
    text += (text.empty() ? "" : "\n") + CheckToText(check);
  }
  if (arguments.format == "json") {
    text = (checks.size() == 1 ? checks.front() : checks).dump(2) + "\n";
  }
  fmt::print("{}", text);
  return ExitStatus::done;
}

}  // namespace

Command AddCheckCommand(CLI::App& program) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* parser =
      program.add_subcommand("check", "What a log holds, and what can be identified from it");
  AddRecordingOptions(*parser, arguments->recording);
  parser->add_option("--format", arguments->format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  return {parser, [arguments] { return Check(*arguments); }};
}

}  // namespace warmjoint::inline tools
