#include "tools/cli/typed_options.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {

void GiveExample(CLI::App& parser, const std::string& command) { parser.footer(command); }

void BeginGroup(CLI::App& parser, const std::string& heading) {
  parser.option_defaults()->group(heading);
}

CLI::Option* AddChoice(CLI::App& parser, const std::string& name,
                       const std::function<void(const std::string& choice)>& take,
                       const std::vector<std::string>& choices, const std::string& description,
                       const std::map<std::string, std::string>& synonyms) {
  // the parser hands each text over, so that refusals name the nearest choice
  const auto read = [take, name, choices, synonyms](const std::string& given) {
    if (std::ranges::find(choices, given) != choices.end()) return take(given);
    const auto synonym = synonyms.find(given);
    if (synonym != synonyms.end()) {
      Refuse({name}, "is '{}'; warmjoint says '{}'", given, synonym->second);
    }
    Refuse({name}, "is '{}'{}", Excerpt(given), Suggestion(given, choices));
  };
  return parser.add_option_function<std::string>(name, read, description)
      ->type_name(fmt::format("{}", fmt::join(choices, "|")));
}

CLI::Option* AddChoice(CLI::App& parser, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices, const std::string& description) {
  const auto take = [&value](const std::string& choice) { value = choice; };
  CLI::Option* option = AddChoice(parser, name, take, choices, description);
  return value.empty() ? option : option->default_str(value);
}

CLI::Option* AddNumber(CLI::App& parser, const std::string& name, double& number,
                       const NumberRange& bounds, const std::string& description) {
  const auto read = [&number, name, bounds](const std::string& text) {
    const auto given = ParseFinite(text);
    if (!given || *given < bounds.lowest || *given > bounds.highest) {
      Refuse({name}, "is '{}'; it must be a number {}", Excerpt(text), bounds.words);
    }
    number = *given;
  };
  return parser.add_option_function<std::string>(name, read, description)->type_name("NUMBER");
}

CLI::Option* AddWholeNumber(CLI::App& parser, const std::string& name,
                            std::optional<std::uint64_t>& number, std::uint64_t lowest,
                            std::uint64_t highest, const std::string& description) {
  // digits alone: a sign is refused, not wrapped round
  const auto read = [&number, name, lowest, highest](const std::string& text) {
    number = ParseUnsigned(text);
    if (number && lowest <= *number && *number <= highest) return;
    Refuse({name}, "is '{}'; it must be a whole number from {} to {}", Excerpt(text), lowest,
           highest);
  };
  return parser.add_option_function<std::string>(name, read, description)->type_name("INTEGER");
}

}  // namespace warmjoint
