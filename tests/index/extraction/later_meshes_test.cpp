// Meshes of an extraction that come later: simplified, within their room, and behind what is needed first.
#include "index/extraction/extractor.h"
#include "index/surface/mesh_clusters.h"
#include "tests/support/eventually.h"
#include "tests/support/indexed.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <semaphore>

namespace isochron::index {
namespace {

using test_support::TestFolder;

TEST(Extraction, MeshesAreSimplifiedOnceTheQueryIsAnsweredWhereAskedFor) {
    const TestFolder folder;
    const TestField field({40, 40, 40}, 3, ValueType::f32, moving_sphere);
    const auto file = indexed(folder, field.view());
    Extractor extractor(extract_from(file, std::nullopt, Shading::cells), 1 << 30);
    const SurfacesQuery query{
        .instant = Instant(0), .isovalues = {30.0, 1e9}, .mesh_room = 1 << 30};
    extractor.request({.query = query, .ahead = {}});
    extractor.wait();
    const ExtractionPtr set = extractor.newest();
    ASSERT_TRUE(set->meshed());
    EXPECT_FALSE(set->later->get()) << "nobody has asked";
    EXPECT_EQ(set->triangles(1), 0u);
    constexpr std::uint64_t kRoom = 1 << 30;
    extractor.request({.query = query, .ahead = {}, .meshes_of = set, .later_room = kRoom});
    extractor.wait();
    EXPECT_EQ(extractor.newest(), set) << "it stays";
    for (std::size_t level = 1; level < kMeshLevels; ++level) {
        EXPECT_LT(0u, set->triangles(level));
        EXPECT_LT(set->triangles(level), set->triangles(level - 1));
        ASSERT_EQ(set->meshes(level).size(), 2u);
        EXPECT_EQ(*set->meshes(level)[0],
                  clustered(*set->surfaces[0].mesh, kClusterEdges[level - 1]));
        EXPECT_FALSE(set->meshes(level)[1]) << "without cells";
    }
}

TEST(Extraction, ThatCameWithoutMeshesGetsThoseOfAllLevelsThatFit) {
    const TestFolder folder;
    const TestField field({40, 40, 40}, 1, ValueType::f32, moving_sphere);
    const auto file = indexed(folder, field.view());
    const SurfacesQuery query{.instant = Instant(0), .isovalues = {30.0, 1e9}, .mesh_room = 0};
    SurfacesQuery with_mesh = query;
    with_mesh.mesh_room = 1 << 30;
    const ExtractionPtr meshed =
        extract_from(file, std::nullopt, Shading::cells)(with_mesh, std::stop_token());
    const auto made = [&](std::uint64_t room) {
        Extractor extractor(extract_from(file, std::nullopt, Shading::cells), 1 << 30);
        extractor.request({.query = query, .ahead = {}});
        extractor.wait();
        ExtractionPtr set = extractor.newest();
        extractor.request({.query = query, .ahead = {}, .meshes_of = set, .later_room = room});
        extractor.wait();
        EXPECT_EQ(extractor.newest(), set) << "it stays";
        return set;
    };
    const ExtractionPtr all = made(1 << 30);
    EXPECT_FALSE(all->meshed()) << "it came without one";
    ASSERT_EQ(all->meshes(0).size(), 2u);
    EXPECT_EQ(*all->meshes(0)[0], *meshed->surfaces[0].mesh);
    EXPECT_EQ(*all->meshes(1)[0], clustered(*meshed->surfaces[0].mesh, kClusterEdges[0]));
    // Where there is less room, the finest are left out.
    const ExtractionPtr some = made(all->later->get()->bytes() - 1);
    EXPECT_TRUE(some->meshes(0).empty());
    EXPECT_EQ(*some->meshes(1)[0], *all->meshes(1)[0]);
    const ExtractionPtr none = made(1);
    EXPECT_TRUE(none->meshes(kMeshLevels - 1).empty());
}

TEST(Extraction, MeshesGiveWayToOtherPartsOfTheCellsThatAreNeededFirst) {
    const TestFolder folder;
    const TestField field({40, 40, 40}, 1, ValueType::f32, moving_sphere);
    const Extract extract =
        extract_from(indexed(folder, field.view()), std::nullopt, Shading::cells);
    std::binary_semaphore begun{0};
    std::atomic<bool> gave_way = false;
    Extractor extractor([&](const SurfacesQuery& query, std::stop_token stop) {
        if (query.mesh_room > 0) {
            begun.release();
            gave_way = test_support::eventually([&] { return stop.stop_requested(); });
            return ExtractionPtr();
        }
        return extract(query, std::move(stop));
    });
    const SurfacesQuery query{.instant = Instant(0), .isovalues = {30.0}};
    extractor.request({.query = query});
    extractor.wait();
    constexpr std::uint64_t kRoom = 1 << 30;
    extractor.request({.query = query, .meshes_of = extractor.newest(), .later_room = kRoom});
    begun.acquire();
    SurfacesQuery parts = query;
    parts.detail.most_cells = 100;
    extractor.request({.query = parts, .before_meshes = true});
    extractor.wait();
    EXPECT_TRUE(gave_way);
    EXPECT_EQ(extractor.newest()->query, parts);
}

} // namespace
} // namespace isochron::index
