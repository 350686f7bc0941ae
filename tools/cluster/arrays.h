// Shards as job arrays of a size that the cluster takes.
#pragma once

#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// One array: index i stands for shard offset + i + 1.
struct JobArray {
  int offset = 0;
  std::string indices;      // "0-999" or "3,7-9%4", as sbatch --array takes them
  std::vector<int> shards;  // numbers, ascending
};

/// Arrays for the shards with these numbers (from 1, ascending), with all indices below `most_indices`:
/// Slurm's MaxArraySize bounds the index, not the count. parallelism: tasks at a time of all arrays
/// together, parted evenly; 0: no bound.
std::vector<JobArray> ArraysOf(const std::vector<int>& shards, int most_indices, int parallelism);

/// "1-3, 7" of 1, 2, 3, 7. comma: what parts them.
std::string Ranges(const std::vector<int>& ascending, const char* comma = ", ");

}  // namespace warmjoint::inline tools
