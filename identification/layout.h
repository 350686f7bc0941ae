// Where the unknowns of a fit stand in its vector x: the one index arithmetic of fits that are linear but for the heat.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <numeric>
#include <vector>

namespace warmjoint {

/// Unknowns that stand together in x.
struct Slice {
  Eigen::Index begin = 0, size = 0;

  Eigen::Index end() const { return begin + size; }
  /// Of a vector over x. [size]
  Eigen::VectorXd Of(const Eigen::VectorXd& x) const { return x.segment(begin, size); }
};

/// The parts of x. One that a fit lacks is empty.
struct Layout {
  Slice law;      // parameters of the law
  Slice heat;     // gain and log(tau)
  Slice start;    // E(0) of the first recording
  Slice jumps;    // changes of E that no logged loss tells, at gaps and further starts
  Slice rigid;    // gravity and inertia
  Slice weights;  // of the kernels of maps

  /// A part, and how many unknowns it has.
  struct Part {
    Slice Layout::*part;
    Eigen::Index size;
  };
  /// With these parts in this order.
  static Layout InOrder(const std::vector<Part>& parts) {
    Layout layout;
    Eigen::Index next = 0;
    for (const Part& one : parts) {
      layout.*one.part = {next, one.size};
      next += one.size;
    }
    return layout;
  }

  /// The same parts in another order.
  Layout Reordered(std::initializer_list<Slice Layout::*> order) const {
    std::vector<Part> parts;
    for (const auto part : order) parts.push_back({part, (this->*part).size});
    return InOrder(parts);
  }

  Eigen::Index size() const {
    return law.size + heat.size + start.size + jumps.size + rigid.size + weights.size;
  }
  Eigen::Index gain() const { return heat.begin; }
  Eigen::Index log_time_constant() const { return heat.begin + 1; }

  /// Where the unknowns of another order of the same parts stand here. [size]
  std::vector<Eigen::Index> PlacesOf(const Layout& other) const {
    std::vector<Eigen::Index> places(static_cast<size_t>(size()));
    for (const auto part : {&Layout::law, &Layout::heat, &Layout::start, &Layout::jumps,
                            &Layout::rigid, &Layout::weights}) {
      const Slice& there = other.*part;
      std::iota(places.begin() + there.begin, places.begin() + there.end(), (this->*part).begin);
    }
    return places;
  }
};

}  // namespace warmjoint
