#include "identification/lack_of_fit/power_spectra.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

TEST(PowerSpectra, AreSquaresOfTheSums) {
  RandomStream random({1, 0}, Stream::test);
  // powers of 4 and twice such, with zeros behind and without
  for (const Index length : {1, 2, 4, 8, 64, 128}) {
    for (const Index rows : {length, (length + 1) / 2}) {
      const MatrixXd columns = MatrixXd::NullaryExpr(rows, 2, [&] { return random.Normal(); });
      const MatrixXd squares = PowerSpectra(columns, length, length - 1);
      ASSERT_EQ(squares.rows(), length);
      for (Index k = 0; k < length; ++k) {
        for (Index column = 0; column < 2; ++column) {
          std::complex<double> sum = 0;
          for (Index n = 0; n < rows; ++n) {
            const double angle = -2 * std::numbers::pi * static_cast<double>(k * n % length) /
                                 static_cast<double>(length);
            sum += columns(n, column) * std::polar(1.0, angle);
          }
          // rounding of up to 128 sums of about 10
          EXPECT_NEAR(squares(k, column), std::norm(sum), 1e-11) << length << " " << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace warmjoint
