#include "tools/report/page/contact_sheet.h"

#include <gtest/gtest.h>

#include "tests/tools/report/look.h"

namespace warmjoint::report {
namespace {

TEST(ContactSheet, ShowsEveryPictureInItsPlaceUnderItsName) {
  const Rgb colours[] = {{200, 30, 30}, {30, 160, 30}, {30, 30, 200}};
  std::vector<std::pair<std::string, Image>> pictures;
  for (Rgb colour : colours) {
    Image image{400, 300, {}};
    for (int i = 0; i < 400 * 300; ++i) {
      image.pixels.insert(image.pixels.end(), {colour.red, colour.green, colour.blue});
    }
    pictures.emplace_back("picture " + std::to_string(pictures.size()), image);
  }
  const Figure sheet = MakeContactSheet(pictures, 2, 500);
  const Drawn drawn = DrawLight(sheet);
  ASSERT_EQ(drawn.pictures.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Rectangle& place = drawn.pictures[i];
    EXPECT_NEAR(place.width() / place.height(), 400.0 / 300, 0.02) << "in proportion";
    const Pixel middle{static_cast<int>(place.left + place.right),
                       static_cast<int>(place.top + place.bottom)};
    EXPECT_EQ(drawn.image.At(middle.x, middle.y), colours[i]);
    EXPECT_EQ(drawn.texts[i].text, "picture " + std::to_string(i));
    EXPECT_LE(drawn.texts[i].place.bottom, place.top + 1);
  }
  EXPECT_GT(drawn.pictures[2].top, drawn.pictures[0].bottom) << "a second row";
}

TEST(ContactSheet, PutsPicturesOfLikeProportionsIntoOneRow) {
  const auto blank = [](int width, int height) {
    return Image{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 99)};
  };
  const Figure sheet = MakeContactSheet(
      {{"high", blank(30, 90)}, {"flat", blank(90, 30)}, {"higher", blank(30, 93)}}, 2, 500);
  EXPECT_EQ(sheet.panels[0].title, "flat");
  EXPECT_EQ(sheet.panels[2].title, "higher");
}

}  // namespace
}  // namespace warmjoint::report
