// Stretches of a log over which its positions change in one direction.
#pragma once

#include <warmjoint/recording.h>

#include <vector>

namespace warmjoint {

/// Samples first to last, both included.
struct Stretch {
  Eigen::Index first = 0, middle = 0, last = 0;
  double change = 0;    // of the position, rad or m
  double duration = 0;  // s
};

/// Stretches of equally many samples that do not overlap, chosen by the positions alone, with holds
/// or without: a quarter to three quarters of the change lie before the middle, the change is 20
/// deviations of the position's noise or more, and 1 % or more of the typical one (the median, each weighted by
/// itself, so that rests do not count). Of 4, 8, 16, ... samples the longest is taken that shows four fifths of
/// the change that the best shows. None spans a gap, or turns that a sensor may hide between samples.
std::vector<Stretch> FindStretches(const Measurements& measurements);

}  // namespace warmjoint
