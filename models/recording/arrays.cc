#include "models/recording/arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/recording/recording_columns.h"

namespace warmjoint {
namespace {

/// A name that stands for a column of an array.
struct NamedColumn {
  std::string name;
  std::size_t object = 0;
  std::optional<Eigen::Index> index;
};

/// Dimensions that are not 1.
std::vector<std::size_t> LongDimensions(const FileObject& object) {
  std::vector<std::size_t> dimensions;
  for (std::size_t i = 0; i < object.shape.size(); ++i) {
    if (object.shape[i] != 1) dimensions.push_back(i);
  }
  return dimensions;
}

bool IsVector(const FileObject& object) {
  return object.kind.empty() && LongDimensions(object).size() == 1;
}

bool IsMatrix(const FileObject& object) {
  return object.kind.empty() && LongDimensions(object).size() == 2;
}

/// "elbow/q (3200 x 3)", "joint (1 x 2 cell)".
std::string Shown(const FileObject& object) {
  const std::string shape = fmt::format("{}", fmt::join(object.shape, " x "));
  return fmt::format("{} ({}{}{})", Excerpt(object.path), shape, object.kind.empty() ? "" : " ",
                     object.kind);
}

/// Length of the groups that all vectors and matrices lie in, with their separators.
std::size_t CommonGroups(const FileTree& tree) {
  std::optional<std::string> common;
  for (const FileObject& object : tree.objects) {
    if (!IsVector(object) && !IsMatrix(object)) continue;
    // as far as both are alike, and no further than a group
    if (!common) common = object.path;
    const auto differ = std::ranges::mismatch(*common, object.path);
    common->erase(differ.in1, common->end());
    common->erase(common->rfind(tree.separator) + 1);
  }
  return common ? common->size() : 0;
}

/// A path whose separators are dots.
std::string Plain(std::string path) {
  std::ranges::replace(path, '/', '.');
  return path.starts_with('.') ? path.substr(1) : path;
}

/// Finds names among the arrays of a tree.
class Finder {
 public:
  explicit Finder(const FileTree& tree) : tree_(tree), common_(CommonGroups(tree)) {}

  std::string ShortPath(std::size_t object) const {
    return tree_.objects[object].path.substr(common_);
  }

  /// The array of that path, else that of the path before an index in brackets.
  std::optional<NamedColumn> Find(const std::string& name) const {
    if (const auto object = FindPath(name)) return NamedColumn{name, *object, {}};
    const std::size_t bracket = name.rfind('[');
    if (bracket == std::string::npos || !name.ends_with(']')) return {};
    const auto index = ParseNumber(name.substr(bracket + 1, name.size() - bracket - 2));
    const auto object = FindPath(name.substr(0, bracket));
    if (!object || !index || !(*index >= 0 && *index < 1e9)) return {};
    return NamedColumn{name, *object, static_cast<Eigen::Index>(*index)};
  }

 private:
  std::optional<std::size_t> FindPath(const std::string& name) const {
    const std::string wanted = Plain(name);
    for (std::size_t i = 0; i < tree_.objects.size(); ++i) {
      const FileObject& object = tree_.objects[i];
      if (!IsVector(object) && !IsMatrix(object)) continue;
      if (wanted == Plain(object.path) || wanted == Plain(ShortPath(i))) return i;
    }
    return {};
  }

  const FileTree& tree_;
  std::size_t common_;
};

/// The names that the layout asks for, as far as they are there, and a name for each other array.
std::vector<NamedColumn> NameColumns(const FileTree& tree, const ReadSettings& layout) {
  const Finder finder(tree);
  std::vector<NamedColumn> named;
  const auto add = [&](const NamedColumn& one) {
    if (std::ranges::find(named, one.name, &NamedColumn::name) == named.end()) named.push_back(one);
  };
  for (const RecordingColumn& column : RecordingColumns()) {
    const auto mapped = layout.map.find(column.name);
    const auto found = finder.Find(mapped == layout.map.end() ? column.name : mapped->second);
    if (found) add(*found);
  }
  for (std::size_t i = 0; i < tree.objects.size(); ++i) {
    if (IsVector(tree.objects[i])) add({finder.ShortPath(i), i, {}});
    if (IsMatrix(tree.objects[i])) add({finder.ShortPath(i) + "[0]", i, 0});
  }
  return named;
}

/// All that a file holds, with shapes, and what makes columns of the rest.
std::string Listing(const FileTree& tree, const Place& place) {
  std::vector<std::string> shown;
  bool other = false;
  for (const FileObject& object : tree.objects) {
    shown.push_back(Shown(object));
    other = other || !object.kind.empty();
  }
  if (shown.empty()) return "no array of numbers";
  const std::string remedy = fmt::format(
      "; what is no array of numbers is read by tools/convert {} -o log.h5", place.file);
  return ExcerptOfList(shown) + (other ? remedy : "");
}

/// The number of samples: the length that all these arrays have, the larger of two; 0 where they have none in common.
Eigen::Index CommonLength(const FileTree& tree, const std::vector<NamedColumn>& columns) {
  Eigen::Index longest = 0;
  for (const Eigen::Index length : tree.objects[columns.front().object].shape) {
    const bool common = std::ranges::all_of(columns, [&](const NamedColumn& one) {
      return std::ranges::count(tree.objects[one.object].shape, length) > 0;
    });
    if (common) longest = std::max(longest, length);
  }
  return longest;
}

/// Refuses matrices of which no column is named, all at once, and an index where there is none.
void CheckIndices(const FileTree& tree, const std::vector<ColumnSource>& sources,
                  const std::vector<NamedColumn>& columns, const Place& place) {
  std::vector<std::string> matrices, remedy;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto& [name, object, index] = columns[k];
    const FileObject& array = tree.objects[object];
    if (IsVector(array) && index) {
      Refuse(place, "{} is one column; leave {} out", Shown(array), name.substr(name.rfind('[')));
    }
    if (IsVector(array) || index) continue;
    matrices.push_back(Shown(array));
    remedy.push_back(fmt::format("{}={}[0]", sources[k].column->name, Excerpt(name)));
  }
  if (matrices.empty()) return;
  Refuse(place, "{} {} more than one column; choose one by its number from 0, for example --map {}",
         fmt::join(matrices, " and "), matrices.size() > 1 ? "have" : "has",
         fmt::join(remedy, ","));
}

/// Where the numbers of a column lie. samples: the length that all columns share, if any.
ArrayColumn Locate(const FileObject& array, const NamedColumn& column, Eigen::Index samples,
                   const Place& place) {
  // along the dimension of that length, else along the longest
  const std::vector<std::size_t> dimensions = LongDimensions(array);
  const auto shape = [&](std::size_t i) { return array.shape[i]; };
  auto along = std::ranges::find(dimensions, samples, shape);
  if (along == dimensions.end()) along = std::ranges::max_element(dimensions, {}, shape);
  ArrayColumn located{*along, *along, shape(*along), 0};
  if (dimensions.size() == 1) return located;
  // at the index of the other
  located.across = along == dimensions.begin() ? dimensions[1] : dimensions[0];
  located.index = column.index.value_or(0);
  const Eigen::Index columns = shape(located.across);
  if (located.index < columns) return located;
  Refuse(place, "has no {}: {} has {} columns, numbered from 0 to {}", Excerpt(column.name),
         Shown(array), columns, columns - 1);
}

}  // namespace

FileContent TakeColumns(
    const FileTree& tree, const ReadSettings& layout, const Place& place,
    const std::function<Eigen::VectorXd(const FileObject&, const ArrayColumn&)>& read) {
  // names without values, of which those that are asked for are found
  const std::vector<NamedColumn> named = NameColumns(tree, layout);
  FileContent content{tree.joint, tree.gear, {}};
  for (const NamedColumn& one : named) {
    content.columns.push_back({one.name, tree.objects[one.object].unit, {}});
  }
  const std::vector<ColumnSource> sources =
      FindColumns(NamesOf(content), WithAttributes(layout, content), place, Listing(tree, place));
  std::vector<NamedColumn> asked;
  for (const ColumnSource& source : sources) asked.push_back(named[source.index]);
  CheckIndices(tree, sources, asked, place);

  // their values
  const Eigen::Index samples = CommonLength(tree, asked);
  for (const ColumnSource& source : sources) {
    const NamedColumn& column = named[source.index];
    const FileObject& array = tree.objects[column.object];
    const ArrayColumn located = Locate(array, column, samples, place);
    if (located.count > kMostSamples) {
      Refuse(place, "{} states {} samples; {} at most are read", Excerpt(column.name),
             located.count, kMostSamples);
    }
    Eigen::VectorXd& values = content.columns[source.index].values;
    values = read(array, located);
    if (values.size() == located.count) continue;
    Refuse(place, "{} cannot be read; the file is damaged", Excerpt(column.name));
  }
  return content;
}

}  // namespace warmjoint
