// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_text.h"

#include <mrc/options.h>

#include <gtest/gtest.h>

#include <limits>
#include <locale>
#include <string>

namespace mrc {
namespace {

/// Numbers as in German.
class Punctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

class NumberText : public testing::Test {
  public:
    ~NumberText() override { std::locale::global(before_); }

  private:
    std::locale before_ = std::locale::global(std::locale(std::locale(), new Punctuation));
};

}  // namespace

TEST_F(NumberText, IsTheSameInEveryLanguage) {
    EXPECT_EQ(number_text(0.5), "0.5");
    EXPECT_EQ(number_text(123456.0), "123456");
    EXPECT_EQ(number_text(1e50), "1e+50");
    EXPECT_EQ(number_text(2.0 / 3.0, 3), "0.667");
}

TEST_F(NumberText, NamesWhatIsNoNumber) {
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(number_text(infinity), "inf");
    EXPECT_EQ(number_text(-infinity), "-inf");
    EXPECT_EQ(number_text(nan), "nan");
    EXPECT_EQ(number_text(-nan), "nan");
}

TEST_F(NumberText, MessagesUseIt) {
    Options options;
    options.kappa0_factor = -1234.5;
    try {
        options.check();
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("-1234.5"), std::string::npos) << error.what();
    }
}

}  // namespace mrc
