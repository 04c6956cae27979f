// Occlusion culling of splats: those behind opaque ones are left out, and pictures do not change.
#include "render/culling/seen_slots.h"

#include "tests/render/culling/hidden_cells.h"
#include "tests/support/simd_targets.h"

namespace isochron::render {
namespace {

constexpr SplatShape kShape{CellShape::voxel, 0.5f * FootprintShapes{}.gaussian_diameter};
constexpr float kFalloff = -5.9f; ///< about that of the standard splats

class SeenSplatsPictures : public HiddenCellsTest {
  protected:
    /// In display values, where splats are left out.
    CellAppearance look() {
        CellAppearance look = three_colors();
        look.linear_light = false;
        return look;
    }
    Image draw(CellPass& pass, const Volume& volume, const CellBuffers& cells,
               const CellAppearance& look, int samples = 1) {
        return HiddenCellsTest::draw(pass, volume, cells, look, Footprint::gaussian, samples);
    }
};

int largest_difference(const Image& a, const Image& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        most = std::max(most, std::abs(int(a.rgba[i]) - int(b.rgba[i])));
    return most;
}

/// Less than half a step of eight bits lies behind: with rounding, one.
constexpr int kUnseen = 1;
/// Each sample is rounded, and their mean once more.
constexpr int kUnseenResolved = 2;

TEST_P(SeenSplatsPictures, AreThoseOfAllSplatsToWithinRounding) {
    with_both_shapes([&](CellShape, CellPass& seen, CellPass& all) {
        for (int round = 0; round < 200; ++round) {
            const Volume volume = random_volume(random_);
            const CellBuffers cells = shown(volume);
            const int samples = round % 4 == 0 ? 4 : 1;
            ASSERT_LE(largest_difference(draw(seen, volume, cells, look(), samples),
                                         draw(all, volume, cells, look(), samples)),
                      samples == 1 ? kUnseen : kUnseenResolved)
                << "round " << round;
        }
    });
}

TEST_P(SeenSplatsPictures, AreTheSameOnEveryKindOfProcessor) {
    with_both_shapes([&](CellShape, CellPass& seen, CellPass& all) {
        for (int round = 0; round < 20; ++round) {
            const Volume volume = random_volume(random_);
            const CellBuffers cells = shown(volume);
            const Image expected = draw(all, volume, cells, look());
            index::on_every_simd_target([&] {
                ASSERT_LE(largest_difference(draw(seen, volume, cells, look()), expected), kUnseen);
            });
        }
    });
}

TEST_P(SeenSplatsPictures, ShowAllWhereLightComesThrough) {
    with_both_shapes([&](CellShape, CellPass& seen, CellPass& all) {
        for (int round = 0; round < 20; ++round) {
            const Volume volume = random_volume(random_);
            const CellBuffers cells = shown(volume);
            CellAppearance through = look();
            if (round % 3 == 0)
                through.surfaces[round % 2].opacity = 0.5f;
            else if (round % 3 == 1)
                through.near_fade = {.gone = 1.0f, .whole = 8.0f};
            else
                through.linear_light = true;
            ASSERT_EQ(draw(seen, volume, cells, through).rgba,
                      draw(all, volume, cells, through).rgba)
                << "round " << round;
        }
    });
}

TEST_P(SeenSplatsPictures, OfSplatsThatAreCutOffEarlyAreThoseOfAll) {
    const FootprintShapes shapes{.shape = CellShape::voxel,
                                 .gaussian_diameter = 1.8f}; // half opaque at the outline
    CellPass seen(gl_, shapes), all(gl_, shapes);
    all.draw_hidden_cells();
    for (int round = 0; round < 40; ++round) {
        const Volume volume = random_volume(random_);
        const CellBuffers cells = shown(volume);
        ASSERT_LE(
            largest_difference(draw(seen, volume, cells, look()), draw(all, volume, cells, look())),
            kUnseen)
            << "round " << round;
    }
}

/// Splats within two radii of the eye fade: what is behind them is seen.
TEST_P(SeenSplatsPictures, OfAWallBeforeTheEyeShowWhatIsBehind) {
    const FootprintShapes shapes{.shape = CellShape::voxel,
                                 .gaussian_sigma = 1.2f}; // which lets nothing through
    CellPass seen(gl_, shapes), all(gl_, shapes);
    all.draw_hidden_cells();
    constexpr int kAcross = 40;
    Volume volume;
    volume.view.size = {240, 200};
    volume.view.clip_from_eye = glm::perspective(0.9f, 1.2f, 0.01f, 100.0f);
    volume.placement.extent = glm::vec3(kAcross);
    volume.placement.room_from_index = glm::translate(
        glm::mat4(1.0f), glm::vec3(-0.5f * kAcross, -0.5f * kAcross, -kAcross - 2.1f));
    for (const int z : {kAcross - 10, kAcross - 1}) // the wall is 2.6 voxels off
        for (int y = 0; y < kAcross; ++y)
            for (int x = 0; x < kAcross; ++x)
                volume.cells.push_back({x, y, z});
    const CellBuffers cells = shown(volume);
    EXPECT_LE(
        largest_difference(draw(seen, volume, cells, look()), draw(all, volume, cells, look())),
        kUnseen);
    const Image both = draw(all, volume, cells, look());
    std::erase_if(volume.cells, [](const glm::ivec3& cell) { return cell.z < kAcross - 1; });
    EXPECT_GT(largest_difference(draw(all, volume, shown(volume), look()), both), 10);
}

INSTANTIATE_TEST_SUITE_P(, SeenSplatsPictures, both_contexts(), context_name);

TEST(SeenSplats, OfAClosedShellAreLittleMoreThanItsNearHalf) {
    const Shell shell;
    SeenSlots seen;
    index::on_every_simd_target([&] {
        const auto found = seen.find(shell.volume.view, shell.volume.placement, kShape, shell.slots,
                                     shell.order, kFalloff);
        const double share = double(found.size()) / double(shell.order.size());
        EXPECT_GT(share, 0.4);
        EXPECT_LT(share, 0.75);
    });
}

TEST(SeenSplats, AreNotBesideOrBehindTheView) {
    Shell shell;
    // From the middle of the shell, all around, a view of a tenth of it.
    shell.volume.placement.room_from_index = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 3)) *
                                             shell.volume.placement.room_from_index;
    SeenSlots seen;
    const auto found = seen.find(shell.volume.view, shell.volume.placement, kShape, shell.slots,
                                 shell.order, kFalloff);
    EXPECT_GT(found.size(), shell.order.size() / 100);
    EXPECT_LT(found.size(), shell.order.size() / 4);
}

TEST(SeenSplats, ComeInTheOrderOfAll) {
    const Shell shell;
    SeenSlots seen;
    const auto found = seen.find(shell.volume.view, shell.volume.placement, kShape, shell.slots,
                                 shell.order, kFalloff);
    std::vector<std::uint32_t> rest = shell.order;
    std::erase_if(rest, [&](std::uint32_t slot) {
        return std::find(found.begin(), found.end(), slot) == found.end();
    });
    EXPECT_TRUE(std::ranges::equal(found, rest));
}

TEST(SeenSplats, OfNoneAreNone) {
    const Shell shell;
    SeenSlots seen;
    EXPECT_TRUE(
        seen.find(shell.volume.view, shell.volume.placement, kShape, {}, {}, kFalloff).empty());
}

} // namespace
} // namespace isochron::render
