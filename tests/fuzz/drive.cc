// The fuzz targets without Clang: every file of the given folders as it is, then changed by chance.
//   fuzz_NAME [--mutations N] [--seconds N] [--seed N] [--dictionary FILE] [--found FILE] FILE|FOLDER...
// N changed inputs of each file, or as many as N seconds allow. The same files, N and seed give the same inputs. What breaks
// the reader, or keeps it for a minute, is written to the FILE of --found.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/random_stream.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;
namespace fs = std::filesystem;

constexpr unsigned kPatience = 60;  // s for one input, after which the process is killed

struct Inputs {
  std::vector<fs::path> files;
  std::vector<std::string> bytes;   // of each file
  std::vector<std::string> tokens;  // that the reader knows
};

const std::string* current = nullptr;  // the input that the reader has
const char* found = nullptr;           // the file for one that breaks it

/// Writes the input by system calls alone, and ends as without this.
void Keep(int signal) {
  const int file = found && current ? open(found, O_WRONLY | O_CREAT | O_TRUNC, 0644) : -1;
  if (file >= 0 && write(file, current->data(), current->size()) >= 0) close(file);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

void Feed(const std::string& bytes) {
  current = &bytes;
  alarm(kPatience);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// The tokens of a dictionary as libFuzzer has them: one "..." a line, \xHH for bytes.
std::vector<std::string> ReadDictionary(const fs::path& path) {
  std::vector<std::string> tokens;
  const std::string text = ReadWholeFile(path);
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = fuzz::TakeLine(rest);
    if (line.size() < 2 || line.front() != '"' || line.back() != '"') continue;
    std::string token;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (line[i] == '\\' && line[i + 1] == 'x' && i + 4 < line.size()) {
        token += static_cast<char>(std::stoi(std::string(line.substr(i + 2, 2)), nullptr, 16));
        i += 3;
      } else {
        token += line[i] == '\\' ? line[++i] : line[i];
      }
    }
    tokens.push_back(token);
  }
  return tokens;
}

/// One change: a byte, a deletion, a repetition, a token, or a piece of another input.
std::string Mutated(std::string bytes, const Inputs& inputs, RandomStream& random) {
  const std::size_t at = random.Below(bytes.size() + 1);
  const std::size_t length = random.Below(20);
  switch (random.Below(5)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(random.Below(256));
      return bytes;
    case 1:
      return bytes.erase(at, length);
    case 2:
      return bytes.insert(at, bytes.substr(at, length));
    case 3: {
      const std::string& other = inputs.bytes[random.Below(inputs.bytes.size())];
      return bytes.insert(at, other.substr(random.Below(other.size() + 1), length));
    }
    default:
      if (inputs.tokens.empty()) return bytes;
      return bytes.insert(at, inputs.tokens[random.Below(inputs.tokens.size())]);
  }
}

std::string MutatedSome(const std::string& seed, const Inputs& inputs, RandomStream& random) {
  std::string bytes = seed;
  for (std::uint64_t changes = 1 + random.Below(4); changes > 0; --changes) {
    bytes = Mutated(std::move(bytes), inputs, random);
  }
  return bytes;
}

void AddFiles(const fs::path& path, Inputs& inputs) {
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::directory_iterator(path)) inputs.files.push_back(entry.path());
  } else {
    inputs.files.push_back(path);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Inputs inputs;
  std::uint64_t mutations = 0, seconds = 0, seed = 11;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool has_value = i + 1 < argc;
    if (argument == "--mutations" && has_value) {
      mutations = std::stoull(argv[++i]);
    } else if (argument == "--seconds" && has_value) {
      seconds = std::stoull(argv[++i]);
    } else if (argument == "--seed" && has_value) {
      seed = std::stoull(argv[++i]);
    } else if (argument == "--dictionary" && has_value) {
      inputs.tokens = ReadDictionary(argv[++i]);
    } else if (argument == "--found" && has_value) {
      found = argv[++i];
    } else {
      AddFiles(argument, inputs);
    }
  }
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGALRM}) std::signal(signal, Keep);
  std::sort(inputs.files.begin(), inputs.files.end());
  if (inputs.files.empty()) {
    fmt::print(stderr, "no inputs were found\n");
    return 2;
  }

  // as they are; the name is out before the input is in, so that a crash has a name
  for (const fs::path& file : inputs.files) {
    fmt::print("{}\n", file.string());
    std::fflush(stdout);
    inputs.bytes.push_back(ReadWholeFile(file));
    Feed(inputs.bytes.back());
  }

  // changed, round after round over all files
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  RandomStream random({seed, 0}, Stream::test);
  std::uint64_t round = 0, executions = inputs.files.size();
  for (; round < mutations || std::chrono::steady_clock::now() < end; ++round) {
    for (std::size_t i = 0; i < inputs.files.size(); ++i, ++executions) {
      Feed(MutatedSome(inputs.bytes[i], inputs, random));
    }
  }
  alarm(0);
  fmt::print("{} inputs from {} files\n", executions, inputs.files.size());
  return 0;
}
