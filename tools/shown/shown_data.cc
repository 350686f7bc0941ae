#include "tools/shown/shown_data.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace warmjoint::shown {

Tree ShownData::Hold(Eigen::VectorXd array) {
  Tree mark{{"array", arrays.size()}, {"shape", {array.size()}}};
  arrays.push_back(std::move(array));
  return mark;
}

Tree ShownData::Hold(const Eigen::MatrixXd& matrix) {
  Tree mark = Hold(Eigen::VectorXd(matrix.transpose().reshaped()));
  mark["shape"] = {matrix.rows(), matrix.cols()};
  return mark;
}

std::string Packed(const ShownData& data) {
  Tree sizes = Tree::array();
  for (const Eigen::VectorXd& array : data.arrays) sizes.push_back(array.size());
  std::string text = Tree{{"facts", data.facts}, {"sizes", sizes}}.dump() + '\n';
  for (const Eigen::VectorXd& array : data.arrays) {
    text.append(reinterpret_cast<const char*>(array.data()),
                static_cast<std::size_t>(array.size()) * sizeof(double));
  }
  return text;
}

}  // namespace warmjoint::shown
