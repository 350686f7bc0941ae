// A friction map and its axes made ready for being evaluated at every step of an engine.
#pragma once

#include <warmjoint/friction.h>

#include <algorithm>
#include <array>
#include <vector>

#include "models/friction/row_table.h"

namespace warmjoint {

/// Neighbouring kernels of one axis, those that count at a point, before they are normalised.
struct ActiveKernels {
  int first =
      0;  // place of the first one in the row that PreparedAxis::Row describes; of an axis that is tabulated a
          // multiple of four
  int count = 0;
  int begin = 0;                                  // of them in `value`
  double sum = 1;                                 // that they are to be divided by
  std::array<double, kMostMapCentres + 4> value;  // [begin + count], and 0 three times
};

/// One axis of Gaussian kernels, evaluated near x alone: kernels below 3e-13 of the peak are
/// left out, and those of an even grid cost one exponential together, by
///   kappa_(j+i) / kappa_j = exp(d r)^i exp(-(i r)^2 / 2),
/// r: spacing in widths, d: distance from the nearest centre j in widths. The few of a short even
/// grid are tabulated.
class PreparedAxis {
 public:
  PreparedAxis(const GaussianAxis& axis, KernelKind kind);

  /// A row in which the kernels that count are always neighbours: the index of the centre at each
  /// place, a circle's repeated beyond its ends, -1 where there is none.
  std::vector<int> Row() const;

  /// The kernels that count at x; count is 0 where there are none.
  void Kernels(double x, ActiveKernels& active) const;

  /// Kernels of a short even grid at one x, all of them, which their table tells.
  struct Tabled {
    const RowTable* table = nullptr;
    RowTable::Spot spot{};
    int first = 0;  // place of the first one in the row, a multiple of four
    int count = 0;
  };

  /// False where x has no table.
  bool FindTabled(double x, Tabled& tabled) const;

 private:
  /// Centres on one side of 0, or all of them.
  struct Segment {
    int begin = 0, end = 0;         // indices of the axis
    int row = 0;                    // place of the first centre in the row
    RowTable table{};               // a row for each centre's kernel, where they are few
    int pad = 0;                    // places beside the centres, to both sides
    double per_spacing = 0;         // 1 over that of an even grid
    double ratio = 0;               // r, of the spacing to the width
    std::vector<double> bell{};     // exp(-(i r)^2 / 2), i = 0, 1, ...; empty unless even
    std::vector<double> present{};  // 1 or 0: whether there is a centre, from bell.size() - 1
                                    // places before the first on
    int size() const { return end - begin; }
    int reach() const { return bell.empty() ? 0 : static_cast<int>(bell.size()) - 1; }
  };
  Segment MakeSegment(int begin, int end) const;
  RowTable TableOf(int begin, int end) const;
  int IndexAt(const Segment& segment, int place) const;
  /// The centres that count on the side of x; null where there are none.
  const Segment* SegmentAt(double x) const;
  void UntabledKernels(const Segment& segment, double x, ActiveKernels& active) const;
  bool EvenKernels(const Segment& segment, double x, ActiveKernels& active) const;
  void FreeKernels(const Segment& segment, double x, ActiveKernels& active) const;

  std::vector<Segment> segments_;
  Sides sides_;
  KernelKind kind_;
  GaussianAxis axis_;
};

inline const PreparedAxis::Segment* PreparedAxis::SegmentAt(double x) const {
  if (sides_ == Sides::apart && x == 0) return nullptr;
  const Segment& segment = segments_.size() > 1 && x > 0 ? segments_[1] : segments_[0];
  return segment.size() == 0 ? nullptr : &segment;
}

inline bool PreparedAxis::FindTabled(double x, Tabled& tabled) const {
  const Segment* const segment = SegmentAt(x);
  if (!segment || !segment->table.Locate(x, tabled.spot)) return false;
  tabled.table = &segment->table;
  tabled.first = segment->row;
  tabled.count = segment->size();
  return true;
}

inline void PreparedAxis::Kernels(double x, ActiveKernels& active) const {
  active.count = 0;
  Tabled tabled;
  if (!FindTabled(x, tabled)) {
    if (const Segment* const segment = SegmentAt(x)) UntabledKernels(*segment, x, active);
    return;
  }
  active.first = tabled.first;
  active.count = tabled.count;
  active.begin = 0;
  active.sum = 1;
  for (int i = 0; i < active.count; i += 4) {
    Four four;
    tabled.table->Quad(static_cast<size_t>(i / 4), tabled.spot, four);
    Store(four, active.value.data() + i);
  }
  std::fill_n(active.value.data() + active.count, 3, 0.0);
}

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
