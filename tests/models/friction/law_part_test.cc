#include "models/friction/law_part.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "models/friction/joint_friction.h"

namespace warmjoint {
namespace {

TEST(LawPart, IsALevelInEveryLawAndAnythingElseAtMostOnce) {
  for (const Law& law : Laws()) {
    EXPECT_TRUE(PlaceOf(LawPart::level, law)) << law.name;
    for (const LawPart part :
         {LawPart::slope, LawPart::rest_level, LawPart::rest_rise, LawPart::bristle}) {
      const auto is_part = [&](const ParameterInfo& info) { return info.part == part; };
      EXPECT_LE(std::ranges::count_if(law.parameters, is_part), 1) << law.name;
    }
  }
}

TEST(LawPart, IsTheSameForANameInEveryLaw) {
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) EXPECT_EQ(PartOf(info.name), info.part);
  }
}

TEST(LawPart, IsOtherForWhatNoLawHas) { EXPECT_EQ(PartOf("thermal_gain"), LawPart::other); }

TEST(LawPart, TellsTheSlopeOfEveryForce) {
  for (const Law& law : Laws()) {
    const std::optional<size_t> place = PlaceOf(LawPart::slope, law);
    if (!place) continue;
    std::vector<double> p(law.parameters.size(), 2.0);
    const double before = law.force(0.5, p.data());
    p[*place] += 1;
    // one difference of numbers near 3
    EXPECT_NEAR(law.force(0.5, p.data()) - before, 0.5, 1e-15) << law.name;
  }
}

TEST(LawPart, TellsTheBristleOfEveryLawThatBringsOne) {
  for (const Law& law : Laws()) {
    FrictionDescription friction;
    friction.law = law.name;
    friction.parameters.clear();
    for (const ParameterInfo& info : law.parameters)
      friction.parameters[std::string(info.name)] = 2;
    const std::optional<size_t> place = PlaceOf(LawPart::bristle, law);
    if (place) friction.parameters[std::string(law.parameters[*place].name)] = 300;
    const std::optional<Bristle> own = JointFriction(friction).own_bristle();
    EXPECT_EQ(place.has_value(), law.pre_sliding == PreSliding::bristle) << law.name;
    ASSERT_EQ(own.has_value(), place.has_value()) << law.name;
    if (!own) continue;
    EXPECT_EQ(own->stiffness, 300) << law.name;
  }
}

}  // namespace
}  // namespace warmjoint
