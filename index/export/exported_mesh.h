// The mesh of an exported surface, in pieces: a large one lies on disk, so that memory is bounded.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/system/scratch_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace isochron::index {

/// The pieces follow each other as from SurfaceMeshes::make_pieces. Beyond some megabytes they lie
/// in a file without a name. Not thread-safe. Functions throw Error as ScratchFile does.
class ExportedMesh {
  public:
    /// @param beside a path in the folder on whose disk large meshes lie
    explicit ExportedMesh(std::filesystem::path beside) : beside_(std::move(beside)) {}

    void add(CellMesh piece);

    std::uint64_t vertices() const { return vertices_; }
    std::uint64_t triangles() const { return triangles_; }
    std::uint64_t cells() const { return cells_; }
    /// [byte] in memory
    std::uint64_t held() const { return held_; }

    /// Calls `use(vertex, value)` for each vertex; the value is 0 if the mesh has none.
    template <class Use>
    void each_vertex(Use&& use) const {
        CellMesh read;
        for (const Piece& piece : pieces_) {
            const CellMesh& mesh = with_vertices(piece, read);
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
                use(mesh.vertices[i], mesh.values.empty() ? 0.0f : mesh.values[i]);
        }
    }
    /// Calls `use(corners)` for each triangle, with the numbers of its three vertices.
    template <class Use>
    void each_triangle(Use&& use) const {
        CellMesh read;
        for (const Piece& piece : pieces_)
            use_triangles(with_triangles(piece, read), use);
    }
    /// Calls `use(vertices)` for each triangle, with its three vertices.
    template <class Use>
    void each_placed_triangle(Use&& use) const {
        CellMesh read;
        KeptVector<MeshVertex> before, own; // triangles reach back by a piece at most
        std::uint64_t end = 0;
        for (const Piece& piece : pieces_) {
            before = std::exchange(own, with_vertices(piece, read).vertices);
            const std::uint64_t first = std::exchange(end, end + own.size());
            use_triangles(with_triangles(piece, read), [&](const auto& corners) {
                std::array<MeshVertex, 3> at;
                for (std::size_t i = 0; i < 3; ++i)
                    at[i] = corners[i] >= first ? own[corners[i] - first]
                                                : before[before.size() - (first - corners[i])];
                use(at);
            });
        }
    }

  private:
    struct Piece {
        CellMesh mesh; ///< empty: on disk
        std::uint64_t at = 0;
        std::size_t vertices = 0, values = 0, corners = 0;
    };

    template <class Use>
    static void use_triangles(const CellMesh& mesh, Use&& use) {
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
            use(std::array{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    }
    const CellMesh& with_vertices(const Piece& piece, CellMesh& read) const;
    const CellMesh& with_triangles(const Piece& piece, CellMesh& read) const;
    void put_on_disk(Piece& piece);

    std::filesystem::path beside_;
    std::vector<Piece> pieces_;
    std::unique_ptr<ScratchFile> file_; ///< null: all is in memory
    std::uint64_t vertices_ = 0, triangles_ = 0, cells_ = 0, held_ = 0;
    std::uint64_t on_disk_ = 0; ///< [byte]
};

} // namespace isochron::index
