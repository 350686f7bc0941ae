// A friction map made ready for being evaluated at every step of an engine.
#pragma once

#include <array>
#include <vector>

#include "models/friction/friction_map.h"

namespace warmjoint {

/// One axis of Gaussian kernels, evaluated near x alone: kernels below 1e-16 of the nearest are
/// left out, and those of an even grid cost one exponential together, by
///   kappa_(j+i) / kappa_j = exp(d r)^i exp(-(i r)^2 / 2),
/// r: spacing in widths, d: distance from the nearest centre j in widths.
class PreparedAxis {
 public:
  PreparedAxis(const GaussianAxis& axis, KernelKind kind);

  /// Kernels at x that count: their indices and values, into arrays of kMostMapCentres. Returns
  /// how many there are.
  int Kernels(double x, int* index, double* value) const;

 private:
  /// Centres on one side of 0, or all of them.
  struct Segment {
    int begin = 0, end = 0;  // indices of the axis
    bool even = false;
  };
  int EvenKernels(const Segment& segment, double x, int* index, double* value) const;
  int FreeKernels(const Segment& segment, double x, int* index, double* value) const;
  Segment MakeSegment(int begin, int end) const;

  GaussianAxis axis_;
  KernelKind kind_;
  double spacing_ = 0;        // of an even axis
  std::vector<double> bell_;  // exp(-(i r)^2 / 2), i = 0, 1, ...
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
  struct Active;
  template <size_t axis>
  double Sum(const std::array<Active, kMostMapAxes>& active, size_t offset) const;

  std::vector<MapQuantity> quantities_;
  std::vector<PreparedAxis> axes_;
  std::vector<size_t> strides_;  // of the weights, for each axis
  std::vector<double> weights_;
  MapFactor factor_;
};

}  // namespace warmjoint
