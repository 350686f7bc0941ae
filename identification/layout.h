// The places of a fit's unknowns in its vector x: the one index arithmetic of fits of law and heat, with maps or gravity,
// of those of Stribeck and LuGre, and of filters.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <vector>

namespace warmjoint {

/// Unknowns that are contiguous in x.
struct Slice {
  Eigen::Index begin = 0, size = 0;

  constexpr Eigen::Index end() const { return begin + size; }
  /// This part of a vector over x. [size]
  Eigen::VectorXd Of(const Eigen::VectorXd& x) const { return x.segment(begin, size); }
  /// The same to be written to.
  auto In(Eigen::VectorXd& x) const { return x.segment(begin, size); }
  /// This part of a matrix over x and x. [size x size]
  Eigen::MatrixXd Block(const Eigen::MatrixXd& of) const {
    return of.block(begin, begin, size, size);
  }
};

/// The parts of x. One that a fit lacks is empty.
struct Layout {
  Slice law;      // parameters of the law; where its level falls with speed, those before vs
  Slice shape;    // of a law whose level falls: log(vs); with a bristle log(sigma0), sigma1, too
  Slice heat;     // gain and log(tau)
  Slice start;    // E(0) of the first recording; E now in a filter
  Slice jumps;    // changes of E that no logged loss explains, at gaps and further starts
  Slice rigid;    // gravity and inertia
  Slice weights;  // of the kernels of maps

  /// A part, and how many unknowns it has.
  struct Part {
    Slice Layout::*part;
    Eigen::Index size;
  };
  /// A layout with these parts in this order.
  static constexpr Layout InOrder(std::initializer_list<Part> parts) {
    Layout layout;
    Eigen::Index next = 0;
    for (const Part& one : parts) {
      layout.*one.part = {next, one.size};
      next += one.size;
    }
    return layout;
  }

  /// The same parts in another order.
  template <typename... Parts>
  Layout Reordered(Parts... order) const {
    return InOrder({{order, (this->*order).size}...});
  }

  constexpr Eigen::Index size() const {
    return law.size + shape.size + heat.size + start.size + jumps.size + rigid.size + weights.size;
  }
  constexpr Eigen::Index log_vs() const { return shape.begin; }
  constexpr Eigen::Index log_stiffness() const { return shape.begin + 1; }
  constexpr Eigen::Index damping() const { return shape.begin + 2; }
  constexpr Eigen::Index gain() const { return heat.begin; }
  constexpr Eigen::Index log_time_constant() const { return heat.begin + 1; }
  constexpr Eigen::Index energy() const { return start.begin; }
  constexpr Eigen::Index inertia() const { return rigid.end() - 1; }

  /// The warming at x, of a fit with heat.
  Thermal ThermalAt(const Eigen::VectorXd& x) const {
    return {x[gain()], std::exp(x[log_time_constant()])};
  }

  /// The places here of the unknowns of another order of the same parts. [size]
  std::vector<Eigen::Index> PlacesOf(const Layout& other) const {
    std::vector<Eigen::Index> places(static_cast<size_t>(size()));
    for (const auto part : {&Layout::law, &Layout::shape, &Layout::heat, &Layout::start,
                            &Layout::jumps, &Layout::rigid, &Layout::weights}) {
      const Slice& there = other.*part;
      std::iota(places.begin() + there.begin, places.begin() + there.end(), (this->*part).begin);
    }
    return places;
  }
};

/// Unknowns of a fit, and how well they fit.
struct FitPoint {
  Eigen::VectorXd x;   // [p] as Layout has it
  double squares = 0;  // sum of squared residuals over the samples that count
};

}  // namespace warmjoint
