// Levels of detail agree with their definition, and with searches at them.
#include "index/error.h"
#include "index/file/detail_levels.h"
#include "index/indexing/index_build.h"
#include "index/search/layer_search.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace isochron::index {
namespace {

using testing::HasSubstr;

/// Coordinates in level 0 of the vertices of a level along an axis.
std::vector<std::uint32_t> positions(std::uint32_t vertices, std::size_t level) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t at = 0; at < vertices; at += 1u << level)
        all.push_back(at);
    if (all.back() != vertices - 1)
        all.push_back(vertices - 1);
    return all;
}

/// The next level of a field, vertex by vertex.
template <class T>
std::vector<T> coarser_slowly(const std::array<std::uint32_t, 3>& n, std::size_t level,
                              const std::array<std::uint32_t, 3>& full,
                              const std::vector<T>& values) {
    using Sum = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;
    std::array<std::vector<std::uint32_t>, 3> here, next;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        here[axis] = positions(full[axis], level);
        next[axis] = positions(full[axis], level + 1);
        EXPECT_EQ(here[axis].size(), n[axis]);
    }
    const auto place = [&](std::size_t axis, std::uint32_t position) {
        return static_cast<int>(std::ranges::find(here[axis], position) - here[axis].begin());
    };
    /// Value and weight of (a + 2 b) + c along one axis, made of what `at` gives.
    const auto smooth = [](int middle, std::uint32_t count, auto&& at) {
        std::pair<Sum, Sum> sum{0, 0};
        bool first = true;
        for (const int d : {-1, 0, 1}) {
            if (middle + d < 0 || middle + d >= static_cast<int>(count))
                continue;
            auto [value, weight] = at(middle + d);
            if (d == 0) {
                value *= 2;
                weight *= 2;
            }
            sum = first ? std::pair<Sum, Sum>{value, weight}
                        : std::pair<Sum, Sum>{sum.first + value, sum.second + weight};
            first = false;
        }
        return sum;
    };
    std::vector<T> out;
    for (const std::uint32_t z : next[2])
        for (const std::uint32_t y : next[1])
            for (const std::uint32_t x : next[0]) {
                const auto [value, weight] = smooth(place(2, z), n[2], [&](int k) {
                    return smooth(place(1, y), n[1], [&](int j) {
                        return smooth(place(0, x), n[0], [&](int i) {
                            const T v = values[(static_cast<std::size_t>(k) * n[1] +
                                                static_cast<std::size_t>(j)) *
                                                   n[0] +
                                               static_cast<std::size_t>(i)];
                            return v == v ? std::pair<Sum, Sum>{static_cast<Sum>(v), 1}
                                          : std::pair<Sum, Sum>{0, 0};
                        });
                    });
                });
                if constexpr (std::is_floating_point_v<T>)
                    out.push_back(static_cast<T>(value / weight));
                else
                    out.push_back(static_cast<T>(std::floor(static_cast<long double>(value) /
                                                                static_cast<long double>(weight) +
                                                            0.5L)));
            }
    return out;
}

/// Every level of a step, [level][vertex]; the first is the step itself.
template <class T>
std::vector<std::vector<T>> levels_slowly(const StepValues& values, std::size_t step,
                                          std::size_t count) {
    const auto stored = values.step<T>(step);
    std::vector<std::vector<T>> levels{{stored.begin(), stored.end()}};
    std::array<std::uint32_t, 3> n = values.grid.vertices;
    for (std::size_t level = 0; level + 1 < count; ++level) {
        levels.push_back(coarser_slowly(n, level, values.grid.vertices, levels.back()));
        for (std::size_t axis = 0; axis < 3; ++axis)
            n[axis] =
                static_cast<std::uint32_t>(positions(values.grid.vertices[axis], level + 1).size());
    }
    return levels;
}

template <class T>
bool same_bits(std::span<const std::byte> got, const std::vector<T>& expected) {
    const auto* values = reinterpret_cast<const T*>(got.data());
    if (got.size() != expected.size() * sizeof(T))
        return false;
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (!(values[i] == expected[i]) && (values[i] == values[i] || expected[i] == expected[i]))
            return false;
    return true;
}

/// All planes of the next level at once.
void coarsen(ValueType type, const Grid& grid, std::span<const std::byte> stored,
             std::span<std::byte> out) {
    Coarsener coarsener(type, grid);
    coarsener.make(stored, 0, 0, coarsener.made_of(grid.vertices[2]), out);
}

TEST(DetailLevels, GoDownUntilOneChunkHoldsAllWithTheBorderAtItsPlace) {
    for (const std::array<std::uint32_t, 3> n : {std::array<std::uint32_t, 3>{2, 2, 2},
                                                 {16, 16, 16},
                                                 {17, 2, 3},
                                                 {97, 31, 18},
                                                 {256, 129, 65},
                                                 {1024, 1000, 2}}) {
        Grid grid;
        grid.vertices = n;
        const auto grids = detail_grids(grid);
        for (std::size_t level = 0; level < grids.size(); ++level)
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_EQ(grids[level].vertices[axis], positions(n[axis], level).size());
        EXPECT_TRUE(std::ranges::all_of(grids.back().vertices, [](auto v) { return v <= 16; }));
        if (grids.size() > 1) {
            EXPECT_TRUE(std::ranges::any_of(grids[grids.size() - 2].vertices,
                                            [](auto v) { return v > 16; }));
        }
    }
}

TEST(DetailLevels, AreWhatTheirDefinitionSaysForEveryTypeAndSize) {
    std::mt19937 random(test_seed());
    TestFolder folder;
    for (const ValueType type : kAllTypes)
        for (const std::array<std::uint32_t, 3> n :
             {std::array<std::uint32_t, 3>{17, 2, 3}, {37, 23, 5}, {2, 67, 19}, {33, 34, 31}})
            for (const bool bricks : {true, false}) {
                // The whole range of every type, and where there is one, holes of NaN.
                TestField field(n, 2, type, scaled(white_noise(random), 2e9, -3e8), {0.5, -7});
                visit_value_type(type, [&]<class T>(std::type_identity<T>) {
                    if constexpr (std::is_floating_point_v<T>)
                        for (std::size_t v = 0; v < field.view().grid.vertex_count(); ++v)
                            if (random() % 4 == 0 || v % n[0] < 6)
                                field.at<T>(1, v) = std::numeric_limits<T>::quiet_NaN();
                });
                BuildOptions options;
                if (!bricks)
                    options.tiers = TierSet();
                MemorySeries series(field.view());
                build_index(series, folder.path() / "a", options);
                const auto file = IndexFile::open(folder.path() / "a");
                EXPECT_NO_THROW(file->verify());
                ASSERT_EQ(file->detail_levels(), detail_grids(field.view().grid).size());
                for (std::uint32_t step = 0; step < 2; ++step)
                    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
                        const auto expected =
                            levels_slowly<T>(field.view(), step, file->detail_levels());
                        for (std::size_t level = 0; level < expected.size(); ++level) {
                            const LoadedStep got = file->chunks(level).whole(step);
                            ASSERT_TRUE(same_bits(got.values.step_bytes(step), expected[level]))
                                << name_of(type) << " level " << level;
                            // And so the cells are those of a scan of these values.
                            const BruteForce cells(got.values, step);
                            for (const double isovalue : {-1e8, 3e8, 5e8, 60.0, -100.0}) {
                                EXPECT_EQ(search_level(file, level, {Instant(step), isovalue}).ids,
                                          cells.active(isovalue));
                            }
                        }
                    });
            }
}

TEST(DetailLevels, OfAConstantFieldAreConstantAndOfAllNaNNaN) {
    for (const double value : {255.0, 0.0}) {
        std::vector<std::uint8_t> in(35 * 20 * 18, static_cast<std::uint8_t>(value)),
            out(18 * 11 * 10);
        Grid grid;
        grid.vertices = {35, 20, 18};
        coarsen(ValueType::u8, grid, std::as_bytes(std::span(in)),
                std::as_writable_bytes(std::span(out)));
        EXPECT_EQ(out, std::vector<std::uint8_t>(out.size(), static_cast<std::uint8_t>(value)));
    }
    Grid grid;
    grid.vertices = {3, 3, 3};
    std::vector<float> in(27, std::nanf("")), out(8);
    coarsen(ValueType::f32, grid, std::as_bytes(std::span(in)),
            std::as_writable_bytes(std::span(out)));
    EXPECT_TRUE(std::ranges::all_of(out, [](float v) { return std::isnan(v); }));
}

TEST(DetailLevels, ThatAreNotThereAreRefused) {
    TestFolder folder;
    const TestField field({20, 20, 20}, 2, ValueType::u8, moving_sphere);
    MemorySeries series(field.view());
    build_index(series, folder.path() / "a", {});
    const auto file = IndexFile::open(folder.path() / "a");
    for (const auto& [level, step, what] :
         {std::tuple{2u, 0u, "level 2: expected 0 to 1"}, {1u, 2u, "step 2: expected 0 to 1"}})
        try {
            search_level(file, level, {Instant(step), 1.0});
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(what));
        }
}

} // namespace
} // namespace isochron::index
