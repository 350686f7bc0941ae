// Slurm's own commands.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// One task in Slurm's queue.
struct QueuedTask {
  std::string job;  // of the array
  int index = 0;    // in the array
  bool running = false;
};

/// Whether there is a Slurm that answers.
bool HasSlurm();

/// The cluster's MaxArraySize; 1001, its default, where nobody can be asked.
int MostIndices();

/// Submits a script; its job number. Throws BadInput with sbatch's own words where it refuses.
std::string Sbatch(const std::vector<std::string>& arguments);

/// This user's tasks that wait or run; nothing where nobody can be asked.
std::optional<std::vector<QueuedTask>> AskQueue();

/// Cancels jobs; those that are over already are no failure. Throws BadInput where scancel fails.
void Scancel(const std::vector<std::string>& jobs);

}  // namespace warmjoint::inline tools
