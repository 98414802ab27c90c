#include "core/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace stereo_nav {
namespace {

TEST(Quantile, Interpolates) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({7.0}, 0.95), 7.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(UpperMedian, IsOneOfTheSamples) {
  std::vector<double> odd = {5.0, 1.0, 3.0};
  EXPECT_DOUBLE_EQ(upperMedian(odd), 3.0);
  std::vector<std::int64_t> even = {4, 1, 3, 2};
  EXPECT_EQ(upperMedian(even), 3);
  std::vector<double> none;
  EXPECT_THROW(upperMedian(none), std::invalid_argument);
}

TEST(ChiSquareQuantile, OfTheTables) {
  EXPECT_NEAR(chiSquareQuantile(1, 0.95), 3.841458821, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(2, 0.95), 5.991464547, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(3, 0.95), 7.814727903, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(3, 0.05), 0.351846318, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(4, 0.99), 13.276704136, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(5, 0.95), 11.070497694, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(6, 0.95), 12.591587244, 1e-8);
  EXPECT_NEAR(chiSquareQuantile(6, 0.99), 16.811893830, 1e-8);
  EXPECT_THROW(chiSquareQuantile(7, 0.95), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(3, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav
