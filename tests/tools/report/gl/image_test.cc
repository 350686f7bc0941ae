#include "tools/report/gl/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>

#include "models/foundation/bad_input.h"

namespace warmjoint::report {
namespace {

TEST(Image, ShrinksToTheMean) {
  const Image image{2, 2, {0, 0, 0, 10, 0, 0, 20, 0, 0, 30, 4, 0}};
  EXPECT_EQ(Shrink(image, 2).At(0, 0), (Rgb{15, 1, 0}));
}

TEST(Image, PastesStretchedAndClipped) {
  Image target{4, 2, std::vector<std::uint8_t>(24, 9)};
  Paste({1, 1, {50, 60, 70}}, 2, -1, 4, 2, target);
  EXPECT_EQ(target.At(2, 0), (Rgb{50, 60, 70}));
  EXPECT_EQ(target.At(3, 0), (Rgb{50, 60, 70}));
  EXPECT_EQ(target.At(1, 0), (Rgb{9, 9, 9}));
  EXPECT_EQ(target.At(2, 1), (Rgb{9, 9, 9}));
}

TEST(Png, ReadsBackBitForBitWithItsDescription) {
  const Image image{3, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18}};
  const std::string bytes = EncodePng(image, "what one sees");
  EXPECT_NE(bytes.find("what one sees"), std::string::npos);
  EXPECT_EQ(EncodePng(image, "what one sees"), bytes);

  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()));
  reader.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(reader));
  ASSERT_TRUE(png_image_finish_read(&reader, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(pixels, image.pixels);
}

TEST(Png, LeavesNothingBehindWhereItCannotBeWritten) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "no such folder";
  EXPECT_THROW(WritePng({1, 1, {0, 0, 0}}, "", folder / "x.png"), BadInput);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace warmjoint::report
