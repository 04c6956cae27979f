// Joins parts at the vertices that they share, and divides a mesh into parts.
#include "index/surface/mesh_parts.h"

#include "index/system/parallel.h"

#include <algorithm>

namespace isochron::index {
namespace {

/// Makes room for all parts, since a mesh that grows is copied.
void reserve(const std::vector<MeshPart>& parts, CellMesh& mesh) {
    std::size_t vertices = 0, triangles = 0, cells = 0, values = 0, colors = 0;
    for (const MeshPart& part : parts) {
        vertices += part.vertices.size();
        triangles += part.triangles.size();
        cells += part.cases.size();
        values += part.values.size();
        colors += part.colors.size();
    }
    mesh.vertices.reserve(vertices);
    mesh.triangles.reserve(triangles);
    mesh.cases.reserve(cells);
    mesh.values.reserve(values);
    mesh.colors.reserve(colors);
}

/// The index in `ids` of the first cell of a plane at about `i` of `n` equal parts.
std::size_t cut_at(const Grid& grid, std::span<const CellId> ids, std::size_t i, std::size_t n) {
    if (i == n)
        return ids.size();
    const auto [width, height, depth] = grid.cells();
    const CellId plane = width * height;
    const CellId first = ids[ids.size() * i / n] / plane * plane;
    return static_cast<std::size_t>(std::ranges::lower_bound(ids, first) - ids.begin());
}

} // namespace

void PartsJoiner::add(const MeshPart& part, CellMesh& to) {
    if (part.vertices.empty())
        return;
    find_known(part, to);
    const auto first = static_cast<std::uint32_t>(numbers_.size());
    const std::uint32_t offset = vertices_ - first;
    to.vertices.insert(to.vertices.end(), part.vertices.begin() + first, part.vertices.end());
    vertices_ += static_cast<std::uint32_t>(part.vertices.size()) - first;
    if (!part.values.empty())
        to.values.insert(to.values.end(), part.values.begin() + first, part.values.end());
    if (!part.colors.empty())
        to.colors.insert(to.colors.end(), part.colors.begin() + first, part.colors.end());
    const auto number = [&](std::uint32_t of_part) {
        return of_part < first ? numbers_[of_part] : of_part + offset;
    };
    const std::size_t before = to.triangles.size();
    to.triangles.resize(before + part.triangles.size());
    std::ranges::transform(part.triangles,
                           to.triangles.begin() + static_cast<std::ptrdiff_t>(before), number);
    to.cases.insert(to.cases.end(), part.cases.begin(), part.cases.end());
    const std::uint32_t top = std::ranges::max_element(part.vertices, {}, &MeshVertex::z)->z;
    shared_.clear();
    for (std::uint32_t i = 0; i < part.vertices.size(); ++i)
        if (part.vertices[i].z == top)
            shared_.push_back({key_of(part.vertices[i]), number(i)});
    std::ranges::sort(shared_, {}, &SharedVertex::key);
}

/// Finds the vertices that the part before also has: only vertices of the part's first plane of
/// cells can be shared, and these come first.
void PartsJoiner::find_known(const MeshPart& part, CellMesh& to) {
    const std::uint32_t end = part.vertices.front().z + 1u;
    numbers_.clear();
    for (const MeshVertex& vertex : part.vertices) {
        if (vertex.z > end)
            return;
        const EdgeKey key = key_of(vertex);
        const auto found = std::ranges::lower_bound(shared_, key, {}, &SharedVertex::key);
        if (found != shared_.end() && found->key == key) {
            numbers_.push_back(found->number);
        } else {
            numbers_.push_back(vertices_++);
            to.vertices.push_back(vertex);
            if (!part.values.empty())
                to.values.push_back(part.values[numbers_.size() - 1]);
            if (!part.colors.empty())
                to.colors.push_back(part.colors[numbers_.size() - 1]);
        }
    }
}

CellMesh join_parts(std::vector<MeshPart> parts) {
    if (parts.size() == 1)
        return std::move(parts.front());
    CellMesh mesh;
    reserve(parts, mesh);
    PartsJoiner joiner;
    for (const MeshPart& part : parts)
        joiner.add(part, mesh);
    return mesh;
}

std::vector<std::span<const CellId>> cut_at_planes(const Grid& grid, std::span<const CellId> ids,
                                                   std::size_t parts) {
    std::vector<std::span<const CellId>> cut(ids.empty() ? 1 : parts, ids);
    for (std::size_t i = 0, first = 0; i < cut.size() && !ids.empty(); ++i) {
        const std::size_t end = cut_at(grid, ids, i + 1, cut.size());
        cut[i] = ids.subspan(first, end - first);
        first = end;
    }
    return cut;
}

bool make_mesh(std::span<MeshMaker> makers, const StepValues& values, const Query& query,
               std::span<const CellId> ids, CellMesh& mesh, const std::stop_token& stop) {
    constexpr std::size_t kCellsPerPart = 1 << 13; ///< fewer cells are one part
    const std::size_t count = std::clamp<std::size_t>(ids.size() / kCellsPerPart, 1, makers.size());
    const auto cut = cut_at_planes(values.grid, ids, count);
    std::vector<MeshPart> parts(cut.size());
    parallel_for(cut.size(), static_cast<unsigned>(cut.size()),
                 [&](std::size_t i, unsigned worker) {
                     makers[worker].make(values, query, cut[i], parts[i], 0, stop);
                 },
                 {});
    if (stop.stop_requested())
        return false;
    mesh = join_parts(std::move(parts));
    return true;
}

} // namespace isochron::index
