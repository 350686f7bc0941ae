#include "identification/fields/field_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "identification/fit/fit_data.h"
#include "identification/linear/rigid_part.h"
#include "identification/preparation/local_motion.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongest =
    0.04;  // s; why: 25 Hz holds what a joint's friction does, and what is faster is noise

/// Kept samples that make a row: [first, last) of them, and whether it is the next after the one before.
struct Group {
  Index first, count;
  bool follows;
  Index sample;  // the first of them in the log
};

constexpr double kFewest = 120;  // rows; why: twice as many as show how noise is correlated

/// Each run of neighbours in even parts.
std::vector<Group> GroupsOf(const Selection& used, const LogSamples& m) {
  std::vector<Index> kept;
  for (Index i = 0; i < m.size(); ++i) {
    if (used.keep[i]) kept.push_back(i);
  }
  const double longest = LongestStep(m.time);
  const double step = MedianStep(m.time);
  const double together =
      std::max(1.0, std::min(kLongest / step, static_cast<double>(kept.size()) / kFewest));
  std::vector<Group> groups;
  const auto add_run = [&](Index begin, Index end) {
    const double parts = static_cast<double>(end - begin) / together;
    const Index count = std::max<Index>(1, std::lround(parts));
    for (Index g = 0; g < count; ++g) {
      const Index first = begin + (end - begin) * g / count;
      groups.push_back({first, begin + (end - begin) * (g + 1) / count - first, g > 0,
                        kept[static_cast<size_t>(first)]});
    }
  };
  Index begin = 0;
  for (Index k = 1; k <= std::ssize(kept); ++k) {
    if (k < std::ssize(kept)) {
      const Index i = kept[static_cast<size_t>(k)], before = kept[static_cast<size_t>(k - 1)];
      const bool starts = std::ranges::binary_search(m.further_starts, i);
      if (i == before + 1 && !starts && Sign(m.velocity[i]) == Sign(m.velocity[before]) &&
          m.time[i] - m.time[before] <= longest) {
        continue;
      }
    }
    add_run(begin, k);
    begin = k;
  }
  return groups;
}

/// Means of kept samples over groups. kept: [n x c]; returns [g x c]
MatrixXd Means(const MatrixXd& kept, const std::vector<Group>& groups) {
  MatrixXd means(std::ssize(groups), kept.cols());
  for (Index g = 0; g < means.rows(); ++g) {
    const Group& one = groups[static_cast<size_t>(g)];
    means.row(g) = kept.middleRows(one.first, one.count).colwise().mean();
  }
  return means;
}

}  // namespace

VectorXd UnknownsOf(const Fit& fit) {
  std::vector<double> x;
  for (const Unknown& row : fit.parameters) {
    if (row.estimated) x.push_back(row.X());
  }
  return VectorXd::Map(x.data(), std::ssize(x));
}

FieldRows MakeFieldRows(const Fit& fit, const LogSamples& m, const MatrixXd& others,
                        const VectorXd& left_out) {
  const std::vector<Group> groups = GroupsOf(fit.rows.used, m);
  const MatrixXd jacobian = Kept(fit.rows.jacobian(), fit.rows.used);
  const auto mean = [&](const VectorXd& all) {
    return VectorXd(Means(Kept(all, fit.rows.used), groups));
  };
  FieldRows rows;
  rows.time = mean(m.time);
  rows.position = mean(m.position);
  rows.velocity = mean(m.velocity);
  rows.flat = Means(ConcatColumns(jacobian, Kept(others, fit.rows.used)), groups);
  rows.torque = Means(
      fit.rows.residual() + jacobian * UnknownsOf(fit) + Kept(left_out, fit.rows.used), groups);
  const SampleMask moving = InMotion(m.velocity);
  rows.motion = {Chosen(m.time, moving), Chosen(m.position, moving), Chosen(m.velocity, moving)};
  if (m.temperature) {
    rows.temperature = mean(*m.temperature);
    rows.motion.temperature = Chosen(*m.temperature, moving);
  }
  rows.follows.resize(std::ssize(groups));
  std::vector<double> steps;
  for (Index g = 0; g < rows.size(); ++g) {
    rows.follows[g] = groups[static_cast<size_t>(g)].follows;
    if (rows.follows[g]) steps.push_back(rows.time[g] - rows.time[g - 1]);
  }
  if (!steps.empty()) rows.step = MedianOf(steps);
  for (const Index start : m.further_starts) {
    const auto row = std::ranges::lower_bound(groups, start, {}, &Group::sample);
    const Index first = row - groups.begin();
    const Index before = rows.starts.empty() ? 0 : rows.starts.back();
    if (first > before && first < rows.size()) rows.starts.push_back(first);
  }
  return rows;
}

}  // namespace warmjoint
