#include "identification/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "identification/gravity.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

/// The path of a file relative to the folder of another one; as it is where it is not a regular file.
std::string SeenFrom(const fs::path& file, const fs::path& other) {
  std::error_code ignored;
  if (other.empty() || IsStandardOutput(other) || !fs::is_regular_file(file, ignored)) return file;
  const fs::path relative = fs::relative(file, fs::absolute(other).parent_path(), ignored);
  return relative.empty() ? file : relative;
}

/// The path of a file that another one names: relative to the other's folder, or as it is written, or next to the other. The
/// name as it is written where there is no such file.
std::string Found(const fs::path& name, const fs::path& other) {
  const fs::path folder = other.parent_path();
  for (const fs::path& path : {folder / name, name, folder / name.filename()}) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path;
  }
  return name;
}

/// Names each file of an estimate's recording as `name` does. own: the estimate's own file
void NameFiles(std::string (*name)(const fs::path& file, const fs::path& own), const fs::path& own,
               Estimate& estimate) {
  if (!estimate.recording) return;
  for (std::string& file : estimate.recording->files) file = name(file, own);
  auto& project = estimate.recording->project;
  if (project) project->file = name(project->file, own);
}

}  // namespace

const EstimatedParameter* Estimate::Find(std::string_view name) const {
  const auto found = std::ranges::find(parameters, name, &EstimatedParameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

std::string Estimate::FullMessage() const {
  std::string full = message;
  for (const std::string& warning : warnings) full += (full.empty() ? "" : "; ") + warning;
  return full;
}

void Estimate::TakeMessage(const std::string& full) {
  message = full;
  // the last warning first, each with its separator; others may warn without repeating themselves
  for (auto warning = warnings.rbegin(); warning != warnings.rend(); ++warning) {
    if (!message.ends_with(*warning)) return;
    message.resize(message.size() - warning->size());
    if (message.ends_with("; ")) message.resize(message.size() - 2);
  }
}

Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters) {
  if (measured.size() != fitted.size() || measured.size() == 0) {
    Refuse({"metrics"}, "are asked of {} measured and {} fitted values; give as many, at least one",
           measured.size(), fitted.size());
  }
  const double n = static_cast<double>(measured.size());
  // the residual, and what a constant torque would leave
  const Eigen::VectorXd error = measured - fitted;
  const double mean_square = error.squaredNorm() / n;
  const double spread = (measured.array() - measured.mean()).matrix().norm();

  Metrics metrics;
  metrics.n = static_cast<int>(measured.size());
  metrics.parameters = parameters;
  metrics.effective_parameters = effective_parameters;
  metrics.rmse = std::sqrt(mean_square);
  metrics.mae = error.cwiseAbs().mean();
  // neither a constant torque has a share to explain, nor a fit with no sample to spare an error to predict
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  metrics.fit = spread > 0 ? 100 * (1 - error.norm() / spread) : none;
  metrics.fpe = parameters < n ? mean_square * (1 + parameters / n) / (1 - parameters / n) : none;
  return metrics;
}

Tree EstimateToTree(Estimate estimate, const fs::path& target) {
  NameFiles(&SeenFrom, target, estimate);
  return WriteFields(std::move(estimate));
}

Estimate EstimateFrom(const Node& node) {
  Estimate estimate = ReadAs<Estimate>(node.With(UnknownKeys::ignored));
  NameFiles(&Found, node.file(), estimate);
  return estimate;
}

std::string EstimateToJson(const Estimate& estimate, const fs::path& target) {
  return EstimateToTree(estimate, target).dump(2) + "\n";
}

Estimate EstimateFromJson(const std::string& text, const std::string& name) {
  return EstimateFrom(ParseJsonNode(text, name));
}

Estimate ReadEstimate(const fs::path& file) { return EstimateFrom(ReadJsonNode(file)); }

void WriteEstimate(const Estimate& estimate, const fs::path& file) {
  WriteWholeFile(file, EstimateToJson(estimate, file));
}

}  // namespace warmjoint
