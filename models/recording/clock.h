// The clock of a log: what it counts, where it starts again, and rows that are not on it.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "models/recording/units.h"

namespace warmjoint {

/// Notes that a unit may be another one than it was taken for, of which an estimate warns.
void AddDoubt(std::string sentence, Measurements& measurements);

/// Lets a counter go on that starts again after 2^16, 2^24 or 2^32 counts, or after so many thousandths or millionths. Says so;
/// empty where it does not. counts: [N] as they stand in the file, changed in place
std::string UndoRestarts(Eigen::VectorXd& counts);

/// Lets times of day go on behind midnight. time: [N] s, changed in place
void GoOnAtMidnight(Eigen::VectorXd& time);

/// A first and a last row that are not on the clock, as a row of factors or channel numbers below the header: the first is later
/// than the next, or a hundred median steps lie between either and its neighbour.
struct StrayRows {
  bool first = false, last = false;
  std::string note;  // that they are left out; empty where there are none
};
/// time: [N], in any unit
StrayRows FindStrayRows(const Eigen::VectorXd& time);

/// The unit of a time of which nobody says it.
struct AssumedUnit {
  Unit unit;              // s, or what a count since 1970 is in by its size
  bool is_epoch = false;  // a count since 1970: of years from 2010 to 2100 and at most 2 s a sample
  bool is_whole = false;  // all counts are whole numbers
  double first = 0;       // count
};
AssumedUnit AssumeUnit(const Eigen::VectorXd& counts);

/// Throws BadInput, which names the units that may be meant, where steps, speeds, or the path that a logged velocity gives speak
/// against an assumed unit. What stays in doubt is noted. measurements: SI by that unit, before positions are unwrapped
void CheckAssumedUnit(const AssumedUnit& assumed, const Place& place, Measurements& measurements);

}  // namespace warmjoint
