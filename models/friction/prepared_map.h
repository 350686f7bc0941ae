// A friction map made ready for being evaluated at every step of an engine.
#pragma once

#include <warmjoint/friction.h>

#include <array>
#include <vector>

#include "models/friction/prepared_axis.h"
#include "models/friction/row_table.h"

namespace warmjoint {

/// The same map as FrictionMap, to 1e-12 of its largest weight; allocates nothing in Value.
class PreparedMap {
 public:
  /// map: checked (CheckMap).
  explicit PreparedMap(const FrictionMap& map);

  /// Value as EvaluateMap gives it, N.m or N.
  double Value(const MapPoint<double>& point) const;

 private:
  using Active = std::array<ActiveKernels, kMostMapAxes>;

  /// Value, compiled for each processor (four.h); apart from it, since to the linker such functions are not what their
  /// callers in other files see. The first is for maps of two axes, the last of which is tabulated at the point; false
  /// where it is not.
  bool EvaluateTwo(const MapPoint<double>& point, double& value) const;
  double Evaluate(const MapPoint<double>& point) const;

  /// Sets the strides and visits, in the order of the rows, the weights of the last axis: a
  /// function of the index of its centre.
  template <typename Visit>
  void ForEachRow(const FrictionMap& map, const std::vector<size_t>& order, const Visit& visit);
  template <size_t axis, typename Sums>
  double Sum(const Active& active, size_t row, const Sums& sums) const;
  double FromTable(const ActiveKernels& kernels, size_t row, const RowTable::Spot& spot) const;

  // the axis with the most centres is the last; its sums are the longest, and tabulated
  std::array<MapQuantity, kMostMapAxes> quantities_{};  // of each axis
  MapFactor factor_;
  std::vector<PreparedAxis> axes_;
  RowTable table_;
  std::vector<size_t> strides_;  // of the rows, for each axis but the last
  std::vector<double> weights_;  // [rows x length_], over the last axis's row
  size_t length_ = 0;
};

}  // namespace warmjoint
