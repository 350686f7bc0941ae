// Options that all identifiers with maps share, and axes of maps made for the motion that was seen.
#pragma once

#include <string>
#include <vector>

#include "identification/maps/map_choice.h"
#include "identification/options.h"

namespace warmjoint::inline identification {

/// law, kernel, width, strength, selection, folds, bands.
std::vector<OptionInfo> MapOptions();

/// What they say.
struct MapSettings {
  std::string law;
  KernelKind kernels = KernelKind::normalised;
  std::vector<double> widths;  // in spacings of the centres: the one given, or those to choose from
  double strength = 0;         // 0: chosen
  StrengthRule rule = StrengthRule::cross_validation;
  int folds = 5;
  bool has_bands = true;
};
MapSettings ReadMapSettings(const Options& options);

/// Even centres over the range of one quantity at the samples, N.m or SI; `width` spacings wide.
/// points: [n x 5] of the kept samples.
MapAxis RangeAxis(MapQuantity quantity, const MapPoints& points, int count, double width);

/// Even centres over the speeds, `count` for each direction of motion, one side apart from the
/// other. A count of 1 tells the directions apart and nothing else.
MapAxis VelocityAxis(const MapPoints& points, int count, double width);

/// Even centres over one turn of the motor or of the joint, 2 pi rad, on a circle.
MapAxis TurnAxis(MapQuantity angle, int count, double width);

/// Why a quantity cannot carry a map: not a number at some sample, or the same at all. Empty where
/// it can.
std::optional<std::string> CannotCarry(MapQuantity quantity, const MapPoints& points);

}  // namespace warmjoint::inline identification
