// SPDX-License-Identifier: GPL-3.0-or-later
#include "elementary_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace mrc {
namespace {

using elementary::atan2, elementary::cos, elementary::exp, elementary::pow, elementary::sin;
using std::numbers::pi;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How far a value is from the true one, in units of its last place.
double units_off(double value, long double truth) {
    const auto rounded = static_cast<double>(truth);
    if (!std::isfinite(value)) return value == rounded || (std::isnan(value) && std::isnan(rounded)) ? 0.0 : infinity;
    const double size = std::abs(rounded), unit = std::nextafter(size, infinity) - size;
    return static_cast<double>(std::abs(value - truth)) / unit;
}

/// Numbers of either sign and of every size up to the limits.
class Numbers {
  public:
    double within(double limit) { return std::uniform_real_distribution<double>(-limit, limit)(random_); }
    double of_any_size() { return std::ldexp(within(1.0), std::uniform_int_distribution<int>(-1060, 1023)(random_)); }

  private:
    std::mt19937 random_{1993};
};

constexpr int many = 200000;

}  // namespace

// The system's functions of long doubles serve as the truth, where these have more bits and the functions use them: on Windows,
// sines of large numbers do not.
class NearlyExact : public testing::Test {
  protected:
    void SetUp() override {
#ifdef _WIN32
        GTEST_SKIP() << "the system's functions of long doubles are no better";
#endif
        if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "long doubles are no longer than doubles";
    }
    Numbers numbers_;
};

TEST_F(NearlyExact, SineAndCosine) {
    for (int i = 0; i < many; ++i) {
        for (const double x : {numbers_.within(4.0), numbers_.within(1e6), numbers_.of_any_size()}) {
            ASSERT_LT(units_off(sin(x), std::sin(static_cast<long double>(x))), 1.0) << x;
            ASSERT_LT(units_off(cos(x), std::cos(static_cast<long double>(x))), 1.0) << x;
        }
    }
}

/// Of the quotient y / x, which is rounded itself.
TEST_F(NearlyExact, ArcTangent) {
    for (int i = 0; i < many; ++i) {
        const double a = numbers_.within(1.0), b = numbers_.within(1.0), c = numbers_.of_any_size(), d = numbers_.of_any_size();
        for (const auto& [y, x] : {std::pair(a, b), std::pair(c, d), std::pair(a, c)})
            ASSERT_LT(units_off(atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))), 2.0)
                << y << " " << x;
    }
}

TEST_F(NearlyExact, Exponential) {
    for (int i = 0; i < many; ++i) {
        for (const double x : {numbers_.within(1.0), numbers_.within(800.0), numbers_.of_any_size()})
            ASSERT_LT(units_off(exp(x), std::exp(static_cast<long double>(x))), 1.0) << x;
    }
}

TEST_F(NearlyExact, Power) {
    for (int i = 0; i < many; ++i) {
        for (const double x : {std::abs(numbers_.within(1.0)), std::abs(numbers_.of_any_size())}) {
            for (const double y : {numbers_.within(16.0), numbers_.of_any_size()})
                ASSERT_LT(units_off(pow(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y))), 1.0)
                    << x << " " << y;
        }
    }
}

TEST(ElementaryFunctions, KnownValues) {
    EXPECT_EQ(sin(0.0), 0.0);
    EXPECT_EQ(sin(pi / 2), 1.0);
    EXPECT_EQ(cos(0.0), 1.0);
    EXPECT_EQ(cos(pi), -1.0);
    EXPECT_EQ(exp(0.0), 1.0);
    EXPECT_EQ(exp(1.0), std::numbers::e);
    EXPECT_EQ(atan2(1.0, 1.0), pi / 4);
    EXPECT_EQ(atan2(1.0, 0.0), pi / 2);
    EXPECT_EQ(atan2(0.0, -1.0), pi);
    EXPECT_EQ(atan2(-0.0, -1.0), -pi);
    EXPECT_EQ(atan2(0.0, 0.0), 0.0);
    EXPECT_EQ(pow(0.0, 0.0), 1.0);
    EXPECT_EQ(pow(0.0, 0.5), 0.0);
    EXPECT_EQ(pow(2.0, -3.0), 0.125);
    EXPECT_EQ(pow(4.0, 0.5), 2.0);
    EXPECT_EQ(pow(-2.0, 3.0), -8.0);
    for (int n = -1074; n < 1024; ++n) ASSERT_EQ(pow(2.0, n), std::ldexp(1.0, n)) << n;
}

TEST(ElementaryFunctions, Limits) {
    EXPECT_EQ(exp(710.0), infinity);
    EXPECT_EQ(exp(-746.0), 0.0);
    EXPECT_EQ(exp(-infinity), 0.0);
    EXPECT_EQ(pow(10.0, 309.0), infinity);
    EXPECT_EQ(pow(10.0, -324.0), 0.0);
    EXPECT_EQ(pow(infinity, -1.0), 0.0);
    EXPECT_EQ(atan2(1.0, infinity), 0.0);
    EXPECT_EQ(atan2(infinity, -infinity), 0.75 * pi);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double value : {sin(nan), cos(infinity), exp(nan), pow(-1.0, 0.5), pow(nan, 2.0), atan2(nan, 1.0)})
        EXPECT_TRUE(std::isnan(value));
}

TEST(ElementaryFunctions, AreOddOrEvenToTheLastBit) {
    Numbers numbers;
    for (int i = 0; i < many; ++i) {
        const double x = numbers.within(10.0), y = numbers.within(10.0);
        ASSERT_EQ(sin(-x), -sin(x));
        ASSERT_EQ(cos(-x), cos(x));
        ASSERT_EQ(atan2(-y, x), -atan2(y, x));
        ASSERT_EQ(pow(-x, 3.0), -pow(x, 3.0));
    }
}

TEST(ElementaryFunctions, RiseAndFallAsTheyShould) {
    double last_power = 0.0, last_exponential = 0.0, last_angle = -pi / 2;
    for (int i = 1; i <= many; ++i) {
        const double x = 1e-4 * i;
        const double power = pow(x, 0.7), exponential = exp(x - 10.0), angle = atan2(x - 10.0, 1.0);
        ASSERT_TRUE(power > last_power && exponential > last_exponential && angle > last_angle) << x;
        last_power = power;
        last_exponential = exponential;
        last_angle = angle;
    }
}

}  // namespace mrc
