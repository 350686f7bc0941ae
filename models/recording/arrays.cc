#include "models/recording/arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "models/foundation/excerpt.h"
#include "models/recording/recording_columns.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kMostOfMatrix = 1000;        // columns
constexpr std::size_t kMostNames = 100'000;  // as many as an answer of read_apart.h has

/// A column by the name that it may be asked for.
struct NamedColumn {
  std::string name;
  const FileObject* object;
  ArrayColumn column;
};

/// Dimensions that are not 1, of an array of numbers: one of a vector, two of a matrix.
std::vector<std::size_t> LongDimensions(const FileObject& object) {
  std::vector<std::size_t> dimensions;
  for (std::size_t i = 0; object.numbers && i < object.shape.size(); ++i) {
    if (object.shape[i] != 1) dimensions.push_back(i);
  }
  return dimensions;
}

/// Every vector, and every column of matrices, by its path.
std::vector<NamedColumn> NameColumns(const FileTree& tree) {
  std::set<Index> lengths;  // of vectors
  for (const FileObject& object : tree.objects) {
    const auto dimensions = LongDimensions(object);
    if (dimensions.size() == 1) lengths.insert(object.shape[dimensions[0]]);
  }

  std::vector<NamedColumn> named;
  for (const FileObject& object : tree.objects) {
    const auto dimensions = LongDimensions(object);
    if (dimensions.empty() || dimensions.size() > 2 || named.size() > kMostNames) continue;
    // samples along the dimension that is the length of a vector, or the larger
    const auto is_length = [&](std::size_t i) {
      return std::pair(lengths.contains(object.shape[i]), object.shape[i]);
    };
    const std::size_t along = *std::ranges::max_element(dimensions, {}, is_length);
    const std::size_t across = dimensions.front() + dimensions.back() - along;
    const ArrayColumn first{along, across, object.shape[along], 0};
    if (dimensions.size() == 1) named.push_back({object.path, &object, first});
    if (dimensions.size() == 1 || object.shape[across] > kMostOfMatrix) continue;
    for (Index i = 0; i < object.shape[across]; ++i) {
      named.push_back({fmt::format("{}[{}]", object.path, i), &object, first});
      named.back().column.index = i;
    }
  }
  return named;
}

/// Length of the groups that all columns lie in, with their separators.
std::size_t CommonGroups(const std::vector<NamedColumn>& named) {
  std::string common = named.empty() ? "" : named.front().object->path;
  for (const NamedColumn& one : named) {
    // as far as both are alike, and no further than a group
    common.erase(std::ranges::mismatch(common, one.object->path).in1, common.end());
    common.erase(common.find_last_of("./") + 1);
  }
  return common.size();
}

/// A path whose separators are dots.
std::string Plain(std::string path) {
  std::ranges::replace(path, '/', '.');
  return path.starts_with('.') ? path.substr(1) : path;
}

/// Gives the columns names without common groups, and those that the layout asks for its own spelling.
void Rename(const ReadSettings& layout, std::vector<NamedColumn>& named) {
  const std::size_t common = CommonGroups(named);
  const auto is = [&](const NamedColumn& one, const std::string& asked) {
    return Plain(one.name) == asked || Plain(one.name).substr(common) == asked;
  };
  std::vector<std::pair<std::size_t, std::string>> asked;
  for (const auto& [ours, theirs] : layout.map) {
    const auto found =
        std::ranges::find_if(named, [&](const NamedColumn& one) { return is(one, Plain(theirs)); });
    if (found != named.end()) asked.push_back({found - named.begin(), theirs});
  }
  for (NamedColumn& one : named) one.name = one.name.substr(common);
  for (const auto& [i, theirs] : asked) named[i].name = theirs;
}

/// All that a file holds with shapes, as "elbow/q (3200 x 3)", and what makes columns of the rest.
std::string Listing(const FileTree& tree, const Place& place) {
  std::vector<std::string> shown;
  for (const FileObject& object : tree.objects) {
    shown.push_back(fmt::format("{} ({}{})", Excerpt(object.path), fmt::join(object.shape, " x "),
                                object.numbers ? "" : ", no numbers"));
  }
  const bool all = std::ranges::all_of(tree.objects, &FileObject::numbers);
  return (shown.empty() ? "no array of numbers" : ExcerptOfList(shown)) +
         (all ? ""
              : fmt::format("; cells, arrays of structs and compounds are read by tools/convert {} "
                            "-o log.h5",
                            place.file));
}

}  // namespace

FileContent TakeColumns(
    const FileTree& tree, const ReadSettings& layout, const Place& place,
    const std::function<Eigen::VectorXd(const FileObject&, const ArrayColumn&)>& read) {
  // names without values
  std::vector<NamedColumn> named = NameColumns(tree);
  Rename(layout, named);
  FileContent content{tree.joint, tree.gear, {}};
  for (const NamedColumn& one : named) {
    content.columns.push_back({one.name, one.object->unit, {}});
  }

  // values of those that are asked for
  for (const ColumnSource& source : FindColumns(NamesOf(content), WithAttributes(layout, content),
                                                place, Listing(tree, place))) {
    const auto& [name, object, column] = named[source.index];
    if (column.count > kMostSamples) {
      Refuse(place, "{} states {} samples; {} at most are read", Excerpt(name), column.count,
             kMostSamples);
    }
    Eigen::VectorXd& values = content.columns[source.index].values = read(*object, column);
    if (values.size() == column.count) continue;
    Refuse(place, "{} cannot be read; the file is damaged", Excerpt(name));
  }
  return content;
}

}  // namespace warmjoint
