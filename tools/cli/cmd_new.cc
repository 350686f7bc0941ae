// warmjoint new scenario|suite|identifier|machine NAME: a commented file to begin with.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/robots/robot_folder.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// What can be begun, and the command that uses it.
struct Template {
  const char* kind;
  const char* file;  // in scenarios/templates
  const char* next;  // NAME stands for what the user named
  const char* advice = "try it as it stands";
};

constexpr Template kTemplates[]{
    {"scenario", "scenario.yaml", "warmjoint simulate NAME.yaml -o NAME"},
    {"suite", "suite.yaml", "warmjoint run NAME.yaml -o NAME"},
    {"identifier", "identifier.py",
     "warmjoint run table1 -o NAME --realizations 5 --identifier 'NAME=python3 NAME.py {recording} "
     "{estimate}'"},
    {"machine", "machine.toml", "tools/library/make --sources FOLDER NAME.toml",
     "fill it in, then"},
};

struct NewArguments {
  std::string kind;
  std::string name;
};

/// Names become files, labels of rows and words of a shell: letters, digits, - and _ do for all.
void CheckName(const std::string& name) {
  // ASCII alone: the locale must not decide
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) || c == '-' || c == '_');
  });
  if (plain && !name.empty() && name.front() != '-') return;
  Refuse({"NAME"}, "is '{}'; it must be of letters, digits, - and _, without folder and extension",
         Excerpt(name));
}

ExitStatus MakeNew(const NewArguments& arguments) {
  // a name that is safe everywhere, and a file that is not there yet
  CheckName(arguments.name);
  const auto chosen = std::find_if(std::begin(kTemplates), std::end(kTemplates),
                                   [&](const Template& one) { return one.kind == arguments.kind; });
  const fs::path source = DataFolder() / "scenarios" / "templates" / chosen->file;
  const fs::path target = arguments.name + source.extension().string();
  if (fs::exists(fs::symlink_status(target))) {
    Refuse({target.string()}, "exists already; choose another name");
  }

  // the template with the name in it, and the command to try it
  WriteWholeFile(target, Replaced(ReadWholeFile(source), "NAME", arguments.name));
  fmt::print(stdout, "{}: {}:\n  {}\n", target.string(), chosen->advice,
             Replaced(chosen->next, "NAME", arguments.name));
  return ExitStatus::done;
}

}  // namespace

Command AddNewCommand(CLI::App& program) {
  auto arguments = std::make_shared<NewArguments>();
  CLI::App* parser = program.add_subcommand(
      "new", "A commented scenario, suite, identifier or machine to begin with");
  GiveExample(*parser, "warmjoint new scenario mine");
  // kinds are those of the templates
  std::vector<std::string> kinds;
  for (const Template& one : kTemplates) kinds.emplace_back(one.kind);
  AddChoice(*parser, "KIND", arguments->kind, kinds, "what to begin")->required();
  AddValue(*parser, "NAME", "TEXT", arguments->name,
           "of the file, without extension; it must not exist")
      ->required();
  return {parser, [arguments] { return MakeNew(*arguments); }};
}

}  // namespace warmjoint
