// Random fields beside a law: what the model of a torque may lack, as columns with a Gaussian prior.
#pragma once

#include <warmjoint/fields.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "models/friction/laws.h"
#include "models/recording/measurements.h"

namespace warmjoint {

/// Rows with few numbers that are not 0.
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The only way in which a joint moves, 1 or -1; 0 where it moves both ways: at 3 % of the samples at least, of which less are a return.
int OnlyWay(const Eigen::VectorXd& velocity);

/// What fields depend on, at n samples.
struct FieldMotion {
  Eigen::VectorXd time, position, velocity;  // [n] s, rad or m, rad/s or m/s
  Eigen::VectorXd temperature{};             // [n] degC; or empty, where it was not logged
};
FieldMotion MotionOf(const LogSamples& m);

/// The rows of a fit: means over neighbouring samples that move in one direction.
struct FieldRows : FieldMotion {
  Eigen::MatrixXd flat;    // [n x p] columns without a field's prior
  Eigen::VectorXd torque;  // [n] N.m or N
  /// [p] of what is known of the unknowns of flat columns beforehand, and its precision, 0 where nothing is; or empty
  Eigen::VectorXd prior_mean{};
  Eigen::MatrixXd prior_precision{};  // [p x p]
  /// Of all samples in motion, also those at reversals, which make no rows: what figures are means over. [k]
  FieldMotion motion{};
  double step = 0.04;  // s, from a row to the next, median
  Eigen::Array<bool, Eigen::Dynamic, 1>
      follows;                         // [n] whether a row is the next after the one before it
  std::vector<Eigen::Index> starts{};  // first rows of further recordings

  Eigen::Index size() const { return time.size(); }
};

/// Knots, between which a field is a straight line, even within each piece.
struct Knots {
  Eigen::VectorXd at;            // [m], at least 2 of each piece, ascending
  std::optional<double> period;  // of a circle
  std::vector<Eigen::Index>
      starts{};  // first knots of further pieces, each of which has a field of its own

  Eigen::Index size() const { return at.size(); }
  /// The pieces, as ranges of knots.
  std::vector<SampleRange> Pieces() const { return CutAt(starts, size()); }
  /// The weights of the two knots next to each place; beyond the knots those of the last one. x: [n]; returns [n x m]
  SparseRows Columns(const Eigen::VectorXd& x) const;
  /// Distances of the knots from each other, chords on a circle, infinite from one piece to another. [m x m]
  Eigen::MatrixXd Distances() const;
};

/// A field whose values at m knots are normal about 0.
struct FieldBlock {
  FieldKind kind;
  Knots knots{};
  SparseRows columns{};                    // [n x m]
  Eigen::VectorXd mean{};                  // [m] of the columns over the motion, without signs
  std::vector<double> lengths{};           // [l] of the kernels, in the unit of the knots
  std::vector<Eigen::MatrixXd> kernels{};  // [l] of [m x m], covariance at amplitude 1
  double amplitude_scale = 0;  // of the half-normal prior of its amplitude, a share of the friction
  double fastest = 1;          // rad/s or m/s, at which a knot over the root of the speed is 1

  /// The columns at other places, times, speeds and temperatures. [n x m]
  SparseRows ColumnsAt(const FieldMotion& at) const;
  /// The same without the sign of the velocity.
  SparseRows UnsignedAt(const FieldMotion& at) const;
  Eigen::Index size() const { return knots.size(); }
};

/// Whether a linear law is the same in both directions.
bool IsSymmetric(const Law& law);

/// The fields over a log's rows. Knots: 40 over the position (.05 rad apart at least; over one turn where the joint travels more than
/// two), 24 over time, shared by the recordings, of which each has fields over time of its own, 10 over the root of the speed,
/// 8 over a temperature.
/// Kernels: Matern 3/2 over position, speed and temperature, exp(-|dt|/l) over time. Lengths over the position reach from 1.5 knots to the longest of a 20th of the travel and the lesser of .32 rad and a fifth of it: longer
/// ones are what a law, gravity or a curve over the speed does.
/// Friction over position and over temperature is orthogonal, over the motion, to a level, that over speed, over the rows, to the law, so that the law's parameters are those of
/// its best line; torque over position to a constant where the law has a level for each direction, which would be the same. law: linear
std::vector<FieldBlock> MakeFields(const std::vector<FieldKind>& kinds, const FieldRows& rows,
                                   JointKind joint, const Law& law);

}  // namespace warmjoint
