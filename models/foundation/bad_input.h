// Refusal of input that cannot be used, and of output that cannot be written: the exceptions that users meet.
#pragma once

#include <fmt/format.h>
#include <warmjoint/errors.h>

#include <string>
#include <utility>

namespace warmjoint {

/// Where a refused value stands: a file and, where it has one, its line (counted from 1; 0: none).
struct Place {
  std::string file;
  int line = 0;
};

/// Throws BadInput with "file:line: " before the formatted message.
template <typename... Args>
[[noreturn]] void Refuse(const Place& place, fmt::format_string<Args...> format, Args&&... args) {
  std::string where = place.file;
  if (place.line > 0) where += fmt::format(":{}", place.line);
  if (!where.empty()) where += ": ";
  throw BadInput(where + fmt::format(format, std::forward<Args>(args)...));
}

/// Throws OutputFailed: "target: output could not be written: ...". error: an errno.
[[noreturn]] void FailOutput(const std::string& target, int error);

}  // namespace warmjoint
