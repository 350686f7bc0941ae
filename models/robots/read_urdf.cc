#include "models/robots/read_urdf.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <mutex>
#include <string>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/xml_tags.h"

namespace warmjoint {
namespace {

/// Keeps what urdfdom would print.
class Collector : public console_bridge::OutputHandler {
 public:
  Collector() { console_bridge::useOutputHandler(this); }
  ~Collector() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!errors.empty()) errors += "; ";
    errors += text;
  }

  std::string errors;
};

/// Refuses what would end the parser's stack, which it needs once for each level.
void CheckDepth(const std::string& text, const Place& place) {
  constexpr int deepest = 500;
  XmlTagReader reader(text);
  // how many elements are open at each tag
  int depth = 0;
  while (const auto tag = reader.Next()) {
    if (tag->kind == XmlTag::Kind::opens) ++depth;
    if (tag->kind == XmlTag::Kind::closes) --depth;
    if (depth > deepest) {
      Refuse({place.file, tag->line}, "nests deeper than {} elements; a robot does not", deepest);
    }
  }
}

}  // namespace

urdf::ModelInterfaceSharedPtr ReadUrdf(const std::filesystem::path& path) {
  // urdfdom reports through one handler of the whole program
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);

  // read, checked and parsed, with what the parser says kept for the refusal
  const std::string text = ReadWholeFile(path);
  CheckDepth(text, {path.string()});
  Collector collector;
  urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
  if (!robot) Refuse({path.string()}, "cannot be used as URDF: {}", collector.errors);
  return robot;
}

}  // namespace warmjoint
