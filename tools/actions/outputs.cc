#include "tools/actions/outputs.h"

#include <algorithm>
#include <memory>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

/// Whether both names lead to one file, now or once it is made.
bool AreOne(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  if (IsStandardOutput(a) || IsStandardOutput(b)) return IsStandardOutput(a) && IsStandardOutput(b);
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

/// Whether `path`, which is there, lies in a folder that is an input.
bool LiesIn(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  if (path.empty() || !fs::is_directory(folder, ignored) || !fs::exists(path, ignored))
    return false;
  const fs::path relative =
      fs::weakly_canonical(path, ignored).lexically_relative(fs::weakly_canonical(folder, ignored));
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::FILE* WordsBeside(const std::vector<fs::path>& outputs) {
  return std::ranges::any_of(outputs, IsStandardOutput) ? stderr : stdout;
}

void KeepApart(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    // an output that is an input would destroy it
    for (const fs::path& input : inputs) {
      if (IsStandardInput(input)) continue;
      if (!AreOne(*output, input) && !LiesIn(*output, input)) continue;
      Refuse({output->string()}, "is an input too, which would be lost; choose another output");
    }
    // two outputs in one file would destroy each other
    for (auto other = outputs.begin(); other != output; ++other) {
      if (!AreOne(*output, *other)) continue;
      Refuse({output->string()}, "is given for two outputs; choose another name for one of them");
    }
  }
}

Outputs::Outputs(std::vector<fs::path> targets, std::vector<fs::path> inputs)
    : targets_(std::move(targets)), inputs_(std::move(inputs)) {
  std::erase_if(targets_, [](const fs::path& target) { return target.empty(); });
  KeepApart(targets_, inputs_);
  // refuses a target whose folder cannot be written to, or that is no regular file
  for (const fs::path& target : targets_) AtomicFile{target};
}

void Outputs::AddInputs(const std::vector<fs::path>& inputs) {
  KeepApart(targets_, inputs);
  inputs_.insert(inputs_.end(), inputs.begin(), inputs.end());
}

void Outputs::Add(const fs::path& target, std::string bytes) {
  if (target.empty()) return;
  if (std::ranges::find(targets_, target) == targets_.end()) {
    targets_.push_back(target);
    KeepApart(targets_, inputs_);
  }
  made_.emplace_back(target, std::move(bytes));
}

void Outputs::Write() {
  std::vector<std::unique_ptr<AtomicFile>> files;
  for (const auto& [target, bytes] : made_) {
    if (target.has_parent_path()) fs::create_directories(target.parent_path());
    files.push_back(std::make_unique<AtomicFile>(target));
    files.back()->Write(bytes);
  }
  for (const std::unique_ptr<AtomicFile>& file : files) file->Commit();
}

}  // namespace warmjoint
