// SPDX-License-Identifier: GPL-3.0-or-later
#include "index_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <unordered_map>

namespace mrc {
namespace {

TEST(NumberedKeys, have_the_number_of_their_first_meeting) {
    for (const int reserved : {0, 10, 100000}) {
        std::mt19937 random(3);
        IndexMap map;
        map.reserve(reserved);
        std::unordered_map<int, int> expected;
        for (int i = 0; i < 20000; ++i) {
            // Dense keys, keys far apart, and the ends of the range.
            const int key = i % 3 == 0   ? i / 5
                            : i % 3 == 1 ? static_cast<int>(random() >> 1U)
                                         : std::numeric_limits<int>::max() - i % 50;
            EXPECT_EQ(map.find(key), expected.contains(key) ? expected[key] : -1);
            const int number = expected.emplace(key, static_cast<int>(expected.size())).first->second;
            ASSERT_EQ(map.insert(key), number);
            ASSERT_EQ(map.size(), static_cast<int>(expected.size()));
        }
        for (const auto& [key, number] : expected) EXPECT_EQ(map.find(key), number);
        EXPECT_EQ(map.find(1'000'000), -1);
    }
}

}  // namespace
}  // namespace mrc
