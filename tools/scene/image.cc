#include "tools/scene/image.h"

#include <png.h>

#include <cassert>
#include <cmath>
#include <stdexcept>

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

std::string EncodePng(const Image& image) {
  std::string bytes;
  // errors of the library are thrown, its bytes are gathered in a text
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr,
      [](png_structp, png_const_charp message) { throw std::runtime_error(message); }, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, png_size_t size) {
        static_cast<std::string*>(png_get_io_ptr(writer))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      nullptr);
  // red, green and blue, eight bits each
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);

  // how large the picture is meant to be on paper
  constexpr double kInchesPerMetre = 1 / 0.0254, kDpi = 144;
  const auto per_metre = static_cast<png_uint_32>(std::lround(kInchesPerMetre * kDpi));
  png_set_pHYs(png, info, per_metre, per_metre, PNG_RESOLUTION_METER);

  // rows from above
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    png_write_row(png, &image.pixels[std::size_t{3} * image.width * y]);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace warmjoint::scene
