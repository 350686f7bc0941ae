#include "identification/maps/holes.h"

#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>

#include "identification/sentences/maps.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;

/// Index of the centre nearest to x, of ascending ones; of two as near, the lower one.
size_t NearestCentre(const GaussianAxis& axis, double x) {
  const std::vector<double>& centres = axis.centres;
  auto begin = centres.begin(), end = centres.end();
  // where directions are separate, centres on the side of x
  if (axis.sides == Sides::apart && x != 0) {
    const auto positive = std::upper_bound(begin, end, 0.0);
    (x > 0 ? begin : end) = positive;
  }
  if (begin == end) return 0;
  // x within the period that begins at the first centre
  if (axis.period) x -= *axis.period * std::floor((x - *begin) / *axis.period);
  const auto above = std::lower_bound(begin, end, x);
  if (above == begin) return static_cast<size_t>(begin - centres.begin());
  const auto below = std::prev(above);
  // beyond the last centre of a circle the first may be nearer
  const bool around = above == end && axis.period && *begin + *axis.period - x < x - *below;
  const bool next = above != end && *above - x < x - *below;
  return static_cast<size_t>((around ? begin : next ? above : below) - centres.begin());
}

/// The kernel whose centre is nearest to a sample along every axis; axes whose sides are separate keep to
/// the sample's side. points: [n x 5]
Index NearestKernel(const FrictionMap& map, const MapPoints& points, Index sample) {
  size_t kernel = 0;
  for (const MapAxis& axis : map.axes) {
    const double x = points(sample, static_cast<Index>(axis.quantity));
    kernel = kernel * axis.kernels.size() + NearestCentre(axis.kernels, x);
  }
  return static_cast<Index>(kernel);
}

}  // namespace

std::vector<std::optional<double>> SpeedsAtKernels(const FrictionMap& map, const MapPoints& kept) {
  // speeds of the samples nearest to each kernel
  std::vector<std::vector<double>> speeds(map.size());
  for (Index i = 0; i < kept.rows(); ++i) {
    const auto nearest = static_cast<size_t>(NearestKernel(map, kept, i));
    speeds[nearest].push_back(std::abs(kept(i, static_cast<int>(MapQuantity::velocity))));
  }
  // the median of each kernel with samples
  std::vector<std::optional<double>> medians(map.size());
  for (size_t k = 0; k < map.size(); ++k) {
    if (!speeds[k].empty()) medians[k] = MedianOf(speeds[k]);
  }

  // those without samples take the next one's along the first axis
  const std::vector<std::optional<double>> own = medians;
  const auto stride = static_cast<size_t>(KernelLines(map).stride);
  for (size_t k = 0; k < map.size(); ++k) {
    for (size_t away = stride; !medians[k] && away < map.size(); away += stride) {
      if (k >= away) medians[k] = own[k - away];
      if (!medians[k] && k + away < map.size()) medians[k] = own[k + away];
    }
  }
  return medians;
}

namespace {

// samples; why 2: one alone does not distinguish a weight from its noise
constexpr double kFewest = 2;
constexpr double kShare = 0.02;  // of the median
constexpr size_t kMostNamed = 3;

/// The next seen kernel of a line from i on in steps of +-1; nothing where there is none.
std::optional<Index> NextSeen(const KernelLines& lines, const std::vector<bool>& unseen,
                              Index first, Index i, Index step) {
  const Index n = lines.length;
  for (Index away = 1; away < n; ++away) {
    Index at = i + step * away;
    if (lines.circular) at = ((at % n) + n) % n;
    if (at < 0 || at >= n) return std::nullopt;
    if (!unseen[first + at * lines.stride]) return away;
  }
  return std::nullopt;
}

/// A run of unseen kernels.
struct Hole {
  double width = 0;  // of its axis
  std::string words;
};

/// Where a line of a map lies along its second axis and those after it; empty where the map has one line.
std::vector<LinePlace> PlacesOf(const FrictionMap& map, Index line) {
  std::vector<LinePlace> places;
  // axes from the last, which runs fastest, to the second
  for (size_t a = map.axes.size(); a-- > 1;) {
    const std::vector<double>& centres = map.axes[a].kernels.centres;
    places.push_back({.over = map.axes[a].quantity,
                      .centre = centres[line % std::ssize(centres)],
                      .is_direction = centres.size() <= 2});
    line /= std::ssize(centres);
  }
  std::ranges::reverse(places);
  return places;
}

/// The runs of one line of a map.
void AddHoles(const FrictionMap& map, Index first, Index line, const std::vector<bool>& unseen,
              JointKind joint, std::vector<Hole>& holes) {
  const KernelLines lines(map);
  const MapAxis& axis = map.axes[0];
  const std::vector<double>& centres = axis.kernels.centres;
  const double half = lines.length > 1 ? 0.5 * (centres[1] - centres[0]) : 0;
  for (Index i = 0; i < lines.length; ++i) {
    if (!unseen[first + i * lines.stride + line]) continue;
    Index end = i;
    while (end + 1 < lines.length && unseen[first + (end + 1) * lines.stride + line]) ++end;
    // data reach into the half cell at an end of the range
    const bool at_end = !lines.circular && (i == 0 || end + 1 == lines.length);
    if (!at_end || i < end) {
      // from half a cell below its first kernel to half a cell above its last
      const double lower = centres[i] - half, upper = centres[end] + half;
      holes.push_back(
          {upper - lower, NameOfHole({axis.quantity, lower, upper}, PlacesOf(map, line), joint)});
    }
    i = end;
  }
}

/// The pull on unseen kernels. It is as large as the data's on a seen kernel, the median of its diagonal of A^T A over s, and at least 1.
/// Why: with a weaker pull the few samples at the rims of a hole determine its weights, which then get large errors. gram: [q x
/// q] of the kernels; strength: s.
double PullOver(const Eigen::MatrixXd& gram, const std::vector<bool>& unseen, double strength) {
  std::vector<double> seen;
  for (Index i = 0; i < gram.rows(); ++i) {
    if (!unseen[i]) seen.push_back(gram(i, i));
  }
  return strength > 0 ? std::max(1.0, MedianOf(seen) / strength) : 1;
}

/// [q x q] P of the prior s w^T P w: 1 on the diagonal for seen kernels. An unseen one is drawn to the
/// straight line between its next seen neighbours along the first axis instead, or to the one that
/// there is; where its whole line is unseen, it is drawn to 0. pull: how much more than the others one between two
/// seen ones is drawn; maps over energy or load, whose lines fill as the joint warms, take 1.
Eigen::MatrixXd PriorOf(const std::vector<FrictionMap>& maps, const std::vector<bool>& unseen,
                        double pull) {
  const auto q = static_cast<Index>(unseen.size());
  Eigen::MatrixXd prior = Eigen::MatrixXd::Identity(q, q);
  Index first = 0;
  // along energy or load a hole is pulled as strongly as the others, elsewhere more strongly
  for (const FrictionMap& map : maps) {
    const KernelLines lines(map);
    const Index n = lines.length, size = n * lines.stride;
    const double firm =
        FindAxis(map, MapQuantity::energy) || FindAxis(map, MapQuantity::load) ? 1 : pull;
    for (Index k = 0; k < size; ++k) {
      if (!unseen[first + k]) continue;
      const Index line = first + k % lines.stride, i = k / lines.stride;
      const auto below = NextSeen(lines, unseen, line, i, -1);
      const auto above = NextSeen(lines, unseen, line, i, 1);
      if (!below && !above) continue;

      // w - (u a + d b) / (u + d), a and b being d below and u above
      const auto place = [&](Index at) { return line + (at % n + n) % n * lines.stride; };
      const auto down = static_cast<double>(below.value_or(0));
      const auto up = static_cast<double>(above.value_or(0));
      Eigen::VectorXd row = Eigen::VectorXd::Unit(q, first + k);
      if (below) row[place(i - *below)] -= above ? up / (up + down) : 1;
      if (above) row[place(i + *above)] -= below ? down / (up + down) : 1;
      // the prior draws it to its neighbours instead of to 0
      prior(first + k, first + k) -= 1;
      prior += (below && above ? firm : 1) * row * row.transpose();
    }
    first += size;
  }
  return prior;
}

}  // namespace

std::vector<bool> UnseenKernels(const std::vector<FrictionMap>& maps, const MapPoints& points) {
  std::vector<bool> unseen;
  for (const FrictionMap& map : maps) {
    const auto size = static_cast<Index>(map.size());
    // how many samples are nearest to each kernel
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(size);
    for (Index i = 0; i < points.rows(); ++i) ++counts[NearestKernel(map, points, i)];
    // a kernel is seen where it has at least two samples, and a share of the usual number
    std::vector<double> seen;
    std::ranges::copy_if(counts, std::back_inserter(seen),
                         [](double one) { return one >= kFewest; });
    const double least = std::max(kFewest, kShare * MedianOf(seen));
    for (const double one : counts) unseen.push_back(one < least);
  }
  return unseen;
}

Eigen::MatrixXd PenaltyOf(const std::vector<FrictionMap>& maps, const Eigen::MatrixXd& gram,
                          const std::vector<bool>& unseen, double strength) {
  return strength * PriorOf(maps, unseen, PullOver(gram, unseen, strength));
}

std::vector<double> DoubtOfHoles(const FrictionMap& map, Index first,
                                 const std::vector<bool>& unseen, const Eigen::VectorXd& weights) {
  // how much the weights with samples differ among each other
  const auto size = static_cast<Index>(map.size());
  std::vector<double> seen;
  for (Index i = first; i < first + size; ++i) {
    if (!unseen[i]) seen.push_back(weights[i]);
  }
  const auto count = static_cast<double>(seen.size());
  const double mean = std::accumulate(seen.begin(), seen.end(), 0.0) / count;
  double squares = 0;
  for (const double weight : seen) squares += std::pow(weight - mean, 2);
  const double spread = count > 1 ? std::sqrt(squares / (count - 1)) : 0;

  // less next to a kernel that is seen
  const KernelLines lines(map);
  std::vector<double> doubt(map.size());
  for (Index k = 0; k < size; ++k) {
    if (!unseen[first + k]) continue;
    const Index line = first + k % lines.stride, i = k / lines.stride;
    const auto below = NextSeen(lines, unseen, line, i, -1);
    const auto above = NextSeen(lines, unseen, line, i, 1);
    // the doubt of a kernel next to data is half as large
    const bool beside = below == 1 || above == 1;
    if (beside && !(below && above)) continue;  // half a cell at the end of the travel
    doubt[k] = beside ? 0.5 * spread : spread;
  }
  return doubt;
}

std::vector<std::string> NameHoles(const std::vector<FrictionMap>& maps,
                                   const std::vector<bool>& unseen, JointKind joint) {
  std::vector<Hole> holes;
  Index first = 0;
  for (const FrictionMap& map : maps) {
    for (Index line = 0; line < KernelLines(map).stride; ++line) {
      AddHoles(map, first, line, unseen, joint, holes);
    }
    first += static_cast<Index>(map.size());
  }
  // the widest are named, the others counted
  std::ranges::stable_sort(holes, std::ranges::greater{}, &Hole::width);
  std::vector<std::string> names;
  for (size_t i = 0; i < std::min(kMostNamed, holes.size()); ++i) names.push_back(holes[i].words);
  if (holes.size() > kMostNamed) {
    names.push_back(NameOfSmallerHoles(holes.size() - kMostNamed));
  }
  return names;
}

}  // namespace warmjoint
