// Text inside XML attributes.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint::inline sim {

/// The text with &, <, > and " written as entities.
inline std::string EscapeXml(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace warmjoint::inline sim
