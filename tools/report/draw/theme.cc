#include "tools/report/draw/theme.h"

#include <string_view>
#include <utility>

#include "identification/identifiers/identifier_list.h"

namespace warmjoint::report {

const Theme& LightTheme() {
  static const Theme theme{
      "light",
      {255, 255, 255},
      {28, 32, 38},
      {84, 91, 102},
      {110, 117, 128},
      {226, 229, 234},
      {241, 243, 245},
      {{28, 32, 38},
       {128, 134, 143},
       {0, 114, 178},
       {213, 94, 0},
       {0, 140, 102},
       {170, 77, 140},
       {214, 143, 0},
       {67, 165, 222},
       {150, 92, 0}},
  };
  return theme;
}

const Theme& DarkTheme() {
  static const Theme theme{
      "dark",
      {22, 25, 30},
      {232, 235, 240},
      {168, 175, 186},
      {134, 141, 152},
      {50, 55, 63},
      {36, 40, 47},
      {{232, 235, 240},
       {146, 152, 162},
       {76, 166, 226},
       {240, 128, 60},
       {48, 184, 142},
       {216, 138, 190},
       {236, 176, 62},
       {140, 204, 244},
       {246, 190, 80}},
  };
  return theme;
}

const Theme& PaperTheme() {
  static const Theme theme = [] {
    Theme paper = LightTheme();
    paper.name = "paper";
    paper.text = paper.faint_text = paper.axis =
        paper.hues[static_cast<int>(Hue::text)] = {0, 0, 0};
    paper.hues[static_cast<int>(Hue::grey)] = {115, 115, 115};
    return paper;
  }();
  return theme;
}

Hue IdentifierHue(const std::string& of) {
  const std::string identifier = CurrentName(of);
  // identifiers of this project have colours of their own
  static constexpr std::pair<std::string_view, Hue> kKnown[] = {
      {"nominal-ls", Hue::grey},      {"energy-als", Hue::vermilion},
      {"energy-ml", Hue::blue},       {"rls", Hue::green},
      {"motor-ridge", Hue::purple},   {"kalman", Hue::sky},
      {"position-ridge", Hue::orange}};
  for (const auto& [name, hue] : kKnown) {
    if (name == identifier) return hue;
  }
  // any other has one by its letters, the same in every picture
  static constexpr Hue kOthers[] = {Hue::green, Hue::purple, Hue::orange, Hue::sky};
  std::size_t sum = 0;
  for (char letter : identifier) sum += static_cast<unsigned char>(letter);
  return kOthers[sum % std::size(kOthers)];
}

}  // namespace warmjoint::report
