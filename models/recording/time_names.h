// Which columns are the time of a log, by their names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace warmjoint {

/// The column that is called by one of `words` (in small letters, the likeliest first) in any spelling: with a unit, a path, or signs
/// around it, as __time, /header/stamp and Timestamp [ms]. Else two of one path that count seconds and a part of them, as secs and
/// nsecs, header.stamp.sec and header.stamp.nanosec: their sum is the time. Empty where there is neither, or no one knows which of several.
std::vector<std::size_t> FindTime(const std::vector<std::string>& names,
                                  const std::vector<std::string>& words);

/// The last word of a name, which is the unit of the second of two such columns: nanosec of header.stamp.nanosec.
std::string UnitOfPart(const std::string& name);

}  // namespace warmjoint
