// An identifier as a suite names it, and what is claimed of it.
#pragma once

#include <warmjoint/claim.h>

#include <map>
#include <optional>
#include <string>

namespace warmjoint {

/// Name under which a suite holds an identifier that is a command of its own; the command is the
/// option of that name. An entry {name: mine, command: ...} is the same with the label mine.
inline constexpr const char* kExternal = "external";

/// An identifier as a suite runs it.
struct SuiteIdentifier {
  std::string name;
  std::string label;
  std::map<std::string, std::string> options;
  std::optional<Claim> claim;

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name,
             {.meaning = "one of `warmjoint list identifiers`",
              .needed = "name an identifier (`list identifiers`)"});
    if (label.empty()) label = name;
    a->Field("label", &label, {.meaning = "its row of the leaderboard; the name where not given"});
    a->Field("options", &options, LeftOut("as `--set` of `identify`"));
    a->Field("claim", &claim, {.meaning = "what others claim, printed with what was reached"});
    // a command of the user's stands in the place of an identifier of the list
    std::string command;
    a->Field("command", &command,
             LeftOut("an identifier of your own under that name, carried out with `run "
                     "--allow-commands` alone; files stand relative to the suite"));
    a->Check(command.empty() || !options.contains("command"), "command",
             "absent: it stands in options too");
    if (command.empty()) return;
    name = kExternal;
    options["command"] = command;
  }

  bool operator==(const SuiteIdentifier&) const = default;
};

}  // namespace warmjoint
