// Recordings as tables of text, with --map, --unit, --columns, --rate, --joint and --gear: a first line
// "#: torque=force_N position:deg ,time,position,torque 50Hz linear 2" gives the layout, and is a comment for the reader itself.
#include <warmjoint/prepared_log.h>

#include <sstream>

#include "models/foundation/parse_number.h"
#include "models/recording/read_recording.h"
#include "models/recording/table_format.h"
#include "tests/fuzz/logs.h"

namespace {

using namespace warmjoint;
using fuzz::Require;
using fuzz::RequireSoundness;

ReadSettings LayoutOf(std::string_view bytes) {
  ReadSettings layout;
  std::istringstream words{std::string(fuzz::TakeLine(bytes))};
  std::string word;
  if (!(words >> word) || word != "#:") return layout;
  while (words >> word) {
    const std::size_t mark = word.find_first_of("=:");
    if (word == "linear") {
      layout.joint = JointKind::linear;
    } else if (word == "50Hz") {
      layout.rate = 50;
    } else if (word[0] == ',') {
      std::vector<std::string_view> names;
      SplitLine(std::string_view(word).substr(1), ',', names);
      layout.columns.assign(names.begin(), names.end());
    } else if (mark != std::string::npos) {
      auto& pairs = word[mark] == '=' ? layout.map : layout.unit;
      pairs[word.substr(0, mark)] = word.substr(mark + 1);
    } else if (const auto gear = ParseNumber(word); gear && std::isfinite(*gear) && *gear != 0) {
      layout.gear = *gear;
    }
  }
  return layout;
}

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  const Measurements log = ParseCsv(bytes, "fuzz.csv", LayoutOf(bytes));
  RequireSoundness(log);
  Require(log.torque.maxCoeff() > log.torque.minCoeff());
  Require(!CheckToText(CheckRecording(log)).empty());
}
