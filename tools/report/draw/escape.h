// Words inside markup.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint::report {

/// Text with the characters that HTML and XML read as their own replaced: & < > " '.
std::string Escape(std::string_view text);

}  // namespace warmjoint::report
