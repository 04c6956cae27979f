// Thinned cells are as many as were asked for, spread evenly, and those of a smaller share are among
// those of a larger one.
#include "index/detail/cell_thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace isochron::index {
namespace {

using ThinPlace = std::array<std::uint32_t, 3>;

TEST(CellThinning, KeepsAboutAsManyAsAskedForEverywhere) {
    constexpr std::uint32_t kEdge = 64, kBlock = 16;
    for (const std::uint64_t parts : {2, 3, 8, 50}) {
        const CellThinning thinning(kEdge * kEdge * kEdge, kEdge * kEdge * kEdge / parts);
        std::size_t kept = 0;
        std::array<std::size_t, 64> of_block{};
        for (std::uint32_t z = 0; z < kEdge; ++z)
            for (std::uint32_t y = 0; y < kEdge; ++y)
                for (std::uint32_t x = 0; x < kEdge; ++x)
                    if (thinning.keeps({x, y, z})) {
                        ++kept;
                        ++of_block[x / kBlock + 4 * (y / kBlock) + 16 * (z / kBlock)];
                    }
        const auto expect_near = [&](double wanted, std::size_t found) {
            EXPECT_NEAR(static_cast<double>(found), wanted, 5 * std::sqrt(wanted)) << parts;
        };
        const auto share = 1.0 / static_cast<double>(parts);
        expect_near(share * kEdge * kEdge * kEdge, kept);
        for (const std::size_t found : of_block)
            expect_near(share * kBlock * kBlock * kBlock, found);
    }
}

TEST(CellThinning, KeepsAllWhereTheyAreFewAndNoneOfNone) {
    for (const std::uint64_t all : {0, 1, 1000}) {
        EXPECT_TRUE(CellThinning(all, all).keeps_all());
        EXPECT_TRUE(CellThinning(all, 2 * all + 1).keeps({7, 8, 9}));
    }
    for (std::uint32_t x = 0; x < 100; ++x)
        EXPECT_FALSE(CellThinning(10, 0).keeps({x, 3, 4}));
}

TEST(CellThinning, WhatStaysOfASmallShareStaysOfALargerOne) {
    const auto kept = [](std::uint64_t most) {
        std::set<ThinPlace> places;
        const CellThinning thinning(1000, most);
        for (std::uint32_t x = 0; x < 1000; ++x)
            if (const ThinPlace at{x, x % 7, x / 9}; thinning.keeps(at))
                places.insert(at);
        return places;
    };
    std::set<ThinPlace> fewer;
    for (const std::uint64_t most : {10, 100, 400, 900, 1000}) {
        const std::set<ThinPlace> more = kept(most);
        EXPECT_TRUE(std::ranges::includes(more, fewer));
        EXPECT_GT(more.size(), fewer.size());
        fewer = more;
    }
}

} // namespace
} // namespace isochron::index
