#include "tools/scene/image.h"

#include <cassert>

namespace warmjoint::scene {

Image Shrink(const Image& image, int factor) {
  assert(image.width % factor == 0 && image.height % factor == 0);
  Image small{image.width / factor, image.height / factor, {}};
  small.pixels.resize(std::size_t{3} * small.width * small.height);
  const unsigned area = static_cast<unsigned>(factor * factor);
  std::size_t target = 0;
  // each pixel is the mean of those that it covers
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        unsigned sum = area / 2;  // rounds to the nearest
        for (int row = y * factor; row < (y + 1) * factor; ++row) {
          for (int column = x * factor; column < (x + 1) * factor; ++column) {
            sum +=
                image.pixels[3 * (static_cast<std::size_t>(row) * image.width + column) + channel];
          }
        }
        small.pixels[target++] = static_cast<std::uint8_t>(sum / area);
      }
    }
  }
  return small;
}

}  // namespace warmjoint::scene
