// Pictures in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace warmjoint::scene {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  bool operator==(const Rgb&) const = default;
};

/// A picture; pixels: [height x width x 3] bytes, rows from the top.
struct Image {
  int width = 0;   // pixels
  int height = 0;  // pixels
  std::vector<std::uint8_t> pixels;

  Rgb At(int x, int y) const {
    const std::uint8_t* p = &pixels[3 * (static_cast<std::size_t>(y) * width + x)];
    return {p[0], p[1], p[2]};
  }
};

/// The mean of each block of factor x factor pixels; width and height must be multiples of factor.
Image Shrink(const Image& image, int factor);

}  // namespace warmjoint::scene
