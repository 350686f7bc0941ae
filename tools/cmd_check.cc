// warmjoint check RECORDING: what a log holds, and what can be identified from it.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "sim/dataset/check_report.h"
#include "tools/command.h"
#include "tools/recording_options.h"

namespace warmjoint {
namespace {

struct CheckArguments {
  RecordingArguments recording;
  std::string format = "text";
};

ExitStatus Check(const CheckArguments& arguments) {
  const RecordingCheck check = CheckRecording(ReadRecording(arguments.recording));
  if (arguments.format == "json") {
    fmt::print("{}\n", CheckToJson(check).dump(2));
  } else {
    fmt::print("{}", CheckToText(check));
  }
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

}  // namespace warmjoint
