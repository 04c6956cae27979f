// Keeps pieces of a mesh in memory or on disk.
#include "index/export/exported_mesh.h"

namespace isochron::index {
namespace {

constexpr std::uint64_t kMostHeld = std::uint64_t{16} << 20; ///< [byte]

/// @return where the next array begins
template <class T> // a vector
std::uint64_t read_array(const ScratchFile& file, std::uint64_t at, std::size_t count, T& out) {
    out.resize(count);
    const auto bytes = std::as_writable_bytes(std::span(out));
    file.read(at, bytes);
    return at + bytes.size();
}

} // namespace

void ExportedMesh::add(CellMesh mesh) {
    cells_ += mesh.cases.size();
    mesh.cases = {}; // counted
    Piece piece{.mesh = std::move(mesh)};
    piece.vertices = piece.mesh.vertices.size();
    piece.values = piece.mesh.values.size();
    piece.corners = piece.mesh.triangles.size();
    vertices_ += piece.vertices;
    triangles_ += piece.corners / 3;
    const std::uint64_t bytes = bytes_of(piece.mesh);
    if (held_ + bytes > kMostHeld && vertices_ > piece.vertices) // not of a mesh in one piece
        put_on_disk(piece);
    else
        held_ += bytes;
    pieces_.push_back(std::move(piece));
}

void ExportedMesh::put_on_disk(Piece& piece) {
    if (!file_)
        file_ = std::make_unique<ScratchFile>(beside_);
    piece.at = on_disk_;
    const auto put = [&](const auto& array) {
        const auto bytes = std::as_bytes(std::span(array));
        file_->write_at(on_disk_, bytes);
        on_disk_ += bytes.size();
    };
    put(piece.mesh.vertices);
    put(piece.mesh.values);
    put(piece.mesh.triangles);
    piece.mesh = {};
}

const CellMesh& ExportedMesh::with_vertices(const Piece& piece, CellMesh& read) const {
    if (piece.mesh.vertices.size() == piece.vertices)
        return piece.mesh;
    const std::uint64_t at = read_array(*file_, piece.at, piece.vertices, read.vertices);
    read_array(*file_, at, piece.values, read.values);
    return read;
}

const CellMesh& ExportedMesh::with_triangles(const Piece& piece, CellMesh& read) const {
    if (piece.mesh.triangles.size() == piece.corners)
        return piece.mesh;
    read_array(*file_,
               piece.at + piece.vertices * sizeof(MeshVertex) + piece.values * sizeof(float),
               piece.corners, read.triangles);
    return read;
}

} // namespace isochron::index
