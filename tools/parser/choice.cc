#include "tools/parser/choice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline tools {
namespace {

/// The long name of an option, by which messages call it.
std::string LongName(const std::string& names) {
  const size_t comma = names.rfind(',');
  return comma == std::string::npos ? names : names.substr(comma + 1);
}

}  // namespace

void CheckChoice(const std::string& what, const std::string& value,
                 const std::vector<std::string>& choices, const Synonyms& synonyms) {
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
  // what other fields call it leads to the word that is meant here
  const auto synonym = synonyms.find(value);
  if (synonym != synonyms.end()) {
    Refuse({what}, "is '{}'; warmjoint says '{}'", value, synonym->second);
  }
  Refuse({what}, "is '{}'{}", Excerpt(value), Suggestion(value, choices));
}

CLI::Option* AddChoice(CLI::App& parser, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices, const std::string& description,
                       const Synonyms& synonyms) {
  // the parser hands each text over, so that refusals are ours
  const auto read = [&value, what = LongName(name), choices, synonyms](const std::string& given) {
    CheckChoice(what, given, choices, synonyms);
    value = given;
  };
  CLI::Option* option = parser.add_option_function<std::string>(name, read, description);

  // help shows the choices as the form of the value
  option->type_name(fmt::format("{}", fmt::join(choices, "|")));
  return value.empty() ? option : option->default_str(value);
}

CLI::Option* AddNumber(CLI::App& parser, const std::string& name, double& number,
                       const Bounds& bounds, const std::string& description) {
  const auto read = [&number, what = LongName(name), bounds](const std::string& text) {
    // NaN fails every comparison, and infinity is no finite number
    const auto given = ParseNumber(text);
    const bool above = given && (bounds.open ? *given > bounds.lowest : *given >= bounds.lowest);
    if (!given || !std::isfinite(*given) || !above || *given > bounds.highest) {
      Refuse({what}, "is '{}'; it must be a number {}", Excerpt(text), bounds.words);
    }
    number = *given;
  };
  return parser.add_option_function<std::string>(name, read, description)->type_name("NUMBER");
}

}  // namespace warmjoint::inline tools
