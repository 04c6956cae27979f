// Reads the group /VTKHDF, after "VTKHDF File Format", https://docs.vtk.org (VTK 9.3).
#include "index/readers/decoders/hdf5/vtkhdf.h"

#include "index/error.h"
#include "index/readers/decoders/hdf5/hdf5_volume.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

const std::string kRoot = "/VTKHDF", kPoints = "/VTKHDF/PointData/", kCells = "/VTKHDF/CellData/",
                  kSteps = "/VTKHDF/Steps";

/// Numbers of an attribute; `otherwise` if it is missing. @throws Error when there are not `count`
std::vector<double> expect_numbers(const Hdf5File& file, const char* attribute, std::size_t count,
                                   std::vector<double> otherwise) {
    std::vector<double> found = file.numbers(kRoot, attribute);
    if (found.empty() && !otherwise.empty())
        return otherwise;
    if (found.size() != count)
        throw Error("{}: {} of /VTKHDF has {} numbers, expected {}", file.name(), attribute,
                    found.size(), count);
    return found;
}

/// Sets the grid. @return vertices along each axis @throws Error
std::array<std::uint64_t, 3> place_vtkhdf(const Hdf5File& file, SeriesInfo& info) {
    const auto extent = expect_numbers(file, "WholeExtent", 6, {});
    const auto origin = expect_numbers(file, "Origin", 3, {0, 0, 0});
    const auto spacing = expect_numbers(file, "Spacing", 3, {1, 1, 1});
    const auto direction = expect_numbers(file, "Direction", 9, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    std::array<std::int64_t, 3> sizes{};
    glm::dmat3 steps(0.0);
    glm::dvec3 first(origin[0], origin[1], origin[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double length = extent[2 * axis + 1] - extent[2 * axis] + 1;
        constexpr double kMost = 1e9;
        sizes[axis] = static_cast<std::int64_t>(length >= -kMost && length <= kMost ? length : -1);
        for (std::size_t row = 0; row < 3; ++row)
            steps[static_cast<int>(axis)][static_cast<int>(row)] =
                direction[3 * row + axis] * spacing[axis];
        first += extent[2 * axis] * steps[static_cast<int>(axis)];
    }
    info.grid.vertices = checked_vertices(sizes, file.name());
    set_axes(info.grid, steps, file.name());
    info.grid.origin = first;
    return {info.grid.vertices[0], info.grid.vertices[1], info.grid.vertices[2]};
}

/// The layout of a dataset whose last dimensions, before components, match the vertices or cells;
/// none if they do not.
std::optional<ArrayLayout> vtkhdf_layout(const Hdf5Dataset& dataset,
                                         std::array<std::uint64_t, 3> sizes, bool on_cells,
                                         bool in_steps) {
    for (std::uint64_t& size : sizes)
        size -= on_cells ? 1 : 0;
    const auto& dimensions = dataset.dimensions;
    const std::size_t before = in_steps ? 1 : 0, rank = dimensions.size();
    if (rank < 3 + before || rank > 4 + before)
        return std::nullopt;
    ArrayLayout layout;
    layout.space = {before + 2, before + 1, before};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (dimensions[layout.space[axis]] != sizes[axis])
            return std::nullopt;
    if (in_steps)
        layout.time = 0;
    if (rank > 3 + before)
        layout.component = rank - 1;
    return layout;
}

void take_steps(const Hdf5File& file, const std::string& array, Hdf5Volume& volume) {
    const auto times = file.dataset(kSteps + "/Values");
    if (!times)
        throw Error("{}: {} has no Values", file.name(), kSteps);
    volume.info.times = file.values(*times);
    const bool on_cells = volume.on_cells;
    const auto offsets = file.dataset(
        fmt::format("{}/{}/{}", kSteps, on_cells ? "CellDataOffsets" : "PointDataOffsets", array));
    const std::uint64_t there = volume.datasets.front().dimensions[*volume.layout.time];
    std::vector<double> places;
    for (std::size_t step = 0; step < volume.info.times.size(); ++step)
        places.push_back(static_cast<double>(step));
    if (offsets)
        places = file.values(*offsets);
    for (const double place : places) {
        if (places.size() != volume.info.times.size() || !(place >= 0) ||
            place >= static_cast<double>(there))
            throw Error("{}: {} holds {} steps, expected those of {} times", file.name(),
                        volume.datasets.front().path, there, volume.info.times.size());
        volume.places.push_back(static_cast<std::uint64_t>(place));
    }
    expect_few_steps(volume.places.size(), file.name());
}

/// Arrays that are shown, and flags of hidden points and cells, which are not followed.
bool is_flag(const std::string& path) {
    return path.ends_with("/vtkGhostType");
}

void note_unread(const Hdf5File& file, SeriesInfo& info) {
    std::vector<std::string> unread;
    if (const auto version = file.numbers(kRoot, "Version"); version.size() == 2 && version[0] > 2)
        unread.push_back(fmt::format("Version {}.{}, read as 2", version[0], version[1]));
    constexpr std::array kRead{"Version", "Type",      "WholeExtent", "Origin",
                               "Spacing", "Direction", "NSteps"};
    for (const std::string& group : {kRoot, kSteps})
        for (const std::string& name : file.attributes(group))
            if (std::ranges::find(kRead, name) == kRead.end())
                unread.push_back(name);
    for (const Hdf5Dataset& dataset : file.datasets()) {
        if (dataset.path.starts_with(kRoot + "/FieldData/") || is_flag(dataset.path))
            unread.push_back(dataset.path.substr(kRoot.size() + 1));
    }
    if (auto note = note_on_unread(unread))
        info.notes.push_back(std::move(*note));
}

} // namespace

bool is_vtkhdf(const Hdf5File& file) {
    return !file.texts(kRoot, "Type").empty();
}

std::unique_ptr<DecodedFile> decode_vtkhdf(std::unique_ptr<Hdf5File> file,
                                           const ReadOptions& options) {
    if (const std::string type = file->text(kRoot, "Type"); type != "ImageData")
        throw Error("{}: VTKHDF of type {}, expected ImageData", file->name(), type);
    Hdf5Volume volume;
    const auto sizes = place_vtkhdf(*file, volume.info);
    const bool in_steps = file->holds(kSteps);
    std::vector<StoredArray> offered;
    for (const Hdf5Dataset& dataset : file->datasets())
        for (const bool on_cells : {false, true}) {
            const std::string& group = on_cells ? kCells : kPoints;
            const auto layout = vtkhdf_layout(dataset, sizes, on_cells, in_steps);
            if (!dataset.path.starts_with(group) || !layout || !dataset.type ||
                is_flag(dataset.path))
                continue;
            const auto components = layout->component ? dataset.dimensions[*layout->component] : 1;
            offered.push_back({.name = dataset.path.substr(group.size()),
                               .type = dataset.type,
                               .components = static_cast<std::uint32_t>(
                                   std::min<std::uint64_t>(components, 1000)),
                               .on_cells = on_cells});
        }
    const ChosenScalar chosen = choose_scalar(offered, options, file->name());
    const std::string& name = chosen.array.name;
    volume.info.arrays = chosen.offered;
    volume.on_cells = chosen.array.on_cells;
    volume.datasets = {*file->dataset((volume.on_cells ? kCells : kPoints) + name)};
    volume.layout = *vtkhdf_layout(volume.datasets.front(), sizes, volume.on_cells, in_steps);
    if (in_steps)
        take_steps(*file, name, volume);
    note_unread(*file, volume.info);
    return open_volume(std::move(file), name, std::move(volume), options);
}

} // namespace isochron::index
