// Searches, meshes and values of an open index for several threads at once.
#include "app/python/runs.h"

#include "app/indexing/asked_build.h"
#include "app/indexing/file_patterns.h"
#include "index/error.h"
#include "index/extraction/profile.h"
#include "index/file/color_source.h"
#include "index/file/index_states.h"
#include "index/file/named_index.h"
#include "index/measure/kept_pieces.h"
#include "index/search/layer_search.h"
#include "index/system/parallel.h"
#include "index/system/team.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cstring>
#include <span>

namespace isochron::app {
namespace {

/// Copies what a block of planes of values and a box share.
/// @param first of the block, along z, y and x @param size of the block
void copy_shared(std::span<const std::byte> from, const std::array<std::uint32_t, 3>& first,
                 const std::array<std::uint32_t, 3>& size, const Box& box, std::size_t value_bytes,
                 std::vector<std::byte>& to) {
    Box shared;
    for (int axis = 0; axis < 3; ++axis)
        shared[axis] = {std::max(first[axis], box[axis][0]),
                        std::min(first[axis] + size[axis], box[axis][1])};
    if (shared[2][0] >= shared[2][1])
        return;
    const std::size_t row = (shared[2][1] - shared[2][0]) * value_bytes;
    const std::size_t rows = box[1][1] - box[1][0], columns = box[2][1] - box[2][0];
    for (std::uint32_t z = shared[0][0]; z < shared[0][1]; ++z)
        for (std::uint32_t y = shared[1][0]; y < shared[1][1]; ++y) {
            const std::size_t source =
                (std::size_t{z - first[0]} * size[1] + (y - first[1])) * size[2] +
                (shared[2][0] - first[2]);
            const std::size_t target =
                ((z - box[0][0]) * rows + (y - box[1][0])) * columns + (shared[2][0] - box[2][0]);
            std::memcpy(to.data() + target * value_bytes, from.data() + source * value_bytes, row);
        }
}

/// The places, ascending, of a layer's chunks in which a box lies.
std::vector<std::uint32_t> places_of(const index::ChunkGrid& grid, const Box& box) {
    constexpr std::uint32_t kEdge = index::kChunkEdge;
    std::vector<std::uint32_t> places;
    for (std::uint32_t y = box[1][0] / kEdge; y * kEdge < box[1][1]; ++y)
        for (std::uint32_t x = box[2][0] / kEdge; x * kEdge < box[2][1]; ++x)
            places.push_back(grid.place(x, y));
    std::ranges::sort(places);
    return places;
}

std::vector<std::uint32_t> sorted(std::span<const index::CellId> cells) {
    std::vector<std::uint32_t> found(cells.begin(), cells.end());
    std::ranges::sort(found);
    return found;
}

template <class Number>
Triangles<Number> unpacked(const index::CellMesh& mesh, const index::Grid& grid,
                           const glm::dvec3& origin, bool normals) {
    Triangles<Number> result;
    result.points.reserve(3 * mesh.vertices.size());
    for (const index::MeshVertex& vertex : mesh.vertices) {
        const glm::dvec3 at = grid.physical(position_of(vertex)) - origin;
        for (int axis = 0; axis < 3; ++axis)
            result.points.push_back(static_cast<Number>(at[axis]));
    }
    for (const index::MeshVertex& vertex : mesh.vertices) {
        if (!normals)
            break;
        const glm::dvec3 normal = normal_of(vertex);
        for (int axis = 0; axis < 3; ++axis)
            result.normals.push_back(static_cast<float>(normal[axis]));
    }
    result.values = mesh.values;
    result.faces.assign(mesh.triangles.begin(), mesh.triangles.end());
    if (glm::determinant(grid.direction) < 0)
        for (std::size_t i = 0; i + 2 < result.faces.size(); i += 3)
            std::swap(result.faces[i + 1], result.faces[i + 2]);
    return result;
}

} // namespace

index::Query RunArray::query(const AskedInstant& at, double isovalue) const {
    return {index::instant_named(*file_, at.step, at.fraction), isovalue};
}

CellNumbers RunArray::cells(const AskedInstant& at, double isovalue, std::size_t level) {
    const index::Query asked = query(at, isovalue);
    const index::Grid& grid = file_->chunks(level).info().grid;
    CellNumbers result;
    result.are_wide = index::has_wide_ids(grid);
    const auto make = [&] {
        // Cells with wide numbers have their places in their points alone.
        return std::make_unique<index::SearchInto>(index::search_into(
            file_, std::nullopt, result.are_wide ? index::Shading::cells : index::Shading::none));
    };
    index::CellSet set =
        level > 0 ? search_level(file_, level, asked)
                  : searches_.with(make, [&](index::SearchInto& search) {
                        index::CellSet found;
                        search(index::step_of_query(*file_, asked.instant, {&isovalue, 1}),
                               isovalue, {}, found);
                        return found;
                    });
    if (result.are_wide) {
        result.wide.reserve(set.points.size());
        for (const index::CellPoint& point : set.points)
            result.wide.push_back(index::wide_id(grid, point.x, point.y, point.z));
    } else {
        result.narrow = std::move(set.ids);
    }
    return result;
}

CellDifference RunArray::change(const AskedInstant& at, double isovalue,
                                const AskedInstant& to_moment, double to_isovalue) {
    const index::Query from = query(at, isovalue), to = query(to_moment, to_isovalue);
    index::expect_narrow_ids(*file_);
    const auto make = [this] { return std::make_unique<index::ChangeSearch>(file_); };
    bool whole = false;
    CellDifference result = changes_.with(make, [&](index::ChangeSearch& search) {
        const index::CellChange change = search(from, to);
        whole = change.whole;
        return whole ? CellDifference{}
                     : CellDifference{sorted(change.added), sorted(change.removed)};
    });
    if (whole) {
        const std::vector<std::uint32_t> before = cells(at, isovalue, 0).narrow,
                                         after = cells(to_moment, to_isovalue, 0).narrow;
        std::ranges::set_difference(after, before, std::back_inserter(result.added));
        std::ranges::set_difference(before, after, std::back_inserter(result.removed));
    }
    return result;
}

/// The number of an array whose values are wanted on a surface.
std::optional<std::size_t> RunArray::source_called(const std::optional<std::string>& name) const {
    if (!name)
        return std::nullopt;
    const auto found = index::color_source_named(*file_, *name);
    if (!found)
        throw index::Error(file_->name() + ": no array " + *name + " with values");
    return found;
}

index::CellMesh RunArray::packed_mesh(const AskedInstant& at, double isovalue, std::size_t level,
                                      const WishedOfMesh& wished) {
    const index::Query asked = query(at, isovalue);
    if (level > 0) {
        index::CellMesh mesh;
        index::LayerSearch(file_).make_mesh(
            index::step_in_chunks(*file_, asked.instant, level, {&isovalue, 1}),
            search_level(file_, level, asked), mesh, {});
        return mesh;
    }
    const index::MeshWishes wishes{.values = source_called(wished.values)};
    const auto make = [this] { return std::make_unique<index::SurfaceMeshes>(file_); };
    index::CellMesh mesh = meshes_.with(make, [&](index::SurfaceMeshes& meshes) {
        return *meshes.make_packed(asked, wishes); // which nobody stops
    });
    if (wished.dust > 0)
        index::keep(mesh, index::kept_pieces(mesh, file_->info().grid, index::is_complete(*file_),
                                             {.dust = wished.dust}, 0));
    return mesh;
}

Triangles<float> RunArray::mesh_from_origin(const AskedInstant& at, double isovalue,
                                            std::size_t level, const WishedOfMesh& wished) {
    const index::Grid& grid = file_->chunks(level).info().grid;
    return unpacked<float>(packed_mesh(at, isovalue, level, wished), grid, grid.origin,
                           wished.normals);
}

Triangles<double> RunArray::mesh(const AskedInstant& at, double isovalue, std::size_t level,
                                 const WishedOfMesh& wished) {
    return unpacked<double>(packed_mesh(at, isovalue, level, wished),
                            file_->chunks(level).info().grid, glm::dvec3(0.0), wished.normals);
}

index::MeasuredSurface RunArray::measure(const AskedInstant& at, double isovalue,
                                         const std::optional<std::string>& on_surface, bool pieces,
                                         const std::optional<index::VertexBox>& box,
                                         const std::optional<index::CutPlane>& clip,
                                         std::uint32_t dust,
                                         const std::optional<glm::dvec3>& from) {
    const index::Query asked = query(at, isovalue);
    index::MeasureWishes wishes{.array = source_called(on_surface),
                                .box = box,
                                .clip = clip,
                                .from = from,
                                .pieces = pieces};
    wishes.kept.dust = dust;
    const auto make = [this] { return std::make_unique<index::SurfaceMeasures>(file_); };
    return measures_.with(make, [&](index::SurfaceMeasures& measures) {
        return *measures.measure(asked, wishes); // which nobody stops
    });
}

std::vector<double> RunArray::profile(const AskedInstant& at,
                                      std::vector<glm::dvec3> places) const {
    return index::rows_of(index::profile_of(
        {file_, index::instant_named(*file_, at.step, at.fraction), std::move(places)}));
}

index::FirstCrossings RunArray::first_crossings(double isovalue, bool blended) const {
    index::expect_narrow_ids(*file_);
    return *index::first_crossings(
        file_->info(), index::search_in(file_, std::nullopt, index::Shading::none), isovalue, {},
        blended ? index::crossings_between(file_, 0, isovalue, {}) : nullptr);
}

std::vector<std::byte> RunArray::values(const AskedInstant& moment, const Box& box,
                                        std::size_t level) const {
    const index::Instant at = index::instant_named(*file_, moment.step, moment.fraction);
    // Part of a step is read by its chunks, whatever is faster for a search.
    const index::StepView step = file_->referral() && level == 0
                                     ? index::step_of(*file_, at)
                                     : index::step_in_chunks(*file_, at, level);
    const std::size_t value_bytes = index::size_of(step.type());
    std::size_t count = 1;
    for (const auto& [first, end] : box)
        count *= end - first;
    std::vector<std::byte> result(count * value_bytes);
    if (count == 0)
        return result;
    if (!step.by_chunks()) {
        const auto& n = step.grid().vertices;
        copy_shared(step.whole({}).values.step_bytes(at.step), {}, {n[2], n[1], n[0]}, box,
                    value_bytes, result);
        return result;
    }
    constexpr std::uint32_t kEdge = index::kChunkEdge;
    const index::ChunkGrid& grid = step.chunk_grid();
    const std::vector<std::uint32_t> places = places_of(grid, box);
    const std::uint32_t first = box[0][0] / kEdge, end = (box[0][1] + kEdge - 1) / kEdge;
    const auto copy_of_layer = [&](std::size_t number, unsigned) {
        const std::uint32_t layer = first + static_cast<std::uint32_t>(number);
        step.fetch(layer, places, {});
        const std::vector<index::ChunkPtr> chunks = step.chunks(layer, places, {});
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto [x, y] = grid.at(places[i]);
            const auto& size = chunks[i]->size;
            copy_shared(chunks[i]->values, {layer * kEdge, y * kEdge, x * kEdge},
                        {size[2], size[1], size[0]}, box, value_bytes, result);
        }
    };
    index::parallel_for(end - first, index::thread_count(0), copy_of_layer, {});
    return result;
}

std::vector<double> RunArray::blended_values(const AskedInstant& at, const Box& box,
                                             std::size_t level) const {
    const std::vector<std::byte> stored = values(at, box, level);
    const index::Blend blend(file_->info().type, file_->info().scaling, 1);
    return index::visit_value_type(blend.type(), [&]<class T>(std::type_identity<T>) {
        std::vector<double> scaled(stored.size() / sizeof(T));
        const auto* const first = reinterpret_cast<const T*>(stored.data());
        std::transform(first, first + scaled.size(), scaled.begin(),
                       [&](T value) { return blend.scaling()(static_cast<double>(value)); });
        return scaled;
    });
}

OpenRun::OpenRun(const std::filesystem::path& path) {
    const auto file = index::open_named_index(path);
    for (std::size_t number = 0; number < file->arrays(); ++number)
        arrays_.push_back(std::make_unique<RunArray>(index::array_of(file, number)));
}

RunArray& OpenRun::array(const std::optional<std::string>& name) const {
    return *arrays_[name ? index::array_number(file(), *name) : 0];
}

std::optional<std::string> OpenRun::lost() const {
    return index::lost_state(file());
}

std::vector<std::string> build_run(const std::vector<std::string>& files,
                                   const std::filesystem::path& out,
                                   const std::vector<std::string>& words,
                                   const std::vector<double>& times, const PythonArrays* arrays,
                                   const index::Progress& progress) {
    BuildArguments asked = build_arguments_of(words);
    asked.files = files;
    asked.out = out;
    set_up_readers(asked);
    const auto team = index::alone();
    AskedBuild build(with_path_within(std::move(asked)), *team);
    BuildSources sources;
    std::vector<std::filesystem::path> found;
    if (arrays) {
        sources = open_sources(
            [&](const index::ReadOptions& options) { return open_arrays(*arrays, options); },
            build.arguments());
    } else {
        found = expand_patterns(build.arguments().files);
        sources = open_sources(found, build.arguments(), progress);
    }
    if (!times.empty()) {
        sources.volume = with_times(std::move(sources.volume), times);
        for (ArraySource& further : sources.further)
            further.series = with_times(std::move(further.series), times);
    }
    std::vector<std::filesystem::path> inputs = found;
    for (const std::filesystem::path& file : sources.volume->files())
        inputs.push_back(file);
    std::error_code ignored;
    for (const std::filesystem::path& input : inputs)
        if (std::filesystem::equivalent(input, out, ignored))
            throw index::Error(out.string() + ": is an input");
    std::vector<std::string> notes = sources.notes;
    if (build.take(std::move(sources), found))
        build.write(progress);
    return notes;
}

} // namespace isochron::app
