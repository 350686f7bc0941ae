#include "sim/model/check_repeats.h"

#include <cmath>
#include <sstream>
#include <system_error>
#include <vector>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/xml_tags.h"

namespace warmjoint::inline sim {
namespace fs = std::filesystem;
namespace {

constexpr int kDeepest = 500;        // elements within elements
constexpr int kMostIncludes = 1000;  // files
constexpr double kLargestTexture = 1 << 30;

/// The product of the numbers in an attribute, each at least 1; 1 where there are none.
double Product(const XmlTag& tag, std::string_view attribute) {
  double product = 1;
  std::istringstream words{std::string(tag.Attribute(attribute).value_or(""))};
  for (std::string word; words >> word;) {
    const auto number = ParseNumber(word);
    if (number && std::isfinite(*number)) product *= std::max(1.0, *number);
  }
  return product;
}

/// Walks through a model and the files that it includes.
class RepeatCount {
 public:
  explicit RepeatCount(fs::path folder) : folder_(std::move(folder)) {}

  /// copies: that the elements around this text make of it.
  void Add(const std::string& text, const fs::path& file, double copies, int depth) {
    std::vector<double> around{copies};  // of the elements that are open
    XmlTagReader reader(text);
    while (const auto tag = reader.Next()) {
      const Place place{file.string(), tag->line};
      if (tag->kind == XmlTag::Kind::closes) {
        if (around.size() > 1) around.pop_back();
        continue;
      }
      // what stands inside is copied as often as all around it together
      const double within = around.back() * Copies(*tag, around.back(), place);
      CheckTexture(*tag, place);
      if (tag->name == "include") Include(*tag, around.back(), depth, place);
      if (tag->kind == XmlTag::Kind::opens) around.push_back(within);
      // the engine's own readers call themselves for each depth
      if (depth + static_cast<int>(around.size()) > kDeepest) {
        Refuse(place, "nests deeper than {} elements; a model does not", kDeepest);
      }
    }
  }

 private:
  /// How often a repeating element stands for what it holds; 1 for others. around: its own copies.
  double Copies(const XmlTag& tag, double around, const Place& place) {
    const bool repeats =
        tag.name == "replicate" || tag.name == "composite" || tag.name == "flexcomp";
    if (!repeats) return 1;
    const double copies = Product(tag, "count");
    copies_ += around * copies;
    if (copies_ <= kMostCopies) return copies;
    Refuse(place,
           "count of <{}> makes {:g} copies of what it holds, {:g} in all; {:g} at most, since "
           "MuJoCo's time to build them grows with their square",
           tag.name, around * copies, copies_, kMostCopies);
  }

  static void CheckTexture(const XmlTag& tag, const Place& place) {
    if (tag.name != "texture") return;
    // three bytes a pixel
    const double bytes = 3 * Product(tag, "width") * Product(tag, "height");
    if (bytes <= kLargestTexture) return;
    Refuse(place, "width and height of a <texture> make {:.1f} GiB; 1 GiB at most",
           bytes / kLargestTexture);
  }

  void Include(const XmlTag& tag, double copies, int depth, const Place& place) {
    const auto name = tag.Attribute("file");
    if (!name) return;
    if (++includes_ > kMostIncludes) {
      Refuse(place, "includes more than {} files, or itself; write it out", kMostIncludes);
    }
    // what cannot be read, MuJoCo refuses
    const fs::path file = folder_ / std::string(*name);
    std::error_code absent;
    if (!fs::is_regular_file(file, absent)) return;
    Add(ReadWholeFile(file), file, copies, depth + 1);
  }

  fs::path folder_;  // of the model, from which its includes count
  double copies_ = 0;
  int includes_ = 0;
};

}  // namespace

void CheckRepeats(const std::string& text, const fs::path& path) {
  RepeatCount(path.parent_path()).Add(text, path, 1, 0);
}

}  // namespace warmjoint::inline sim
