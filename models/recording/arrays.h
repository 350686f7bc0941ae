// Named arrays of numbers, as files have them in groups and structs, and a log's columns in them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/recording/assemble.h"

namespace warmjoint {

/// Groups within groups, and objects of a file, that are looked at.
inline constexpr int kDeepestGroup = 16;
inline constexpr std::size_t kMostObjects = 10'000;

/// What a file holds under a name, before its values are read.
struct FileObject {
  std::string path;                 // names of its groups or structs and its own, separated
  std::vector<Eigen::Index> shape;  // as the file's own tools show it
  std::string kind;                 // empty: numbers; else what it is, for messages: "cell"
  std::string unit;                 // as the file says; empty where it does not
};

/// The objects of a file, and what it says of itself.
struct FileTree {
  char separator = '/';        // of paths
  std::string joint;           // "rotary" or "linear"; empty where the file does not say
  std::optional<double> gear;  // the same
  std::vector<FileObject> objects;
};

/// One column of an array: its N numbers lie along one dimension, at `index` of another where that is longer than 1.
struct ArrayColumn {
  std::size_t along = 0, across = 0;  // dimensions
  Eigen::Index count = 0;             // N
  Eigen::Index index = 0;             // from 0; 0 where `across` is `along`
};

/// Finds the layout's columns among the arrays and reads these alone. A column's name is the path of a vector (N, N x 1,
/// 1 x N), or "path[3]" of a matrix, N x k or k x N by the length that all columns share; '.' and '/' separate alike, and
/// what all paths have in front may be left out. Throws BadInput where columns are not there, with what is there, where
/// a matrix needs an index, and where `read` gives other than N numbers. place: the file.
FileContent TakeColumns(
    const FileTree& tree, const ReadSettings& layout, const Place& place,
    const std::function<Eigen::VectorXd(const FileObject&, const ArrayColumn&)>& read);

}  // namespace warmjoint
