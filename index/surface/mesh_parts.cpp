// Joins parts at the vertices that they share, and divides a mesh into parts.
#include "index/surface/mesh_parts.h"

#include "index/system/parallel.h"

#include <algorithm>

namespace isochron::index {
namespace {

/// Meshes of fewer vertices are joined by one thread.
constexpr std::size_t kVerticesOfThread = 1 << 16;

/// Where the next part goes in a mesh.
struct MeshEnds {
    std::size_t vertices = 0, triangles = 0, cases = 0, values = 0, colors = 0;

    static MeshEnds of(const CellMesh& mesh) {
        return {mesh.vertices.size(), mesh.triangles.size(), mesh.cases.size(), mesh.values.size(),
                mesh.colors.size()};
    }
    MeshEnds after(const MeshPart& part, std::uint32_t new_vertices) const {
        return {vertices + new_vertices, triangles + part.triangles.size(),
                cases + part.cases.size(), values + (part.values.empty() ? 0 : new_vertices),
                colors + (part.colors.empty() ? 0 : new_vertices)};
    }
    void fit(CellMesh& mesh) const {
        mesh.vertices.resize(vertices);
        mesh.triangles.resize(triangles);
        mesh.cases.resize(cases);
        mesh.values.resize(values);
        mesh.colors.resize(colors);
    }
};

/// Copies what belongs to the part's new vertices.
template <class From, class To>
void copy_new(const From& from, const PartsJoiner::Numbers& numbers, To& to, std::size_t at) {
    if (from.empty())
        return;
    auto out = to.begin() + static_cast<std::ptrdiff_t>(at);
    for (const std::uint32_t i : numbers.new_first)
        *out++ = from[i];
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(numbers.of_first.size()), from.end(), out);
}

void copy(const MeshPart& part, const PartsJoiner::Numbers& numbers, CellMesh& to,
          const MeshEnds& at) {
    copy_new(part.vertices, numbers, to.vertices, at.vertices);
    copy_new(part.values, numbers, to.values, at.values);
    copy_new(part.colors, numbers, to.colors, at.colors);
    const std::span<const std::uint32_t> of_first = numbers.of_first;
    std::ranges::transform(
        part.triangles, to.triangles.begin() + static_cast<std::ptrdiff_t>(at.triangles),
        [&](std::uint32_t corner) {
            return corner < of_first.size() ? of_first[corner] : corner + numbers.offset;
        });
    std::ranges::copy(part.cases, to.cases.begin() + static_cast<std::ptrdiff_t>(at.cases));
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
    const Numbers numbers = number(part);
    const MeshEnds at = MeshEnds::of(to);
    at.after(part, numbers.count).fit(to);
    copy(part, numbers, to, at);
}

/// Only vertices of the part's first plane of cells can be shared, and these come first. Those of its
/// last plane come last.
PartsJoiner::Numbers PartsJoiner::number(const MeshPart& part) {
    Numbers numbers{};
    if (part.vertices.empty())
        return numbers;
    const std::uint32_t before = vertices_, end = part.vertices.front().z + 1u;
    for (const MeshVertex& vertex : part.vertices) {
        if (vertex.z > end)
            break;
        const EdgeKey key = key_of(vertex);
        const auto found = std::ranges::lower_bound(shared_, key, {}, &SharedVertex::key);
        if (found != shared_.end() && found->key == key) {
            numbers.of_first.push_back(found->number);
        } else {
            numbers.new_first.push_back(static_cast<std::uint32_t>(numbers.of_first.size()));
            numbers.of_first.push_back(vertices_++);
        }
    }
    const auto first = static_cast<std::uint32_t>(numbers.of_first.size()),
               all = static_cast<std::uint32_t>(part.vertices.size());
    numbers.offset = vertices_ - first;
    vertices_ += all - first;
    numbers.count = vertices_ - before;
    // The vertices of a plane of cells are in its lower or its upper plane of vertices.
    std::uint32_t top = 0;
    shared_.clear();
    for (std::uint32_t i = all; i-- > 0 && part.vertices[i].z + 1u >= top;) {
        const MeshVertex& vertex = part.vertices[i];
        if (vertex.z > top)
            shared_.clear();
        top = std::max<std::uint32_t>(top, vertex.z);
        if (vertex.z == top)
            shared_.push_back(
                {key_of(vertex), i < first ? numbers.of_first[i] : i + numbers.offset});
    }
    std::ranges::sort(shared_, {}, &SharedVertex::key);
    return numbers;
}

CellMesh join_parts(std::vector<MeshPart> parts) {
    if (parts.size() == 1)
        return std::move(parts.front());
    CellMesh mesh;
    PartsJoiner joiner;
    std::vector<PartsJoiner::Numbers> numbers;
    std::vector<MeshEnds> at(1);
    for (const MeshPart& part : parts) {
        numbers.push_back(joiner.number(part));
        at.push_back(at.back().after(part, numbers.back().count));
    }
    at.back().fit(mesh);
    const bool large = at.back().vertices >= kVerticesOfThread;
    parallel_for(parts.size(), large ? thread_count(0) : 1,
                 [&](std::size_t i, unsigned) { copy(parts[i], numbers[i], mesh, at[i]); }, {});
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
