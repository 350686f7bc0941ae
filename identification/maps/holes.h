// Where a map has no data.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/ridge/local_rows.h"

namespace warmjoint {

/// Kernels to which fewer than 2 samples are nearest, or fewer than a fiftieth of the median of their
/// map's: there the prior would set the map to 0, to the law's bare level, whatever its neighbours are.
/// points: [n x 5] of the samples; returns [q] of all maps' kernels, one map's after the other's.
std::vector<bool> UnseenKernels(const std::vector<FrictionMap>& maps, const MapPoints& points);

/// [q x q] P of the prior s w^T P w: 1 on the diagonal for seen kernels. An unseen one is drawn to the
/// straight line between its next seen neighbours along the first axis instead, or to the one that
/// there is; where its whole line is unseen, to 0. pull: how much more than the others one between two
/// seen ones is drawn; maps over energy or load, whose lines fill as the joint warms, take 1.
Eigen::MatrixXd PriorOf(const std::vector<FrictionMap>& maps, const std::vector<bool>& unseen,
                        double pull);

/// As much as data hold a seen kernel, the median of its diagonal of A^T A over s, and at least 1: a weaker
/// pull leaves a hole to the few samples at its rims, which throw its weights far off. gram: [q x q] of the
/// kernels; strength: s.
double PullOver(const Eigen::MatrixXd& gram, const std::vector<bool>& unseen, double strength);

/// s P with the pull that the data ask for: what joins A^T A of the kernels. [q x q]
Eigen::MatrixXd PenaltyOf(const std::vector<FrictionMap>& maps, const Eigen::MatrixXd& gram,
                          const std::vector<bool>& unseen, double strength);

/// What the weights may be off where a map has no data, as a standard deviation: 0 for seen kernels, the
/// rms spread of the map's seen weights around their mean for unseen ones, half of it beside a seen one,
/// and 0 there at an end of the range, where data reach into the half cell. first: the map's first
/// kernel among all; weights: [q]; returns one for each kernel of the map.
std::vector<double> DoubtOfHoles(const FrictionMap& map, size_t first,
                                 const std::vector<bool>& unseen, const Eigen::VectorXd& weights);

/// "position 0.015 to 0.027 m backwards": the runs of unseen kernels of all maps along their first
/// axis, but for single ones at an end of the range, where data reach into the half cell; the widest three.
std::vector<std::string> NameHoles(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, JointKind joint);

}  // namespace warmjoint
