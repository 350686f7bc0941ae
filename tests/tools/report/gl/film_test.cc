#include "tools/report/gl/film.h"

#include <gtest/gtest.h>
#include <zlib.h>

namespace warmjoint::report {
namespace {

/// A picture of one colour.
Image Plain(Rgb colour) {
  Image image{6, 4, {}};
  for (int i = 0; i < 24; ++i) {
    image.pixels.insert(image.pixels.end(), {colour.red, colour.green, colour.blue});
  }
  return image;
}

struct Chunk {
  std::string type;
  std::string data;
  bool sound = false;  // the checksum fits
};

std::uint32_t Number(const std::string& bytes, std::size_t at, int count = 4) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

std::vector<Chunk> ChunksOf(const std::string& png) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::uint32_t length = Number(png, at);
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), length + 4);
    chunks.push_back(
        {png.substr(at + 4, 4), png.substr(at + 8, length), sum == Number(png, at + 8 + length)});
    at += 12 + length;
  }
  return chunks;
}

/// The first pixel of compressed rows.
Rgb FirstPixel(const std::string& data) {
  std::vector<Bytef> rows(4 * (1 + 3 * 6));
  uLongf size = rows.size();
  EXPECT_EQ(
      uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(data.data()), data.size()),
      Z_OK);
  // every filter of PNG leaves the first pixel of the first row as it is
  return {rows[1], rows[2], rows[3]};
}

TEST(Film, HoldsEveryFrameInOrder) {
  const Rgb colours[] = {{200, 10, 10}, {10, 200, 10}, {10, 10, 200}};
  std::vector<Image> frames;
  for (Rgb colour : colours) frames.push_back(Plain(colour));
  const std::string film = EncodeFilm(frames, 0.125, "three colours");

  std::string order;
  std::uint32_t number = 0;
  std::size_t frame = 0;
  for (const Chunk& chunk : ChunksOf(film)) {
    EXPECT_TRUE(chunk.sound) << chunk.type;
    order += chunk.type + " ";
    if (chunk.type == "acTL") {
      EXPECT_EQ(Number(chunk.data, 0), 3u);
    }
    if (chunk.type == "fcTL" || chunk.type == "fdAT") {
      EXPECT_EQ(Number(chunk.data, 0), number++) << "one sequence";
    }
    if (chunk.type == "fcTL") {
      EXPECT_EQ(Number(chunk.data, 4), 6u);
      EXPECT_EQ(Number(chunk.data, 8), 4u);
      EXPECT_EQ(Number(chunk.data, 20, 2), 125u) << "milliseconds";
      EXPECT_EQ(Number(chunk.data, 22, 2), 1000u);
    }
    if (chunk.type == "IDAT") {
      EXPECT_EQ(FirstPixel(chunk.data), colours[2]) << "what viewers without animation show";
    }
    if (chunk.type == "fdAT") {
      EXPECT_EQ(FirstPixel(chunk.data.substr(4)), colours[frame++]);
    }
  }
  EXPECT_EQ(order, "IHDR acTL pHYs iTXt IDAT fcTL fdAT fcTL fdAT fcTL fdAT IEND ");
  EXPECT_EQ(frame, 3u);
}

TEST(Film, IsTheSameBytesForTheSameFrames) {
  const std::vector<Image> frames{Plain({1, 2, 3}), Plain({4, 5, 6})};
  EXPECT_EQ(EncodeFilm(frames, 0.1, "a"), EncodeFilm(frames, 0.1, "a"));
}

}  // namespace
}  // namespace warmjoint::report
