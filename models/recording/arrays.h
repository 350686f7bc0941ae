// Named arrays of numbers, as files have them in groups and structs, and a log's columns in them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "models/recording/assemble.h"

namespace warmjoint {

/// Groups within groups, and objects of a file, that are looked at.
inline constexpr int kDeepestGroup = 16;
inline constexpr std::size_t kMostObjects = 10'000;

/// One column of an array: its N numbers lie along one dimension, at `index` of the dimension `across`.
struct ArrayColumn {
  std::size_t along = 0, across = 0;  // the same for a vector, with index 0
  Eigen::Index count = 0, index = 0;
};

/// What a file holds under a name, before its values are read.
struct FileObject {
  std::string path;  // names of its groups or structs and its own, with '/' or '.' between
  std::vector<Eigen::Index> shape;  // as the file's own tools show it
  std::function<Eigen::VectorXd(const ArrayColumn&)>
      read{};  // [N], or fewer where it is damaged; none where it is no array of real numbers
  std::string unit{};  // as the file says; empty where it does not
};

/// Reads the columns that are wanted, and these alone, into what the file says of itself. A column's name is the path
/// of a vector (N, N x 1, 1 x N), or "path[3]" of a matrix, counted from 0. A matrix is N x k or k x N by the length of a vector
/// of the file, else by the larger. Throws BadInput where a column is not there, with all that is, and where one is damaged.
FileContent TakeColumns(FileContent content, const std::vector<FileObject>& objects,
                        const WantedColumns& wanted, const Place& place);

}  // namespace warmjoint
