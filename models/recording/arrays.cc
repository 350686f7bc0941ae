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
constexpr std::size_t kMostNames = 100'000;  // as many as an answer of read_apart.cc has

/// Dimensions that are not 1, of an array of numbers: one of a vector, two of a matrix.
std::vector<std::size_t> LongDimensions(const FileObject& object) {
  std::vector<std::size_t> dimensions;
  for (std::size_t i = 0; object.read && i < object.shape.size(); ++i) {
    if (object.shape[i] != 1) dimensions.push_back(i);
  }
  return dimensions;
}

/// All that a file holds with shapes, as "elbow/q (3200 x 3)", and what makes columns of the rest.
std::string Listing(const std::vector<FileObject>& objects, const Place& place) {
  std::vector<std::string> shown;
  bool all = true;
  for (const auto& [path, shape, read, unit] : objects) {
    shown.push_back(fmt::format("{} ({}{})", Excerpt(path), fmt::join(shape, " x "),
                                read ? "" : ", no numbers"));
    all = all && read;
  }
  return (shown.empty() ? "no array of numbers" : ExcerptOfList(shown)) +
         (all ? ""
              : fmt::format(
                    "; cells, arrays of structs and compounds are read by warmjoint convert {} "
                    "-o log.h5",
                    place.file));
}

}  // namespace

FileContent TakeColumns(FileContent content, const std::vector<FileObject>& objects,
                        const WantedColumns& wanted, const Place& place) {
  std::set<Index> lengths;  // of vectors
  for (const FileObject& object : objects) {
    const auto dimensions = LongDimensions(object);
    if (dimensions.size() == 1) lengths.insert(object.shape[dimensions[0]]);
  }

  // every vector, and every column of matrices, by its path
  std::vector<std::pair<const FileObject*, ArrayColumn>> arrays;
  for (const FileObject& object : objects) {
    const auto dimensions = LongDimensions(object);
    if (dimensions.empty() || dimensions.size() > 2 || arrays.size() > kMostNames) continue;
    // samples along the dimension that is the length of a vector, or the larger
    const auto is_length = [&](std::size_t i) {
      return std::pair(lengths.contains(object.shape[i]), object.shape[i]);
    };
    const std::size_t along = *std::ranges::max_element(dimensions, {}, is_length);
    const std::size_t across = dimensions.front() + dimensions.back() - along;
    const bool is_matrix = dimensions.size() == 2;
    if (is_matrix && object.shape[across] > kMostOfMatrix) continue;
    for (Index i = 0; i < (is_matrix ? object.shape[across] : 1); ++i) {
      arrays.emplace_back(&object, ArrayColumn{along, across, object.shape[along], i});
      content.columns.push_back(
          {is_matrix ? fmt::format("{}[{}]", object.path, i) : object.path, object.unit});
    }
  }

  // values of those that are asked for
  for (const WantedColumn& one : wanted(content, place, Listing(objects, place))) {
    const auto& [object, column] = arrays[one.index];
    FileColumn& into = content.columns[one.index];
    if (column.count > kMostSamples) {
      Refuse(place, "{} states {} samples; {} at most are read", Excerpt(into.name), column.count,
             kMostSamples);
    }
    into.values = object->read(column);
    if (into.values.size() == column.count) continue;
    Refuse(place, "{} cannot be read; the file is damaged", Excerpt(into.name));
  }
  return content;
}

}  // namespace warmjoint
