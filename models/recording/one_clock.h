// What is made of clocks: columns sampled at times of their own are put on one, episodes are parted, rows without a clock are holds.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/recording/assemble.h"

namespace warmjoint {

/// Whether a header gives columns clocks of their own, as exports of instruments do: it begins with a clock, no two clocks are
/// neighbours, none stands last, and either all are called alike ("Name;position;Name;torque") or none is our `time`
/// ("Time - a,position,Time - b,torque").
bool HasSeveralClocks(const std::vector<std::string>& names);

/// Puts every column on the clock of the first, as far as all clocks reach: straight lines between samples, none across a gap. The
/// first clock becomes `time`. Columns without two numbers are left out, and a note says so.
FileContent OnOneClock(FileContent content);

/// Puts position, velocity and what else is there on the rows that hold a torque, where most of those rows lack the rest: tables in
/// which each message has a row. Straight lines between samples, none across a gap or a sensor that starts again. An optional column
/// with less than half as many numbers as the torque stays as it is, but a temperature is slow.
void JoinRows(RawColumns& raw);

/// The episodes of a file: where the clock falls back to its start and a column counts episodes, trials, demonstrations or rollouts, each
/// part is a recording. columns: all of the file. One part where this does not hold.
std::vector<RawColumns> Episodes(RawColumns raw, const std::vector<FileColumn>& columns);

/// Makes each row of a table of speeds and torques a hold. Throws BadInput for more than a thousand rows, which are samples.
void MakeHolds(RawColumns& raw);

}  // namespace warmjoint
