#include "tools/suite/external_command.h"

#include <algorithm>
#include <sstream>

#include "identification/read_options.h"
#include "models/foundation/excerpt.h"
#include "tools/suite/command_line.h"
#include "tools/suite/interpreter.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

/// Whether `folder` is, or holds, `path`.
bool IsAround(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// Whether libraries of a Python lie in a folder: lib/python3.12.
bool HoldsPython(const fs::path& folder) {
  std::error_code ignored;
  fs::directory_iterator entries(folder, ignored);
  return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
    return entry.path().filename().string().starts_with("python");
  });
}

/// The folder of an interpreter's own libraries, by its program: a virtual environment, a Conda one, or the
/// libraries of a Python built for itself, as pyenv's; empty where there is none, or where it would open what the wall has
/// to hide.
fs::path EnvironmentOf(const fs::path& program) {
  if (program.parent_path().filename() != "bin") return {};
  const fs::path prefix = program.parent_path().parent_path();
  std::error_code ignored;
  const bool whole =
      fs::exists(prefix / "pyvenv.cfg", ignored) || fs::exists(prefix / "conda-meta", ignored);
  const fs::path libraries = whole ? prefix : prefix / "lib";
  if (!whole && !HoldsPython(libraries)) return {};
  return IsAround(libraries, fs::current_path()) ? fs::path() : libraries;
}

/// The files that a command names.
std::vector<fs::path> FilesOf(const std::vector<std::string>& words) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const std::string& word : words) {
    if (fs::path(word).is_absolute() && fs::is_regular_file(word, ignored)) {
      files.emplace_back(word);
    }
  }
  return files;
}

/// What a command must be able to read: the files that it names, what lies beside the first of them (a
/// script's own modules) unless that is a folder around the current one, and its interpreter's
/// libraries.
std::vector<fs::path> Readable(const std::vector<std::string>& words, const Options& options) {
  std::vector<fs::path> readable = FilesOf(words);
  // what lies beside a script, unless that is around the folder of the run
  std::error_code ignored;
  if (!readable.empty() && options.Text("beside") == "yes") {
    const fs::path beside = readable.front().parent_path();
    if (!IsAround(beside, fs::current_path())) readable.push_back(beside);
  }
  // the program, with the libraries of its environment
  const fs::path program = FindInterpreter(words.front());
  for (const fs::path& path : {program, fs::weakly_canonical(program, ignored)}) {
    if (!path.is_absolute()) continue;
    readable.push_back(path);
    if (const fs::path libraries = EnvironmentOf(path); !libraries.empty()) {
      readable.push_back(libraries);
    }
  }
  // what the suite allows besides
  std::istringstream paths(options.Text("reads"));
  for (std::string path; std::getline(paths, path, ':');) {
    if (!path.empty()) readable.push_back(fs::absolute(path));
  }
  return readable;
}

/// The entry with the files of its command made absolute, before it runs elsewhere.
SuiteIdentifier WithFilesFrom(const fs::path& folder, SuiteIdentifier identifier,
                              const Place& place) {
  std::string& command = identifier.options.at("command");
  command = NeedsShell(identifier)
                ? WithAbsoluteFiles(command, folder)
                : JoinCommand(WithAbsoluteFiles(SplitCommand(command, place), folder));
  return identifier;
}

}  // namespace

const std::vector<OptionInfo>& ExternalOptions() {
  static const std::vector<OptionInfo> options{
      {"command", "", "text", "program and arguments with {recording} and {estimate}"},
      {"shell", "no", "no|yes", "whether the command is a line for /bin/sh"},
      {"time_limit", "60", "number > 0 <= 1000000", "s for each realization"},
      {"memory", "4096", "number > 0 <= 1048576", "MiB of each process"},
      {"reads", "", "text", "files and folders that it may read besides its own, parted by :"},
      {"beside", "yes", "no|yes", "whether it reads what lies beside the first file it names"},
  };
  return options;
}

bool Mentions(const std::string& command, const std::string& text) {
  return command.find(text) != std::string::npos;
}

bool IsExternal(const std::string& argument) {
  return argument.find('=') != std::string::npos &&
         (Mentions(argument, "{recording}") || Mentions(argument, "{recording.h5}"));
}

SuiteIdentifier ReadExternal(const std::string& argument, CommandForm form) {
  const size_t equals = argument.find('=');
  const std::string label = argument.substr(0, equals);
  const Place place{"--identifier " + Excerpt(label)};
  if (label.empty()) Refuse({"--identifier"}, "'{}' lacks its name before '='", Excerpt(argument));
  const std::string command = argument.substr(equals + 1);
  // without both files the command has nothing to read or nothing to write
  if (!Mentions(command, "{estimate}")) {
    Refuse(place, "the command lacks {{estimate}}, the file that it has to write");
  }
  if (!IsExternal(argument)) {
    Refuse(place, "the command lacks {{recording}} or {{recording.h5}}, the file that it gets");
  }
  SuiteIdentifier identifier{kExternal, label, {{"command", command}}, {}};
  if (form == CommandForm::shell) identifier.options["shell"] = "yes";
  return WithFilesFrom("", std::move(identifier), place);
}

SuiteIdentifier WithFilesOfSuite(SuiteIdentifier identifier, const fs::path& suite) {
  if (identifier.name != kExternal || !identifier.options.contains("command")) return identifier;
  const Place place{suite.string()};
  const std::string given = identifier.options.at("command");
  // files of the command are meant from the folder of the suite
  identifier = WithFilesFrom(suite.parent_path(), std::move(identifier), place);
  const std::string& command = identifier.options.at("command");
  // the folder of the suite is not shown: it may hold the truth
  const std::vector<fs::path> files = FilesOf(SplitCommand(command, place));
  if (command == given || files.empty()) return identifier;
  const fs::path beside = files.front().lexically_normal().parent_path();
  if (IsAround(beside, (fs::current_path() / suite).lexically_normal())) {
    identifier.options["beside"] = "no";
  }
  return identifier;
}

bool NeedsShell(const SuiteIdentifier& identifier) {
  const auto shell = identifier.options.find("shell");
  return identifier.name == kExternal && shell != identifier.options.end() &&
         shell->second == "yes";
}

std::vector<fs::path> ReadableBy(const SuiteIdentifier& identifier) {
  const Options options = ReadOptions(ExternalOptions(), identifier.options, {identifier.label});
  const std::vector<std::string> words =
      SplitCommand(options.Text("command"), {Excerpt(identifier.label)});
  if (words.empty()) Refuse({Excerpt(identifier.label)}, "its command is empty");
  return Readable(words, options);
}

}  // namespace warmjoint::inline tools
