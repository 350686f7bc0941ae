#include "tools/cluster/slurm.h"

#include <sstream>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "tools/cluster/child.h"

namespace warmjoint::inline tools {
namespace {

constexpr int kDefaultArraySize = 1001;
constexpr int kNoStart = 127;

std::string Complaint(const Captured& answer) {
  if (answer.status == kNoStart) return "there is no such program on this machine";
  return Excerpt(answer.err.empty() ? answer.out : answer.err, kLongestComplaint);
}

}  // namespace

bool HasSlurm() { return Capture({"sinfo", "-h", "-o", "%P"}).status == 0; }

int MostIndices() {
  // the line "MaxArraySize = 1001"
  const Captured answer = Capture({"scontrol", "show", "config"});
  std::istringstream lines(answer.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, equals, value;
    words >> key >> equals >> value;
    const auto size = ParseInteger(value);
    if (key == "MaxArraySize" && size && *size > 1) return static_cast<int>(*size);
  }
  return kDefaultArraySize;
}

std::string Sbatch(const std::vector<std::string>& arguments) {
  // --parsable: the answer is the job number alone
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Captured answer = Capture(command);
  if (answer.status != 0) Refuse({"sbatch"}, "{}", Complaint(answer));
  // JOB or JOB;CLUSTER
  const std::string job = answer.out.substr(0, answer.out.find_first_of(";\n"));
  if (!ParseInteger(job)) {
    Refuse({"sbatch"}, "answered '{}', which is not a job number", Excerpt(answer.out));
  }
  return job;
}

std::optional<std::vector<QueuedTask>> AskQueue() {
  // one line for each task: its array job, its index and its state
  const Captured answer = Capture({"squeue", "-h", "-r", "--me", "-o", "%F %K %T"});
  if (answer.status != 0) return std::nullopt;
  std::vector<QueuedTask> tasks;
  std::istringstream lines(answer.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string job, index, state;
    words >> job >> index >> state;
    // N/A is the index of a job without an array. All that has started counts as running, COMPLETING too: such a task
    // may still be writing, and is lost only once it has left the queue
    const auto number = ParseInteger(index);
    tasks.push_back({job, number ? static_cast<int>(*number) : -1, state != "PENDING"});
  }
  return tasks;
}

void Scancel(const std::vector<std::string>& jobs) {
  std::vector<std::string> command{"scancel", "-Q"};
  command.insert(command.end(), jobs.begin(), jobs.end());
  const Captured answer = Capture(command);
  if (answer.status != 0) Refuse({"scancel"}, "{}", Complaint(answer));
}

}  // namespace warmjoint::inline tools
