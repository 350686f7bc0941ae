#include "models/foundation/description_text.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/xml_tags.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using std::string_view;

constexpr std::size_t kLargestText = std::size_t{64} << 20;  // bytes of all texts together
constexpr int kDeepest = 500;                                // why: a parser's stack holds it
/// Elements of a description, those that copies make counted. Why: MuJoCo reads and compiles a hundred thousand in some seconds.
constexpr double kMostElements = 1e5;
constexpr double kLongestArray = 1 << 26;  // numbers; why: a field of 8192 x 8192 heights
constexpr double kLargestNumber =
    1e12;  // why: no mass, length or moment of a robot, and squares stay exact

bool IsOneOf(string_view word, std::initializer_list<string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

std::vector<string_view> WordsOf(string_view text) {
  constexpr string_view blanks = " \t\r\n";
  std::vector<string_view> words;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    if (text.empty()) return words;
    words.push_back(text.substr(0, text.find_first_of(blanks)));
    text.remove_prefix(words.back().size());
  }
}

/// Attributes whose value is a name or a text, and may read as a number.
bool IsName(string_view attribute) {
  return attribute.starts_with("file") || attribute.ends_with("name") ||
         attribute.ends_with("class") ||
         IsOneOf(attribute, {"joint",   "joint1",   "joint2",     "jointparent", "body", "body1",
                             "body2",   "geom",     "geom1",      "geom2",       "site", "site1",
                             "site2",   "tendon",   "tendon1",    "tendon2",     "mesh", "material",
                             "texture", "target",   "instance",   "plugin",      "key",  "value",
                             "data",    "actuator", "model",      "link",        "type", "hfield",
                             "skin",    "refsite",  "slidersite", "cranksite",   "node", "prefix"});
}

/// Attributes that bound something, for which infinity says that there is no bound.
bool IsBound(string_view attribute) {
  return attribute.ends_with("range") ||
         IsOneOf(attribute, {"lower", "upper", "effort", "velocity", "cutoff", "k_velocity"});
}

/// What an attribute of a URDF's link or joint must hold.
struct UrdfNumbers {
  string_view element, attribute;
  int count = 1;
  bool below_zero = false;  // whether it may be
  const char* unit = "";
};

constexpr UrdfNumbers kUrdfNumbers[]{
    {"mass", "value", 1, false, ", kg"},     {"inertia", "ixx", 1, true, ", kg.m^2"},
    {"inertia", "iyy", 1, true, ", kg.m^2"}, {"inertia", "izz", 1, true, ", kg.m^2"},
    {"inertia", "ixy", 1, true, ", kg.m^2"}, {"inertia", "ixz", 1, true, ", kg.m^2"},
    {"inertia", "iyz", 1, true, ", kg.m^2"}, {"origin", "xyz", 3, true, ", m"},
    {"origin", "rpy", 3, true, ", rad"},     {"axis", "xyz", 3, true, ""},
    {"limit", "lower", 1, true, ""},         {"limit", "upper", 1, true, ""},
    {"limit", "effort", 1, false, ""},       {"limit", "velocity", 1, false, ""},
    {"dynamics", "damping", 1, false, ""},   {"dynamics", "friction", 1, false, ""},
    {"mimic", "multiplier", 1, true, ""},    {"mimic", "offset", 1, true, ""},
    {"box", "size", 3, false, ", m"},        {"sphere", "radius", 1, false, ", m"},
    {"cylinder", "radius", 1, false, ", m"}, {"cylinder", "length", 1, false, ", m"},
    {"mesh", "scale", 3, true, ""},
};

/// Throws BadInput for what is no regular file: a reader would wait for a pipe, or read a device for ever.
void RequireRegular(const fs::path& file, const Place& named) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
  Refuse(named, "names '{}', which is {} and no file; give a regular file", Excerpt(file.string()),
         S_ISFIFO(status.st_mode)   ? "a pipe"
         : S_ISDIR(status.st_mode)  ? "a folder"
         : S_ISSOCK(status.st_mode) ? "a socket"
                                    : "a device");
}

/// Product of the whole numbers in an attribute; 1 where it is absent, and each below 1 counted as 1.
double ProductOf(const XmlTag& tag, string_view attribute) {
  double product = 1;
  for (const string_view word : WordsOf(tag.Attribute(attribute).value_or(""))) {
    product *= std::max(1.0, ParseNumber(word).value_or(1));
  }
  return product;
}

/// Walks over the texts of one description.
class Reader {
 public:
  Reader(const fs::path& file, const DescriptionPackages& packages)
      : packages_(packages), root_(fs::absolute(file).parent_path()) {
    const Place place{file.string()};
    struct stat status {};
    if (stat(file.c_str(), &status) == 0 && !S_ISDIR(status.st_mode)) RequireRegular(file, place);
    found_.text = ReadText(file, 1);
    FindAssets();
  }

  DescriptionFiles Take() { return std::move(found_); }

 private:
  /// An element that is open.
  struct Open {
    string_view tag;
    std::string name;
    double copies = 1;
  };

  /// A file that stands in a text.
  struct Named {
    std::string file;
    Place place;
    fs::path beside;
  };

  std::string ReadText(const fs::path& file, double copies) {
    const std::string text = ReadWholeFile(file, left_);
    left_ -= std::min(left_, text.size());
    found_.texts.push_back(file);
    std::vector<Open> open{{"", "", copies}};
    XmlTagReader reader(text);
    bool urdf = false, first = true;
    while (const auto tag = reader.Next()) {
      const Place place{file.string(), tag->line};
      if (tag->kind == XmlTag::Kind::closes) {
        if (open.size() > 1) open.pop_back();
        continue;
      }
      if (first) urdf = tag->name == "robot";
      first = false;
      if (urdf) RefuseXacro(*tag, file, place);
      Count(*tag, open.back().copies, place);
      if (urdf) CheckUrdf(*tag, open, place);
      CheckNumbers(*tag, place);
      TakeFiles(*tag, file, open.back().copies, place);
      if (tag->kind != XmlTag::Kind::opens) continue;
      const double made = tag->name == "replicate" ? ProductOf(*tag, "count") : 1;
      open.push_back(
          {tag->name, std::string(tag->Attribute("name").value_or("")), open.back().copies * made});
      if (open.size() <= kDeepest + 1) continue;
      Refuse(place, "nests deeper than {} elements; a robot does not", kDeepest);
    }
    return text;
  }

  /// Refuses what xacro has to write out first; its own output may still declare its namespace.
  void RefuseXacro(const XmlTag& tag, const fs::path& file, const Place& place) {
    xacro_ = xacro_ || tag.Attribute("xmlns:xacro");
    const bool holds = tag.attributes.find("${") != string_view::npos ||
                       tag.attributes.find("$(") != string_view::npos;
    if (!tag.name.starts_with("xacro:") && !(xacro_ && holds)) return;
    Refuse(place, "<{}> is written in xacro; run: xacro {} > robot.urdf", Excerpt(tag.name),
           file.string());
  }

  /// Refuses copies and arrays that have no end.
  void Count(const XmlTag& tag, double copies, const Place& place) {
    const bool grid = tag.name == "composite" || tag.name == "flexcomp";
    elements_ += copies * (grid ? ProductOf(tag, "count") : 1);
    if (tag.name == "replicate") copies *= ProductOf(tag, "count");
    if (std::max(elements_, copies) > kMostElements) {
      Refuse(place, "<{}> makes more than {} elements; give a smaller count", tag.name,
             kMostElements);
    }
    double numbers = 1;
    if (tag.name == "hfield") numbers = ProductOf(tag, "nrow") * ProductOf(tag, "ncol");
    if (tag.name == "numeric") numbers = ProductOf(tag, "size");
    const char* const what = tag.name == "hfield" ? "nrow and ncol" : "size";
    if (numbers > kLongestArray) {
      Refuse(place, "{} of a <{}> make {:g} numbers; at most {:g} are read", what, tag.name,
             numbers, kLongestArray);
    }
    if (tag.name != "size") return;
    for (const auto& [name, value] : tag.Attributes()) {
      // room on a stack is taken when it is used, and MuJoCo refuses what there is not
      if (name == "memory" || name == "nstack") continue;
      if (ProductOf(tag, name) <= kMostElements * 10) continue;
      Refuse(place, "{} of <size> is {}; it must be at most {:g}", name, Excerpt(value),
             kMostElements * 10);
    }
  }

  /// Refuses NaN, and infinity that bounds nothing, of which MuJoCo takes some for "not given".
  static void CheckNumbers(const XmlTag& tag, const Place& place) {
    for (const auto& [name, value] : tag.Attributes()) {
      if (IsName(name)) continue;
      for (const string_view word : WordsOf(value)) {
        const string_view digits = word.substr(word.starts_with('-') || word.starts_with('+'));
        if (digits.empty() || string_view("nNiI").find(digits[0]) == string_view::npos) continue;
        const auto number = ParseNumber(word.starts_with('+') ? digits : word);
        if (!number || std::isfinite(*number) || (IsBound(name) && !std::isnan(*number))) continue;
        Refuse(place, "{} of <{}{}> is '{}'; it must be finite", name, tag.name,
               NamePart(tag.Attribute("name").value_or("")), Excerpt(value));
      }
    }
  }

  static std::string NamePart(string_view name) {
    return name.empty() ? "" : fmt::format(" name=\"{}\"", Excerpt(name));
  }

  /// Refuses what urdfdom reads as no mass, no inertia or no limit, without a word.
  static void CheckUrdf(const XmlTag& tag, const std::vector<Open>& open, const Place& place) {
    const bool of_robot = open.size() > 2 && open[1].tag == "robot" &&
                          (open[2].tag == "link" || open[2].tag == "joint");
    if (!of_robot) return;
    double largest = 0;
    for (const string_view moment : {"ixx", "iyy", "izz"}) {
      largest = std::max(largest, ParseNumber(tag.Attribute(moment).value_or("")).value_or(0));
    }
    for (const UrdfNumbers& wanted : kUrdfNumbers) {
      if (tag.name != wanted.element) continue;
      const auto value = tag.Attribute(wanted.attribute);
      if (!value) continue;
      // moments below 0 by rounding are mended where they are used
      const bool is_moment =
          wanted.element == "inertia" && wanted.attribute[1] == wanted.attribute[2];
      const double least = is_moment           ? -1e-3 * largest
                           : wanted.below_zero ? -std::numeric_limits<double>::infinity()
                                               : 0;
      const bool bound = IsBound(wanted.attribute);
      const std::vector<string_view> words = WordsOf(*value);
      const bool fits =
          std::ssize(words) == wanted.count && std::ranges::all_of(words, [&](string_view word) {
            const auto number = ParseNumber(word.starts_with('+') ? word.substr(1) : word);
            return number && !std::isnan(*number) && *number >= least &&
                   (bound || std::abs(*number) <= kLargestNumber);
          });
      if (fits) continue;
      Refuse(place, "{} '{}': {} of <{}> is '{}'; it must be {}{}{}", open[2].tag,
             Excerpt(open[2].name), wanted.attribute, tag.name, Excerpt(*value),
             wanted.count == 1 ? "a number" : "three numbers",
             is_moment || !wanted.below_zero ? " of 0 or more"
             : bound                         ? ""
                                             : fmt::format(" of {:g} at most", kLargestNumber),
             wanted.unit);
    }
  }

  void TakeFiles(const XmlTag& tag, const fs::path& file, double copies, const Place& place) {
    const fs::path beside = fs::absolute(file).parent_path();
    if (tag.name == "compiler") {
      for (const char* folder : {"meshdir", "texturedir", "assetdir"}) {
        if (const auto given = tag.Attribute(folder)) folders_.insert(std::string(*given));
      }
    }
    for (const auto& [name, value] : tag.Attributes()) {
      if (!name.starts_with("file") || value.empty()) continue;
      if (tag.name != "include" && tag.name != "model") {
        named_.push_back({std::string(value), place, beside});
        continue;
      }
      // beside the model, or beside the text that includes it
      for (const fs::path& folder : {root_, beside}) {
        const fs::path other = folder / std::string(value);
        RequireRegular(other, place);
        std::error_code absent;
        const fs::path known = fs::weakly_canonical(other, absent);
        if (!fs::exists(other, absent) || !read_.insert(known).second) continue;
        ReadText(other, copies);
      }
    }
  }

  /// All files that a name may mean, in any of the folders.
  void FindAssets() {
    std::set<fs::path> known;
    folders_.insert("");
    for (const auto& [file, place, beside] : named_) {
      for (const std::string& folder : folders_) {
        for (const fs::path& from : {root_, beside}) {
          const fs::path asset = Resolved(file, from / folder);
          std::error_code absent;
          if (asset.empty() || !fs::exists(asset, absent)) continue;
          if (fs::is_directory(asset, absent)) continue;
          RequireRegular(asset, place);
          if (known.insert(fs::weakly_canonical(asset, absent)).second) {
            found_.assets.push_back(asset);
          }
        }
      }
    }
  }

  /// A name as a path: of package:// in its folder, where that is known, of file:// from the root.
  fs::path Resolved(const std::string& file, const fs::path& folder) const {
    constexpr string_view package = "package://", local = "file:";
    if (file.starts_with(package)) {
      const std::size_t end = std::min(file.find('/', package.size()), file.size());
      const auto known = packages_.find(file.substr(package.size(), end - package.size()));
      if (known == packages_.end()) return {};
      return known->second / file.substr(std::min(end + 1, file.size()));
    }
    if (!file.starts_with(local)) return folder / file;
    const std::size_t begin = file.find_first_not_of('/', local.size());
    return "/" + file.substr(std::min(begin, file.size()));
  }

  const DescriptionPackages& packages_;
  fs::path root_;
  DescriptionFiles found_;
  std::size_t left_ = kLargestText;
  double elements_ = 0;
  bool xacro_ = false;
  std::set<fs::path> read_;
  std::set<std::string> folders_;
  std::vector<Named> named_;
};

}  // namespace

DescriptionFiles ReadDescription(const fs::path& file, const DescriptionPackages& packages) {
  return Reader(file, packages).Take();
}

std::vector<fs::path> FilesOfDescription(const fs::path& file,
                                         const DescriptionPackages& packages) {
  // a compiled model has no text, and names nothing
  if (file.extension() == ".mjb") return {file};
  DescriptionFiles found = ReadDescription(file, packages);
  found.texts.insert(found.texts.end(), found.assets.begin(), found.assets.end());
  return found.texts;
}

}  // namespace warmjoint
