#include "tools/cli/whole_number.h"

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline tools {

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

}  // namespace warmjoint::inline tools
