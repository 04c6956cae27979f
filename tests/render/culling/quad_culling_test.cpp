// Occlusion culling of quads: hidden cells are left out, and pictures do not change.
#include "render/culling/seen_slots.h"

#include "render/cells/point_sprites.h"
#include "tests/render/culling/hidden_cells.h"
#include "tests/support/simd_targets.h"

namespace isochron::render {
namespace {

constexpr float kRadius = 0.5f * FootprintShapes{}.quad_diameter;
constexpr std::array kShapes{SplatShape{CellShape::plane, FootprintShapes{}.half_cell, true},
                             SplatShape{CellShape::voxel, kRadius}};

class SeenCellsPictures : public HiddenCellsTest {
  protected:
    Image draw(CellPass& pass, const Volume& volume, const CellBuffers& cells,
               const CellAppearance& look) {
        return HiddenCellsTest::draw(pass, volume, cells, look, Footprint::quad);
    }
    bool are_squares(const Volume& volume) {
        return points_serve(volume.view, volume.placement, kRadius, kReachOfRectangle, 255.0f) &&
               footprints_are_squares(volume.view, volume.placement, kRadius);
    }
};

TEST_P(SeenCellsPictures, AreThoseOfAllCells) {
    with_both_shapes([&](CellShape, CellPass& seen, CellPass& all) {
        int squares = 0;
        for (int round = 0; round < 300; ++round) {
            const Volume volume = random_volume(random_);
            if (volume.cells.empty())
                continue;
            squares += are_squares(volume);
            const CellBuffers cells = shown(volume);
            ASSERT_EQ(draw(seen, volume, cells, three_colors()).rgba,
                      draw(all, volume, cells, three_colors()).rgba)
                << "round " << round;
        }
        EXPECT_GT(squares, 80);
        EXPECT_LT(squares, 180);
    });
}

TEST_P(SeenCellsPictures, AreTheSameOnEveryKindOfProcessor) {
    with_both_shapes([&](CellShape, CellPass& seen, CellPass& all) {
        for (int round = 0; round < 30; ++round) {
            const Volume volume = random_volume(random_);
            const CellBuffers cells = shown(volume);
            const auto expected = draw(all, volume, cells, three_colors()).rgba;
            index::on_every_simd_target(
                [&] { ASSERT_EQ(draw(seen, volume, cells, three_colors()).rgba, expected); });
        }
    });
}

TEST_P(SeenCellsPictures, ShowWhatIsBehindQuadsThatAreLeftOut) {
    with_both_shapes([&](CellShape, CellPass& seen, CellPass& all) {
        for (int round = 0; round < 20; ++round) {
            const Volume volume = random_volume(random_);
            if (volume.cells.empty())
                continue;
            const CellBuffers cells = shown(volume);
            CellAppearance look = three_colors();
            if (round % 2)
                look.surfaces[round % 3].opacity = 0.5f;
            else
                look.near_fade = {.gone = 1.0f, .whole = 8.0f};
            ASSERT_EQ(draw(seen, volume, cells, look).rgba, draw(all, volume, cells, look).rgba)
                << "round " << round;
        }
    });
}

INSTANTIATE_TEST_SUITE_P(, SeenCellsPictures, both_contexts(), context_name);

TEST(SeenCells, OfAClosedShellAreItsNearHalf) {
    const Shell shell;
    for (const SplatShape& shape : kShapes) {
        SeenSlots seen;
        const auto found =
            seen.find(shell.volume.view, shell.volume.placement, shape, shell.slots, shell.order);
        const double share = double(found.size()) / double(shell.order.size());
        EXPECT_GT(share, 0.25);
        EXPECT_LT(share, shape.shape == CellShape::plane ? 0.65 : 0.5);
    }
}

TEST(SeenCells, AreNotBesideOrBehindTheView) {
    Shell shell;
    // From the middle of the shell, all around, a view of a tenth of it.
    shell.volume.placement.room_from_index = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 3)) *
                                             shell.volume.placement.room_from_index;
    for (const SplatShape& shape : kShapes) {
        SeenSlots seen;
        const auto found =
            seen.find(shell.volume.view, shell.volume.placement, shape, shell.slots, shell.order);
        EXPECT_GT(found.size(), shell.order.size() / 100);
        EXPECT_LT(found.size(), shell.order.size() / 8);
    }
}

TEST(SeenCells, ComeNearestFirst) {
    const Shell shell;
    for (const SplatShape& shape : kShapes) {
        SeenSlots seen;
        const auto found =
            seen.find(shell.volume.view, shell.volume.placement, shape, shell.slots, shell.order);
        std::vector<std::uint32_t> rest(shell.order.rbegin(), shell.order.rend());
        std::erase_if(rest, [&](std::uint32_t slot) {
            return std::find(found.begin(), found.end(), slot) == found.end();
        });
        EXPECT_TRUE(std::ranges::equal(found, rest));
    }
}

/// Rounding may differ, which the pictures do not show.
TEST(SeenCells, AreAsManyOnEveryKindOfProcessor) {
    const Shell shell;
    for (const SplatShape& shape : kShapes) {
        SeenSlots seen;
        const auto find = [&] {
            return seen.find(shell.volume.view, shell.volume.placement, shape, shell.slots,
                             shell.order);
        };
        const auto count = double(find().size());
        index::on_every_simd_target(
            [&] { EXPECT_NEAR(double(find().size()), count, 0.01 * count); });
    }
}

TEST(SeenCells, OfNoneAreNone) {
    const Shell shell;
    SeenSlots seen;
    for (const SplatShape& shape : kShapes)
        EXPECT_TRUE(seen.find(shell.volume.view, shell.volume.placement, shape, {}, {}).empty());
}

TEST(SeenCells, InPiecesAreThoseOfTheWhole) {
    const Shell shell;
    std::mt19937 random(test_seed());
    for (const SplatShape& splat : kShapes) {
        SeenSlots seen;
        const auto found =
            seen.find(shell.volume.view, shell.volume.placement, splat, shell.slots, shell.order);
        const std::vector<std::uint32_t> whole(found.begin(), found.end());
        seen.begin(shell.volume.view, shell.volume.placement, splat, shell.slots);
        for (std::size_t to = 0; to < seen.work();) {
            to += 1 + random() % 2000;
            const auto cells = seen.advance(to, shell.slots, shell.order);
            if (to >= seen.work()) {
                EXPECT_TRUE(std::ranges::equal(cells, whole));
            }
        }
    }
}

} // namespace
} // namespace isochron::render
