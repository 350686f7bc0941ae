// Options of identifiers with maps, and maps and their axes made for the motion that was seen.
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "identification/maps/map_choice.h"
#include "identification/options.h"

namespace warmjoint {

/// Whether bands along maps are made.
enum class MapBands { wide, none };
inline std::span<const Word<MapBands>> WordsOf(MapBands) {
  static constexpr std::array words{Word{"wide", MapBands::wide}, Word{"none", MapBands::none}};
  return words;
}

/// Options that all identifiers with maps share.
struct MapOptions {
  KernelKind kernel = KernelKind::normalised;
  double width = 0;     // in spacings of the centres; 0: chosen
  double strength = 0;  // 0: chosen
  StrengthRule selection = StrengthRule::cross_validation;
  int folds = 5;
  MapBands bands = MapBands::wide;

  /// The width that is given, or those to choose from.
  std::vector<double> Widths() const {
    return width > 0 ? std::vector{width} : std::vector{0.7, 1.0, 1.5};
  }

  template <class A>
  void Serialize(A* a) {
    a->Field("kernel", &kernel,
             {.meaning = "normalised kernels keep the value of the nearest centre outside of the "
                         "data, (16)"});
    a->Field("width", &width,
             {.bounds = {.at_least = 0},
              .meaning = "width of the kernels in spacings of their centres; 0: chosen from 0.7, "
                         "1 and 1.5"});
    a->Field(
        "strength", &strength,
        {.bounds = {.at_least = 0}, .meaning = "of the prior on the kernels' weights; 0: chosen"});
    a->Field("selection", &selection,
             {.meaning = "what chooses: cross validation over contiguous parts, leave-one-out, or "
                         "the evidence; the last two take coloured noise for friction"});
    a->Field("folds", &folds,
             {.bounds = {.at_least = 2, .at_most = 100},
              .meaning = "contiguous parts of the recording for cv"});
    a->Field("bands", &bands,
             {.meaning = "along the maps: wide enough for what twice the kernels follow; none: "
                         "left out, with the harmonics of a motor's map, for twice the speed"});
  }
};

/// The quantities over which a map over position has its kernels.
enum class MapBasis { position, direction, velocity };
inline std::span<const Word<MapBasis>> WordsOf(MapBasis) {
  static constexpr std::array words{Word{"position", MapBasis::position},
                                    Word{"direction", MapBasis::direction},
                                    Word{"velocity", MapBasis::velocity}};
  return words;
}

/// Options of a map over position.
struct PositionMapOptions {
  MapBasis basis = MapBasis::direction;
  int kernels = 0;
  int velocity_kernels = 3;

  template <class A>
  void Serialize(A* a) {
    a->Field("basis", &basis,
             {.meaning = "kernels over position alone (10), one part for each direction of motion, "
                         "or over position x velocity (14)"});
    a->Field("kernels", &kernels,
             {.bounds = {.at_least = 0, .at_most = 128},
              .meaning = "kernels over position; 0: chosen from 10, 20, 40, 80 and 128"});
    a->Field("velocity_kernels", &velocity_kernels,
             {.bounds = {.at_least = 1, .at_most = 64},
              .meaning = "kernels over speed for each direction, with basis velocity"});
  }
};

/// Passes fields on to a visitor. Their meanings say that they belong to a map that is added to something else.
template <class A>
struct OfTheMap {
  A* visitor;

  template <class T>
  void Field(std::string_view name, T* value, FieldInfo info) {
    const std::string meaning = fmt::format("of the map: {}", info.meaning);
    info.meaning = meaning;
    visitor->Field(name, value, info);
  }
};

/// Options of a map over position, for identifiers that can do without one.
struct AddedMapOptions : MapOptions, PositionMapOptions {
  template <class A>
  void Serialize(A* a) {
    OfTheMap<A> of_the_map{a};
    MapOptions::Serialize(&of_the_map);
    PositionMapOptions::Serialize(&of_the_map);
  }
};

/// The shapes of each width to choose from. maps(width): those of one width, in spacings
template <typename Maps>
MapShapes ForEachWidth(const MapOptions& options, const Maps& maps) {
  MapShapes shapes;
  for (const double width : options.Widths()) shapes.push_back(maps(width));
  return shapes;
}

/// Even centres over the range of one quantity at the samples, N.m or SI; `width` spacings wide.
/// points: [n x 5] of the kept samples.
MapAxis RangeAxis(MapQuantity quantity, const MapPoints& points, int count, double width);

/// Centres at the speeds that the samples hold, `count` at most for each direction of motion. The directions are separate,
/// and the kernels so narrow that between two of them a normalised map holds the value of the nearer. Where the samples are at
/// all speeds, the centres are even over these. A count of 1 distinguishes the directions and nothing else.
MapAxis VelocityAxis(const MapPoints& points, int count, double width);

/// Even centres over one turn of the motor or of the joint, 2 pi rad, on a circle.
MapAxis TurnAxis(MapQuantity angle, int count, double width);

/// `count` kernels over position for each of `speeds` bins of either direction of motion; alike in
/// both directions where there are none. points: [n x 5] kept; width: in spacings.
FrictionMap PositionMap(const MapPoints& points, KernelKind kernels, int count, double width,
                        int speeds = 1);

/// The shapes to choose from, as options with MapOptions and PositionMapOptions say: every number of kernels with every
/// width. points: [n x 5] kept.
MapShapes PositionMaps(const Options& options, const MapPoints& points);

/// Why a quantity cannot carry a map: not a number at some sample, or the same at all. Empty where
/// it can.
std::optional<std::string> CannotCarry(MapQuantity quantity, const MapPoints& points);

}  // namespace warmjoint
