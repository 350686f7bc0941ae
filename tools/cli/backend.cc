#include "tools/cli/backend.h"

#include <fmt/format.h>
#include <warmjoint/errors.h>

#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "models/robots/robot_folder.h"
#include "tools/cli/python_child.h"

namespace warmjoint {
namespace fs = std::filesystem;
namespace {

/// The first line of an answer, which says what follows. Throws BadInput for a refusal.
Tree HeadOf(const std::string& answer) {
  Tree head = Tree::parse(answer.substr(0, answer.find('\n')));
  if (!head.contains("refusal")) return head;
  Refuse({head["refusal"]["place"].get<std::string>()}, "{}",
         head["refusal"]["why"].get<std::string>());
}

}  // namespace

PictureFormat PictureFormatOf(const std::string& path) {
  const std::string end = fs::path(path).extension().string();
  for (const Word<PictureFormat>& word : WordsOf(PictureFormat{})) {
    if (end == "." + std::string(word.name)) return word.value;
  }
  Refuse({path}, "pictures end in .png, .svg or .pdf, not in '{}'", end);
}

Backend::Backend() : folder_(DataFolder() / "tools/python/warmjoint/figures") {
  const std::vector<std::string> candidates = Pythons();
  // looked for and not imported, which would take half a second
  const char* const has =
      "import importlib.util as u, sys; sys.exit(not all(map(u.find_spec, ('matplotlib', "
      "'jinja2'))))";
  for (const std::string& python : candidates) {
    if (!CallPython({python, "-c", has}, "").well) continue;
    python_ = python;
    return;
  }
  throw OutputFailed(fmt::format(
      "pictures need Python with matplotlib and Jinja2, which {} has not: sudo apt install "
      "python3-matplotlib python3-jinja2",
      fmt::join(candidates, " or ")));
}

std::string Backend::Ask(const shown::ShownData& request) const {
  const Ended ended = CallPython({python_, "-B", folder_.string()}, shown::Packed(request));
  if (ended.well) return ended.out;
  throw OutputFailed(fmt::format("{} {} {}", python_, folder_.string(), ReasonOf(ended)));
}

Drawn Backend::Draw(DrawRequest request, const PictureSetting& setting) const {
  if (request.sources.empty()) return {};
  request.data.facts = {{"sources", std::move(request.sources)},
                        {"setting", WriteFields(setting)},
                        {"figures", request.figures},
                        {"data", request.with_data}};
  const std::string answer = Ask(request.data);
  // what the files are; then their bytes
  std::size_t at = answer.find('\n') + 1;
  const Tree head = HeadOf(answer);
  Drawn drawn;
  drawn.left_out = head.at("left_out").get<std::vector<std::string>>();
  for (const Tree& file : head.at("files")) {
    const auto size = file.at("size").get<std::size_t>();
    drawn.files.push_back({file.at("source"), file.at("name"), file.at("finding"),
                           answer.substr(at, size), file.at("is_data")});
    at += size;
  }
  return drawn;
}

std::string Backend::FillPage(const std::string& page, shown::ShownData data) const {
  data.facts = {{"page", page}, {"content", std::move(data.facts)}};
  const std::string answer = Ask(data);
  HeadOf(answer);
  return answer.substr(answer.find('\n') + 1);
}

std::string PictureFor(const std::string& path, const Backend& backend, DrawRequest request) {
  PictureSetting setting;
  setting.format = PictureFormatOf(path);
  return backend.Draw(std::move(request), setting).files.at(0).bytes;
}

}  // namespace warmjoint
