#include "tools/cli/backend.h"

#include <fmt/format.h>
#include <warmjoint/errors.h>

#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/robots/robot_folder.h"
#include "tools/cli/python_child.h"

namespace warmjoint {
namespace fs = std::filesystem;

PictureFormat PictureFormatOf(const std::string& path) {
  const std::string end = fs::path(path).extension().string();
  for (const Word<PictureFormat>& word : WordsOf(PictureFormat{})) {
    if (end == "." + std::string(word.name)) return word.value;
  }
  Refuse({path}, "pictures end in .png, .svg or .pdf, not in '{}'", end);
}

Backend::Backend() : script_(DataFolder() / "tools/python/warmjoint/draw.py") {
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

std::string Backend::Ask(const Tree& request) const {
  const Ended ended = CallPython({python_, "-B", script_.string()}, request.dump());
  if (!ended.well) {
    throw OutputFailed(
        fmt::format("{} {} failed: {}", python_, script_.string(), LastLine(ended.err)));
  }
  return ended.out;
}

std::vector<DrawnFigure> Backend::Draw(const std::vector<figures::Figure>& figures,
                                       const PictureSetting& setting) const {
  std::vector<DrawnFigure> drawn;
  if (figures.empty()) return drawn;
  Tree list = Tree::array();
  for (const figures::Figure& figure : figures) list.push_back(figures::FigureJson(figure));
  const std::string answer = Ask({{"figures", std::move(list)}, {"setting", WriteFields(setting)}});

  // one line with the sizes of the files, or refusals; then their bytes
  std::size_t at = answer.find('\n');
  const Tree heads = Tree::parse(answer.substr(0, at++));
  for (const Tree& head : heads) {
    const auto size = head.at("size").get<std::size_t>();
    drawn.push_back({answer.substr(at, size), head.value("refusal", "")});
    at += size;
  }
  return drawn;
}

std::string Backend::FillPage(const std::string& page, const Tree& data) const {
  return Ask({{"page", page}, {"data", data}});
}

void WritePicture(const Backend& backend, const figures::Figure& figure, const std::string& path) {
  PictureSetting setting;
  setting.format = PictureFormatOf(path);
  const DrawnFigure drawn = backend.Draw({figure}, setting).front();
  if (!drawn.refusal.empty()) throw OutputFailed(path + ": " + drawn.refusal);
  WriteWholeFile(path, drawn.bytes);
}

}  // namespace warmjoint
