#include "models/friction/gaussian_axis.h"

namespace warmjoint::inline models {
namespace {

/// The width of one spacing; of the range's own size where there is one centre alone.
double Spacing(double first, double last, int count) {
  if (count > 1) return (last - first) / (count - 1);
  return last != first ? std::abs(last - first) : 1;
}

}  // namespace

GaussianAxis EvenAxis(double first, double last, int count) {
  GaussianAxis axis;
  axis.width = Spacing(first, last, count);
  for (int i = 0; i < count; ++i) axis.centres.push_back(first + i * axis.width);
  return axis;
}

GaussianAxis CircleAxis(double period, int count) {
  GaussianAxis axis;
  axis.width = period / count;
  axis.period = period;
  for (int i = 0; i < count; ++i) axis.centres.push_back(i * axis.width);
  return axis;
}

GaussianAxis SpeedAxis(double lowest, double highest, int count) {
  GaussianAxis axis;
  axis.sides = Sides::apart;
  axis.width = Spacing(lowest, highest, count);
  // the same speeds in both directions, ascending
  for (int i = count - 1; i >= 0; --i) axis.centres.push_back(-(lowest + i * axis.width));
  for (int i = 0; i < count; ++i) axis.centres.push_back(lowest + i * axis.width);
  return axis;
}

}  // namespace warmjoint::inline models
