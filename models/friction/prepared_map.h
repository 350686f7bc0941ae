// A friction map made ready for being evaluated at every step of an engine.
#pragma once

#include <array>
#include <vector>

#include "models/friction/friction_map.h"

namespace warmjoint {

/// Neighbouring kernels of one axis, those that count at a point, before they are normalised.
struct ActiveKernels {
  int first = 0;  // place of the first one in the row that PreparedAxis::Row describes
  int count = 0;
  double sum = 1;                             // that they are to be divided by
  std::array<double, kMostMapCentres> value;  // [count]
};

/// One axis of Gaussian kernels, evaluated near x alone: kernels below 1e-16 of the nearest are
/// left out, and those of an even grid cost one exponential together, by
///   kappa_(j+i) / kappa_j = exp(d r)^i exp(-(i r)^2 / 2),
/// r: spacing in widths, d: distance from the nearest centre j in widths.
class PreparedAxis {
 public:
  PreparedAxis(const GaussianAxis& axis, KernelKind kind);

  /// The centre at each place of a row in which the kernels that count are always neighbours: all
  /// centres, twice on a circle.
  std::vector<size_t> Row() const;

  /// The kernels that count at x; count is 0 where there are none.
  void Kernels(double x, ActiveKernels& active) const;

 private:
  /// Centres on one side of 0, or all of them.
  struct Segment {
    int begin = 0, end = 0;      // indices of the axis
    double spacing = 0;          // of an even grid
    std::vector<double> bell{};  // exp(-(i r)^2 / 2), i = 0, 1, ...; empty unless even
  };
  Segment MakeSegment(int begin, int end) const;
  bool IsEven(const Segment& segment) const;
  void EvenKernels(const Segment& segment, double x, ActiveKernels& active) const;
  void FreeKernels(const Segment& segment, double x, ActiveKernels& active) const;

  GaussianAxis axis_;
  KernelKind kind_;
  std::vector<Segment> segments_;
};

/// The same map as FrictionMap, to 1e-12 of its largest weight; allocates nothing in Value.
class PreparedMap {
 public:
  /// map: checked (CheckMap).
  explicit PreparedMap(const FrictionMap& map);

  /// Value as EvaluateMap gives it, N.m or N.
  double Value(const MapPoint<double>& point) const;

 private:
  using Active = std::array<ActiveKernels, kMostMapAxes>;
  void LayOut(const FrictionMap& map);
  template <size_t axis>
  double Sum(const Active& active, const double* weights) const;

  // the axis with the most centres is the last, whose sums are the longest
  std::vector<MapQuantity> quantities_;
  std::vector<PreparedAxis> axes_;
  std::vector<size_t> strides_;  // of the weights, for each axis
  std::vector<double> weights_;  // over the axes' rows, the last one's index the fastest
  MapFactor factor_;
};

}  // namespace warmjoint
