// A mesh that lies on disk in part is the same as in memory.
#include "index/export/exported_mesh.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace isochron::index {
namespace {

/// A piece whose triangles reach into the one before it.
CellMesh piece_from(std::uint32_t first, std::uint32_t count) {
    CellMesh piece;
    for (std::uint32_t i = first; i < first + count; ++i) {
        piece.vertices.push_back(MeshVertex{.share = i});
        piece.values.push_back(static_cast<float>(i) / 2);
        const std::uint32_t before = i == 0 ? 0 : i - 1;
        piece.triangles.insert(piece.triangles.end(), {before, i, first + count - 1});
        piece.cases.push_back(1);
    }
    return piece;
}

TEST(ExportedMesh, IsTheSameOnDiskAsItWasAdded) {
    const test_support::TestFolder folder;
    ExportedMesh mesh(folder.path() / "out.ply");
    constexpr std::uint32_t kPieces = 12, kCount = 100'000;
    for (std::uint32_t i = 0; i < kPieces; ++i)
        mesh.add(piece_from(i * kCount, kCount));
    EXPECT_EQ(mesh.vertices(), kPieces * kCount);
    EXPECT_EQ(mesh.triangles(), kPieces * kCount);
    EXPECT_EQ(mesh.cells(), kPieces * kCount);
    EXPECT_LE(mesh.held(), 16u << 20) << "most of 38 MB lies on disk";
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "under no name";

    for (int again = 0; again < 2; ++again) {
        std::uint32_t i = 0;
        mesh.each_vertex([&](const MeshVertex& vertex, float value) {
            ASSERT_EQ(vertex.share, i);
            ASSERT_EQ(value, static_cast<float>(i) / 2);
            ++i;
        });
        EXPECT_EQ(i, kPieces * kCount);
    }
    std::uint32_t i = 0;
    const auto expected = [&] {
        return std::array{i == 0 ? 0 : i - 1, i, i / kCount * kCount + kCount - 1};
    };
    mesh.each_triangle([&](const auto& corners) {
        ASSERT_EQ(corners, expected());
        ++i;
    });
    EXPECT_EQ(i, kPieces * kCount);
    i = 0;
    mesh.each_placed_triangle([&](const std::array<MeshVertex, 3>& at) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            ASSERT_EQ(at[corner].share, expected()[corner]);
        ++i;
    });
    EXPECT_EQ(i, kPieces * kCount);
}

} // namespace
} // namespace isochron::index
