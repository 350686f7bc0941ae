// A log in fewer rows, for comparing structures.
#pragma once

#include <warmjoint/prepared_log.h>

#include <vector>

namespace warmjoint {

struct CondensedLog {
  LogView view;
  std::vector<Eigen::Index> first;  // [rows + 1] first sample of each row, and N
};

/// Means over neighbouring samples that are alike: kept or not, of one segment where segments are
/// known, moving in one direction, of one recording, without a gap between them. As many of them make
/// a row as leave about `rows` rows of the kept samples, but no more than move the joint by a 48th of
/// its travel, and the motor by a 24th of its turn where the log has its angle, so that ripple stays. A row
/// has the mean time of its samples, so that heat, which is slow, comes out the same; gaps are
/// those between samples, not between rows. The log itself where one sample makes a row.
CondensedLog Condense(const LogView& all, Eigen::Index rows);

}  // namespace warmjoint
