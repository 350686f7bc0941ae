#include "models/foundation/matrix_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace warmjoint {
namespace {

using nlohmann::json;

TEST(MatrixJson, ReadsBackRowByRow) {
  const Eigen::Matrix2d matrix = (Eigen::Matrix2d() << 1, 2, 3, 0.1).finished();
  EXPECT_EQ(MatrixToJson(matrix), json({{1.0, 2.0}, {3.0, 0.1}}));
  EXPECT_EQ(SquareFromJson(MatrixToJson(matrix), 2, "m", {"here"}), matrix);
  EXPECT_EQ(SquareFromJson(json::array(), 0, "m", {"here"}).size(), 0);
}

TEST(MatrixJson, TakesNullForWhatIsNotKnown) {
  const auto text = MatrixToJson(Eigen::MatrixXd::Constant(1, 1, INFINITY)).dump();
  EXPECT_EQ(text, "[[null]]");
  EXPECT_TRUE(std::isnan(SquareFromJson(json::parse(text), 1, "m", {"here"})(0, 0)));
}

TEST(MatrixJson, RefusesOtherShapes) {
  for (const char* text : {"null", "[]", "[[1]]", "[[1,2],[3]]", "[[1,2],[3,\"x\"]]", "[1,2]"}) {
    EXPECT_THROW(SquareFromJson(json::parse(text), 2, "m", {"here"}), BadInput) << text;
  }
}

}  // namespace
}  // namespace warmjoint
