// Commands that are recommended: an identifier and its options, and the words before them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warmjoint {

/// --identifier NAME --set KEY=VALUE ...
struct IdentifyCommand {
  std::string identifier;
  std::vector<std::pair<std::string, std::string>> settings{};

  /// With one setting more.
  IdentifyCommand With(std::string_view key, std::string_view value) const;
  bool Sets(std::string_view key) const;
  /// "NAME --set KEY=VALUE ...", as it follows --identifier.
  std::string Text() const;
};

/// A remedy: words, or words and the command that follows them.
struct Remedy {
  std::string words;
  std::optional<IdentifyCommand> command{};

  /// "words try --identifier NAME ..."
  std::string Text() const;
};

/// Whether a law has a Coulomb level for each direction of motion.
bool HasLevelForEachDirection(std::string_view law);

/// A law with a curve, for friction that falls with speed in a way that a linear one cannot follow: with a level for each
/// direction where `law`, a fit's, has two, and the warming that is asked for. warming: none or estimated.
IdentifyCommand CurveCommand(std::string_view law, std::string_view warming);

/// An identifier of linear laws, with a level for each direction where `law` has two.
IdentifyCommand LinearCommand(std::string_view identifier, std::string_view law);

}  // namespace warmjoint
