// warmjoint validate [ANSWERS]: how many digits of the certified problems an identifier of others has.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/data_folder.h"
#include "models/foundation/node.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

// why: the answers from two starts agree to 1e-10
constexpr double kCertifiedDigits = 10;

struct ValidateArguments {
  std::string answers;
  std::string format = "text";
};

std::filesystem::path ProblemsFolder() { return DataFolder() / "scenarios/certified"; }

/// Digits that a number has in common with a certified one, not 0: -log10 of the relative error, from 0 to those certified.
double DigitsOf(double value, double certified) {
  const double error = std::abs(value - certified) / std::abs(certified);
  if (!std::isfinite(error)) return 0;
  return error == 0 ? kCertifiedDigits : std::clamp(-std::log10(error), 0.0, kCertifiedDigits);
}

/// A number by itself, or the `value` of a parameter as in estimate.json. Refuses all else.
double NumberOf(const Node& given) {
  if (!given.IsMap()) return given.Number();
  return given.Require("value", "give the number").Number();
}

/// {problem, digits, parameters{name: {value, certified, digits}}} of one problem; `digits` is that of the worst parameter.
Tree Scored(const std::string& name, const Node& certified, const Node& answer) {
  answer.RequireKnownKeys(certified.Keys());
  Tree row{{"problem", name}, {"digits", kCertifiedDigits}, {"parameters", Tree::object()}};
  for (const std::string& parameter : certified.Keys()) {
    const double truth = NumberOf(certified.Require(parameter, ""));
    const std::optional<Node> given = answer.Find(parameter);
    const double digits = given ? DigitsOf(NumberOf(*given), truth) : 0;
    row["parameters"][parameter] = {{"value", given ? Tree(NumberOf(*given)) : Tree()},
                                    {"certified", truth},
                                    {"digits", digits}};
    row["digits"] = std::min(row["digits"].get<double>(), digits);
  }
  return row;
}

/// All problems, those that have no answer with 0 digits.
Tree ScoredAll(const Node& problems, const std::string& file) {
  const Node answers = ReadJsonNode(file);
  answers.RequireKnownKeys(problems.Keys());
  const Node none = ParseJsonNode("{}", file);
  Tree rows = Tree::array();
  for (const std::string& name : problems.Keys()) {
    const Node certified = problems.Require(name, "").Require("answer", "");
    rows.push_back(Scored(name, certified, answers.Find(name).value_or(none)));
  }
  return rows;
}

std::string DigitsTable(const Tree& rows) {
  Table table{{"problem", "digits", "digits of each parameter"}, {}};
  for (const Tree& row : rows) {
    std::vector<std::string> each;
    for (const auto& [name, found] : row["parameters"].items()) {
      each.push_back(found["value"].is_null()
                         ? name + " absent"
                         : fmt::format("{} {:.1f}", name, found["digits"].get<double>()));
    }
    table.rows.push_back({row["problem"], fmt::format("{:.1f}", row["digits"].get<double>()),
                          fmt::format("{}", fmt::join(each, ", "))});
  }
  return TableToText(table, table.header.size(), PageOf(stdout));
}

/// What there is to solve: the log of each problem, and its unknowns with their units.
std::string ProblemsTable(const Node& problems) {
  Table table{{"problem", "log", "unknowns"}, {}};
  for (const std::string& name : problems.Keys()) {
    const Node answer = problems.Require(name, "").Require("answer", "");
    table.rows.push_back({name, (ProblemsFolder() / (name + ".csv")).string(),
                          fmt::format("{}", fmt::join(answer.Keys(), ", "))});
  }
  return TableToText(table, table.header.size(), PageOf(stdout));
}

ExitStatus Validate(const ValidateArguments& arguments) {
  const Node problems = ReadJsonNode(ProblemsFolder() / "problems.json");
  const bool as_json = arguments.format == "json";
  if (arguments.answers.empty()) {
    fmt::print("{}", as_json ? problems.tree().dump(2) + "\n" : ProblemsTable(problems));
    return ExitStatus::done;
  }
  const Tree rows = ScoredAll(problems, arguments.answers);
  fmt::print("{}", as_json ? rows.dump(2) + "\n" : DigitsTable(rows));
  return ExitStatus::done;
}

}  // namespace

Command AddValidateCommand(CLI::App& program) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* parser = program.add_subcommand(
      "validate", "Digits of an identifier of others on problems with certified answers");
  GiveExample(*parser, "warmjoint validate answers.json");
  AddValue(*parser, "ANSWERS", "ANSWERS", arguments->answers,
           "JSON of {problem: {parameter: number}}; without it: the problems and their logs");
  AddChoice(*parser, "--format", arguments->format, {"text", "json"}, "of what is printed");
  return {parser, [arguments] { return Validate(*arguments); }};
}

}  // namespace warmjoint
