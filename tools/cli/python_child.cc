#include "tools/cli/python_child.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "models/foundation/excerpt.h"
#include "tools/suite/run_command.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {

namespace {

constexpr int kNoStart = 127;  // exit status, as shells have it

/// All that a child needs between fork and exec, where nothing may be allocated.
struct Start {
  int files[3];
  char* const* arguments;
  char* const* environment;
  ChildLimits limits;
  pid_t parent;
};

/// This process's variables. Python adds neither the working folder nor a script's to its path, and what PYTHONPATH names by a
/// relative path, or by none, is in the working folder.
std::vector<std::string> Environment() {
  constexpr std::string_view path = "PYTHONPATH=";
  std::vector<std::string> environment{"PYTHONSAFEPATH=1"};
  for (char** variable = environ; *variable; ++variable) {
    std::string_view given = *variable;
    if (given.starts_with("PYTHONSAFEPATH=") || given.starts_with("PYTHONINSPECT=")) continue;
    if (!given.starts_with(path)) {
      environment.emplace_back(given);
      continue;
    }
    std::string kept;
    for (given.remove_prefix(path.size()); !given.empty();) {
      const std::string_view entry = given.substr(0, given.find(':'));
      if (entry.starts_with('/')) kept += (kept.empty() ? "" : ":") + std::string(entry);
      given.remove_prefix(std::min(entry.size() + 1, given.size()));
    }
    if (!kept.empty()) environment.push_back(std::string(path) + kept);
  }
  return environment;
}

void Limit(__rlimit_resource resource, rlim_t value) {
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = limit.rlim_max = std::min(value, limit.rlim_max);
  setrlimit(resource, &limit);
}

/// The child itself, from fork to exec.
[[noreturn]] void Become(const Start& start) noexcept {
  // it ends with its parent, which may have ended already
  prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  if (getppid() != start.parent) _exit(kNoStart);
  for (int i = 0; i < 3; ++i) dup2(start.files[i], i);
  for (const int ignored : {SIGPIPE, SIGXFSZ}) signal(ignored, SIG_DFL);
  Limit(RLIMIT_CPU, start.limits.seconds);
  Limit(RLIMIT_AS, start.limits.memory);
  Limit(RLIMIT_CORE, 0);
  alarm(start.limits.seconds);
  execve(start.arguments[0], start.arguments, start.environment);
  _exit(kNoStart);
}

}  // namespace

std::vector<std::string> Pythons() {
  if (const char* named = std::getenv("WARMJOINT_PYTHON"); named && *named) return {named};
  return {"python3", "/usr/bin/python3"};
}

Ended CallPython(std::vector<std::string> words, std::string_view input,
                 const ChildLimits& limits) {
  // three files in memory in place of pipes, which could wait for each other
  MemoryFile in("input"), out("output"), err("error");
  in.Fill(input);
  words.front() = FindProgram(words.front());
  std::vector<std::string> variables = Environment();
  const std::vector<char*> arguments = ExecWords(words), environment = ExecWords(variables);
  const Start start{.files = {in.descriptor(), out.descriptor(), err.descriptor()},
                    .arguments = arguments.data(),
                    .environment = environment.data(),
                    .limits = limits,
                    .parent = getpid()};

  const pid_t child = fork();
  if (child == 0) Become(start);
  if (child < 0) return {};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return {.ran = !(WIFEXITED(status) && WEXITSTATUS(status) == kNoStart),
          .well = WIFEXITED(status) && WEXITSTATUS(status) == 0,
          .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
          .out = out.Tail(),
          .err = err.Tail()};
}

std::string ReasonOf(const Ended& ended) {
  if (ended.signal == SIGALRM || ended.signal == SIGXCPU || ended.signal == SIGKILL) {
    return "takes too long; the file is damaged, or too large: take a part of it";
  }
  if (ended.signal != 0) return fmt::format("crashed (signal {})", ended.signal);
  if (ended.err.find("MemoryError") != std::string::npos ||
      ended.err.find("std::bad_alloc") != std::string::npos) {
    return "needs more memory than it may take; take a part of the file";
  }
  const std::string last = LastLine(ended.err);
  return last.empty() ? "broke off without a word" : "failed: " + Excerpt(last, kLongestComplaint);
}

std::string LastLine(std::string text) {
  text.erase(text.find_last_not_of(" \n") + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace warmjoint
