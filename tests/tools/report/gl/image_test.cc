#include "tools/report/gl/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

namespace warmjoint::report {
namespace {

TEST(Image, ShrinksToTheMean) {
  const Image image{2, 2, {0, 0, 0, 10, 0, 0, 20, 0, 0, 30, 4, 0}};
  EXPECT_EQ(Shrink(image, 2).At(0, 0), (Rgb{15, 1, 0}));
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

TEST(Png, SaysHowLargeItIsOnPaper) {
  const std::string bytes = EncodePng({1, 1, {0, 0, 0}}, "", 300);
  // 300 pixels an inch are 11811 a metre
  EXPECT_NE(bytes.find(std::string("pHYs\0\0\x2E\x23\0\0\x2E\x23\x01", 13)), bytes.npos);
}

}  // namespace
}  // namespace warmjoint::report
