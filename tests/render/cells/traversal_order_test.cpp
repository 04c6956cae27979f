// The back-to-front order, compared with an exact test of which box can hide which.
#include "render/cells/traversal_order.h"

#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

namespace isochron::render {
namespace {

/// True when from the eye some point of unit box `front` lies before some point of unit box
/// `back`: there is t in (0, 1) with eye + t (back - eye) meeting front. Boxes are products of
/// intervals, so every axis bounds t on its own. For a direction the boxes are compared along it.
bool can_hide(const glm::ivec3& front, const glm::ivec3& back, const glm::dvec4& eye) {
    double low = 0.0, high = eye.w == 0.0 ? 1e9 : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        // Position along the axis of back's ends on their way to the eye, as c + t * k.
        const double ends[2] = {double(back[axis]), back[axis] + 1.0};
        for (int end = 0; end < 2; ++end) {
            const double c = eye.w == 0.0 ? ends[end] : eye[axis];
            const double k = eye.w == 0.0 ? eye[axis] : ends[end] - eye[axis];
            // The low end must stay under front's high end, the high end above front's low end.
            const double bound = end == 0 ? front[axis] + 1.0 : front[axis];
            const double sign = end == 0 ? 1.0 : -1.0;
            const double slope = sign * k, room = sign * (bound - c); // slope * t < room
            if (slope > 0.0)
                high = std::min(high, room / slope);
            else if (slope < 0.0)
                low = std::max(low, room / slope);
            else if (room <= 0.0)
                return false;
        }
    }
    return high - low > 1e-9;
}

/// Slots in the order of their cells' ids.
std::vector<std::uint32_t> by_rank(const std::vector<CellPlace>& places) {
    std::vector<std::uint32_t> slots(places.size());
    std::iota(slots.begin(), slots.end(), 0u);
    std::ranges::sort(slots, {}, [&](std::uint32_t slot) {
        const CellPlace& at = places[slot];
        return std::tuple(at.z, at.y, at.x);
    });
    return slots;
}

Slots random_cells(std::mt19937& random, const glm::ivec3& size, int count) {
    std::set<std::array<int, 3>> cells;
    for (int i = 0; i < count; ++i)
        cells.insert({int(random() % size.z), int(random() % size.y), int(random() % size.x)});
    Slots points;
    for (const auto& [z, y, x] : cells)
        points.places.push_back({std::uint16_t(x), std::uint16_t(y), std::uint16_t(z), 0});
    std::shuffle(points.places.begin(), points.places.end(), random);
    points.slot_of_rank = by_rank(points.places);
    return points;
}

void expect_back_to_front(const Slots& points, const glm::vec4& eye, const glm::ivec3& size,
                          const glm::vec3& spacing) {
    std::vector<std::uint32_t> order;
    order_back_to_front(points, traversal_key(eye, size, spacing), order);
    std::vector<bool> seen(points.places.size(), false);
    for (const std::uint32_t cell : order) {
        ASSERT_LT(cell, points.places.size());
        ASSERT_FALSE(seen[cell]) << "cell " << cell << " twice";
        seen[cell] = true;
    }
    ASSERT_EQ(order.size(), points.places.size());
    auto box = [&](std::uint32_t cell) {
        return glm::ivec3(points.places[cell].x, points.places[cell].y, points.places[cell].z);
    };
    for (std::size_t early = 0; early < order.size(); ++early)
        for (std::size_t late = early + 1; late < order.size(); ++late) {
            const glm::ivec3 a = box(order[early]), b = box(order[late]);
            ASSERT_FALSE(can_hide(a, b, eye))
                << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z << ' ' << eye.w << ": cell "
                << a.x << ' ' << a.y << ' ' << a.z << " is drawn before " << b.x << ' ' << b.y
                << ' ' << b.z << " and is in front of it";
        }
}

class TraversalOrder : public testing::Test {
  protected:
    const unsigned seed_ = test_seed();
    testing::ScopedTrace trace_{__FILE__, __LINE__, seed_};
    std::mt19937 random_{seed_};
    glm::vec3 random_spacing() {
        glm::vec3 spacing(1.0f);
        spacing[static_cast<int>(random_() % 3)] = float(std::exp(uniform(-3, 3)));
        return spacing;
    }
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
};

TEST_F(TraversalOrder, NoCellIsInFrontOfALaterOneForEyesInsideAndOutside) {
    for (int round = 0; round < 300; ++round) {
        const glm::ivec3 size(1 + random_() % 12, 1 + random_() % 12, 1 + random_() % 12);
        const auto points = random_cells(random_, size, 120);
        const double reach = round % 3 == 0 ? 0.0 : round % 3 == 1 ? 3.0 : std::exp(uniform(3, 20));
        const glm::vec4 eye(uniform(-reach, size.x + reach), uniform(-reach, size.y + reach),
                            uniform(-reach, size.z + reach), 1.0);
        expect_back_to_front(points, eye, size, random_spacing());
    }
}

TEST_F(TraversalOrder, NoCellIsInFrontOfALaterOneForEyesOnVoxelPlanesEdgesAndCorners) {
    for (int round = 0; round < 300; ++round) {
        const glm::ivec3 size(1 + random_() % 8, 1 + random_() % 8, 1 + random_() % 8);
        const auto points = random_cells(random_, size, 100);
        glm::vec4 eye(uniform(-2, size.x + 2), uniform(-2, size.y + 2), uniform(-2, size.z + 2), 1);
        for (int axis = 0; axis < 3; ++axis)
            if (axis == round % 3 || random_() % 2)
                eye[axis] = std::round(eye[axis]);
        expect_back_to_front(points, eye, size, random_spacing());
    }
}

TEST_F(TraversalOrder, NoCellIsInFrontOfALaterOneForParallelViews) {
    for (int round = 0; round < 200; ++round) {
        const glm::ivec3 size(1 + random_() % 8, 1 + random_() % 8, 1 + random_() % 8);
        const auto points = random_cells(random_, size, 100);
        glm::vec4 towards(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), 0);
        if (round % 2)
            towards[round % 3] = 0.0f;
        expect_back_to_front(points, towards, size, random_spacing());
    }
}

TEST_F(TraversalOrder, EyesInTheSameQuarterOfACellShareOneKey) {
    const glm::ivec3 size(60, 50, 40);
    const auto a = traversal_key({10.01, 20.26, 30.3, 1}, size, glm::vec3(1));
    EXPECT_EQ(a, traversal_key({10.24, 20.49, 30.4, 1}, size, glm::vec3(1)));
    EXPECT_FALSE(a == traversal_key({10.26, 20.49, 30.4, 1}, size, glm::vec3(1)));
}

TEST_F(TraversalOrder, TheFartherTheEyeTheMoreItMovesBeforeItSortsAgain) {
    const glm::ivec3 size(60, 50, 40);
    const auto key = [&](float z) { return traversal_key({10, 20, z, 1}, size, glm::vec3(1)); };
    EXPECT_EQ(key(50.26f), key(50.49f));
    EXPECT_FALSE(key(50.26f) == key(50.51f));
    EXPECT_EQ(key(40 + 1024), key(40 + 1025.9f));
    EXPECT_FALSE(key(40 + 1024) == key(40 + 1026.1f));
}

TEST_F(TraversalOrder, ThePhysicallyFartherCellComesFirst) {
    // Along the first axis cells are three times as long: two of them are farther than five.
    const Slots points{
        .slot_of_rank = {0, 1}, .places = {{0, 5, 0, 0}, {2, 0, 0, 0}}, .planes = {}};
    std::vector<std::uint32_t> order;
    order_back_to_front(points, traversal_key({0.5, 0.5, 0.5, 1}, {9, 9, 9}, {1, 1, 1}), order);
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1}));
    order_back_to_front(points, traversal_key({0.5, 0.5, 0.5, 1}, {9, 9, 9}, {3, 1, 1}), order);
    EXPECT_EQ(order, (std::vector<std::uint32_t>{1, 0}));
}

TEST_F(TraversalOrder, IsTheSameFarAwayAndForTheDirectionThere) {
    const glm::ivec3 size(30, 30, 30);
    const auto points = random_cells(random_, size, 500);
    const glm::vec3 towards(0.3f, -0.5f, 0.8f);
    std::vector<std::uint32_t> far, parallel;
    order_back_to_front(points, traversal_key(glm::vec4(1e5f * towards, 1), size, glm::vec3(1)),
                        far);
    order_back_to_front(points, traversal_key(glm::vec4(towards, 0), size, glm::vec3(1)), parallel);
    // Both rank cells by depth, up to their rounding of it: half a cell, at most, of either.
    const auto depth = [&](std::uint32_t cell) {
        return glm::dot(towards, glm::vec3(points.places[cell].x, points.places[cell].y,
                                           points.places[cell].z));
    };
    for (const auto& order : {far, parallel})
        for (std::size_t i = 1; i < order.size(); ++i)
            EXPECT_LT(depth(order[i - 1]) - depth(order[i]), 1.0f);
}

TEST_F(TraversalOrder, AnEmptySetHasAnEmptyOrder) {
    std::vector<std::uint32_t> order{1, 2, 3};
    order_back_to_front({}, traversal_key({0, 0, 0, 1}, {4, 4, 4}, glm::vec3(1)), order);
    EXPECT_TRUE(order.empty());
}

TEST_F(TraversalOrder, DoesNotDependOnWhoHasWhichSlot) {
    const glm::ivec3 size(9, 9, 9);
    const Slots some = random_cells(random_, size, 300);
    Slots others = some; // equal cells in other slots
    std::shuffle(others.places.begin(), others.places.end(), random_);
    others.slot_of_rank = by_rank(others.places);
    const TraversalKey key = traversal_key({4.5f, 4.5f, 30.0f, 1.0f}, size, glm::vec3(1));
    std::vector<std::uint32_t> a, b;
    order_back_to_front(some, key, a);
    order_back_to_front(others, key, b);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_EQ(some.places[a[i]], others.places[b[i]]);
}

TEST_F(TraversalOrder, InPiecesIsThatOfTheWhole) {
    const glm::ivec3 size(60, 50, 40);
    for (const int cells : {1, 700, 3000}) {
        const Slots slots = random_cells(random_, size, cells);
        for (const glm::vec4 eye : {glm::vec4(20.5f, 30.5f, 90.0f, 1), glm::vec4(0, 1, 2, 0)}) {
            const TraversalKey key = traversal_key(eye, size, glm::vec3(1, 70, 1));
            std::vector<std::uint32_t> whole;
            order_back_to_front(slots, key, whole);
            BackToFrontSort sort(slots, key);
            for (std::size_t to = 0; to < sort.work(); sort.advance(slots, to))
                to += 1 + random_() % 900;
            EXPECT_EQ(sort.take(), whole);
        }
    }
}

} // namespace
} // namespace isochron::render
