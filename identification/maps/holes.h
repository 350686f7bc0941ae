// The places of a map's kernels relative to the samples, and where it has no data.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "identification/forward/log_trajectory.h"

namespace warmjoint {

/// Kernels along the first axis: weight k lies at index k / stride of the line k % stride.
struct KernelLines {
  Eigen::Index length = 0, stride = 1;
  bool circular = false;

  explicit KernelLines(const FrictionMap& map)
      : length(std::ssize(map.axes[0].kernels.centres)),
        stride(static_cast<Eigen::Index>(map.size()) / length),
        circular(map.axes[0].kernels.period.has_value()) {}
};

/// How fast the joint moved at each kernel of a map: the median |v| of the samples that it is the nearest kernel of; where
/// there are none, that of the next kernel along the first axis, if any. kept: [n x 5]; returns [q] rad/s or m/s.
std::vector<std::optional<double>> SpeedsAtKernels(const FrictionMap& map, const MapPoints& kept);

/// Kernels to which fewer than 2 samples are nearest, or fewer than a fiftieth of the median of their
/// map's. There the prior would set the map to 0, so that only the law is left, whatever its neighbours are.
/// points: [n x 5] of the samples; returns [q] of all maps' kernels, one map's after the other's.
std::vector<bool> UnseenKernels(const std::vector<FrictionMap>& maps, const MapPoints& points);

/// s P with the pull that suits the data, which is added to A^T A of the kernels. [q x q]
Eigen::MatrixXd PenaltyOf(const std::vector<FrictionMap>& maps, const Eigen::MatrixXd& gram,
                          const std::vector<bool>& unseen, double strength);

/// The error of the weights where a map has no data, as a standard deviation: 0 for seen kernels, the
/// rms spread of the map's seen weights around their mean for unseen ones, half of it next to a seen one,
/// and 0 there at an end of the range, where data reach into the half cell. first: the map's first
/// kernel among all; weights: [q]; returns one for each kernel of the map.
std::vector<double> DoubtOfHoles(const FrictionMap& map, Eigen::Index first,
                                 const std::vector<bool>& unseen, const Eigen::VectorXd& weights);

/// "position 0.015 to 0.027 m backwards": the runs of unseen kernels of all maps along their first
/// axis, but for single ones at an end of the range, where data reach into the half cell; the widest three.
std::vector<std::string> NameHoles(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, JointKind joint);

}  // namespace warmjoint
