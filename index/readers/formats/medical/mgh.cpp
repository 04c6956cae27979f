// FreeSurfer's volumes (.mgh, .mgz).
//
// Fields after https://surfer.nmr.mgh.harvard.edu/fswiki/FsTutorial/MghFormat: big-endian, a header
// of 284 bytes, the values, and behind them TR, flip angle, TE and TI.
#include "index/error.h"
#include "index/readers/formats/binary_header.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/stored_file.h"

#include <bit>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMghBytes = 284;

StoredType type_of_mgh(std::int32_t code, const std::string& name) {
    switch (code) {
    case 0: return StoredType::u8;
    case 1: return StoredType::i32;
    case 3: return StoredType::f32;
    case 4: return StoredType::i16;
    case 10: return StoredType::u16;
    default:
        throw Error("{}: MGH of type {}, expected 0, 1, 3, 4 or 10; FreeSurfer's mri_convert makes "
                    "NIfTI of it",
                    name, code);
    }
}

/// The center of the volume and the directions of its axes; without them it is coronal.
void place_mgh(const BinaryHeader& h, const std::string& name, SeriesInfo& info) {
    glm::dmat3 axes(-1, 0, 0, 0, 0, -1, 0, 1, 0);
    glm::dvec3 center(0.0);
    if (h.at<std::int16_t>(28) > 0) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto of_axis = static_cast<std::size_t>(axis);
            for (int row = 0; row < 3; ++row)
                axes[axis][row] =
                    h.at<float>(42 + 12 * of_axis + 4 * static_cast<std::size_t>(row));
            axes[axis] *= static_cast<double>(h.at<float>(30 + 4 * of_axis));
            center[axis] = h.at<float>(78 + 4 * of_axis);
        }
    } else {
        info.notes.emplace_back("the file says nothing of its place: it is taken for coronal");
    }
    set_axes(info.grid, axes, name);
    const auto& size = info.grid.vertices;
    info.grid.origin = center - axes * glm::dvec3(size[0] / 2.0, size[1] / 2.0, size[2] / 2.0);
    info.anatomy = Anatomy::ras;
    info.length_unit = "mm";
}

} // namespace

std::unique_ptr<VolumeFile> open_mgh(const fs::path& path, const ReadOptions& options) {
    const std::string name = path.string(), head = head_of(path, kMghBytes);
    if (head.size() < kMghBytes)
        throw Error("{}: truncated: {} bytes, an MGH header has {}", name, head.size(), kMghBytes);
    const BinaryHeader h(head, std::endian::native == std::endian::little);
    if (const auto version = h.at<std::int32_t>(0); version != 1)
        throw Error("{}: not MGH: version {}, expected 1", name, version);
    SeriesInfo info;
    info.grid.vertices = checked_vertices(
        {h.at<std::int32_t>(4), h.at<std::int32_t>(8), h.at<std::int32_t>(12)}, name);
    const auto frames = h.at<std::int32_t>(16);
    if (frames < 1)
        throw Error("{}: {} steps, expected at least 1", name, frames);
    StoredLayout layout;
    layout.data = path;
    layout.big_endian = true;
    layout.compression = is_gzip(path) ? Compression::deflate : Compression::none;
    layout.skip = kMghBytes;
    layout.steps = static_cast<std::size_t>(frames);
    layout.array = {"values", type_of_mgh(h.at<std::int32_t>(20), name)};
    place_mgh(h, name, info);
    if (layout.steps > 1) {
        // TR follows the values; files without it end there.
        const std::uint64_t end = kMghBytes + layout.steps * info.grid.vertex_count() *
                                                  std::uint64_t{stored_bytes(layout)};
        const auto values = open_data(path, 0, layout.compression);
        if (std::string footer(4, '\0'); values->rest(end).bytes >= footer.size()) {
            values->read(end, std::as_writable_bytes(std::span(footer)));
            layout.time_step = BinaryHeader(footer, true).at<float>(0);
            info.time_unit = "ms";
        }
    }
    ReadOptions with_footer = options;
    with_footer.allow_surplus = true;
    return open_stored(path, std::move(info), layout, with_footer);
}

} // namespace isochron::index
