#include "tools/cli/backend.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <warmjoint/errors.h>

#include <cerrno>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/robots/robot_folder.h"
#include "tools/suite/run_command.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

/// How a child ended, and what it wrote.
struct Ended {
  bool well = false;
  std::string out;
  std::string err;
};

Ended Call(std::vector<std::string> words, std::string_view input) {
  // three files in memory in place of pipes, which could wait for each other
  MemoryFile in("picture"), out("picture"), err("picture");
  in.Fill(input);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const int files[] = {in.descriptor(), out.descriptor(), err.descriptor()};
  for (int i = 0; i < 3; ++i) posix_spawn_file_actions_adddup2(&actions, files[i], i);
  const std::vector<char*> arguments = ExecWords(words);

  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return {};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, out.Tail(), err.Tail()};
}

/// The last line that says something: of a Python that failed, the error itself.
std::string LastLine(std::string text) {
  text.erase(text.find_last_not_of(" \n") + 1);
  return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace

PictureFormat PictureFormatOf(const std::string& path) {
  const std::string end = fs::path(path).extension().string();
  for (const Word<PictureFormat>& word : WordsOf(PictureFormat{})) {
    if (end == "." + std::string(word.name)) return word.value;
  }
  Refuse({path}, "pictures end in .png, .svg or .pdf, not in '{}'", end);
}

Backend::Backend() : script_(DataFolder() / "tools/python/warmjoint/draw.py") {
  std::vector<std::string> candidates{"python3", "/usr/bin/python3"};
  if (const char* named = std::getenv("WARMJOINT_PYTHON"); named && *named) candidates = {named};
  // looked for and not imported, which would take half a second
  const char* const has =
      "import importlib.util as u, sys; sys.exit(not all(map(u.find_spec, ('matplotlib', "
      "'jinja2'))))";
  for (const std::string& python : candidates) {
    if (!Call({python, "-c", has}, "").well) continue;
    python_ = python;
    return;
  }
  throw OutputFailed(fmt::format(
      "pictures need Python with matplotlib and Jinja2, which {} has not: sudo apt install "
      "python3-matplotlib python3-jinja2",
      fmt::join(candidates, " or ")));
}

std::string Backend::Ask(const Tree& request) const {
  const Ended ended = Call({python_, "-B", script_.string()}, request.dump());
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
