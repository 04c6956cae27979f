// MRC and CCP4 maps, tomograms and image stacks (.mrc, .map, .rec), also compressed by gzip.
//
// A. Cheng and others, "MRC2014: Extensions to the MRC format header for electron cryo-microscopy
// and tomography", Journal of Structural Biology 192, 2015, doi:10.1016/j.jsb.2015.04.002;
// https://www.ccpem.ac.uk/mrc_format/mrc2014.php. Cells lie as in the PDB: a along x, b in the plane
// of x and y.
#include "index/error.h"
#include "index/readers/formats/binary_header.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMrcBytes = 1024;

using Three = std::array<std::int32_t, 3>;

template <class T>
std::array<T, 3> three_at(const BinaryHeader& h, std::size_t offset) {
    return {h.at<T>(offset), h.at<T>(offset + 4), h.at<T>(offset + 8)};
}

/// Whether sizes, mode and order of the axes can be those of a map.
bool is_believable(const BinaryHeader& h) {
    constexpr std::int32_t kMostAlong = 1 << 20;
    constexpr std::array kModes{0, 1, 2, 3, 4, 6, 12, 16, 101};
    const Three sizes = three_at<std::int32_t>(h, 0);
    Three order = three_at<std::int32_t>(h, 64);
    std::ranges::sort(order);
    return std::ranges::all_of(sizes, [](auto n) { return n >= 1 && n <= kMostAlong; }) &&
           std::ranges::find(kModes, h.at<std::int32_t>(12)) != kModes.end() &&
           (order == Three{1, 2, 3} || order == Three{0, 0, 0});
}

/// Whether bytes were written by IMOD, whose flags begin at byte 156.
bool is_of_imod(const BinaryHeader& h) {
    constexpr std::int32_t kStamp = 1146047817;
    return h.at<std::int32_t>(152) == kStamp;
}

/// How the values are stored.
void take_mode(const BinaryHeader& h, const std::string& name, SeriesInfo& info,
               StoredLayout& layout) {
    const auto mode = h.at<std::int32_t>(12);
    StoredArray& array = layout.array;
    array = {"values", StoredType::f32};
    switch (mode) {
    case 0: {
        constexpr std::int32_t kSigned = 1;
        const float greatest = h.at<float>(80);
        const bool by_imod = is_of_imod(h) && (h.at<std::int32_t>(156) & kSigned) == 0;
        const bool by_greatest = !is_of_imod(h) && greatest > 127 && greatest < 256;
        array.type = by_imod || by_greatest ? StoredType::u8 : StoredType::i8;
        if (by_greatest)
            info.notes.push_back(fmt::format("bytes are taken for unsigned, as the greatest is "
                                             "stated as {}",
                                             greatest));
        break;
    }
    case 1: array.type = StoredType::i16; break;
    case 2: break;
    case 3:
        array.type = StoredType::i16;
        array.components = 2;
        break;
    case 4: array.components = 2; break;
    case 6: array.type = StoredType::u16; break;
    case 12: layout.half = true; break;
    case 16:
        array.type = StoredType::u8;
        array.components = 3;
        break;
    default:
        throw Error("{}: MRC of mode {}, expected 0, 1, 2, 3, 4, 6, 12 or 16; IMOD's newstack "
                    "-mode 0 IN OUT writes bytes",
                    name, mode);
    }
}

/// The edges of the unit cell as columns; those that the file does not give have a length of 0.
glm::dmat3 cell_edges(const std::array<float, 3>& lengths, std::array<float, 3> angles,
                      const std::string& name) {
    for (float& angle : angles)
        if (angle == 0)
            angle = 90;
    const auto cosine = [&](std::size_t i) { // exactly 0 at right angles
        return angles[i] == 90 ? 0.0 : std::cos(angles[i] * std::numbers::pi / 180);
    };
    const double alpha = cosine(0), beta = cosine(1), gamma = cosine(2);
    const double sine = std::sqrt(1 - gamma * gamma), up = (alpha - beta * gamma) / sine;
    const double height = 1 - beta * beta - up * up;
    if (!(sine > 0) || !(height > 0))
        throw Error(
            "{}: a cell with angles of {}, {} and {} degrees, expected those of a parallelepiped",
            name, angles[0], angles[1], angles[2]);
    return {glm::dvec3(1, 0, 0) * static_cast<double>(lengths[0]),
            glm::dvec3(gamma, sine, 0) * static_cast<double>(lengths[1]),
            glm::dvec3(beta, up, std::sqrt(height)) * static_cast<double>(lengths[2])};
}

/// Where the vertices lie: ORIGIN, or where it is zero NXSTART, as in ChimeraX.
void place_mrc(const BinaryHeader& h, const Three& order, const std::string& name, SeriesInfo& info,
               std::vector<std::string>& unread) {
    const Three samples = three_at<std::int32_t>(h, 28), start = three_at<std::int32_t>(h, 16);
    const auto lengths = three_at<float>(h, 40), origin = three_at<float>(h, 196);
    const glm::dmat3 edges = cell_edges(lengths, three_at<float>(h, 52), name);
    glm::dmat3 axes(1.0);
    bool sized = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        sized = sized && lengths[axis] > 0 && std::isfinite(lengths[axis]) && samples[axis] > 0;
    for (int i = 0; i < 3; ++i) {
        const int along = order[static_cast<std::size_t>(i)] - 1;
        axes[i] = glm::dvec3(0.0);
        axes[i][along] = 1;
        if (sized)
            axes[i] = edges[along] / static_cast<double>(samples[static_cast<std::size_t>(along)]);
    }
    set_axes(info.grid, axes, name);
    info.length_unit = sized ? "angstrom" : "";
    glm::dvec3 by_start(0.0), by_origin(origin[0], origin[1], origin[2]);
    for (int i = 0; i < 3; ++i)
        by_start += axes[i] * static_cast<double>(start[static_cast<std::size_t>(i)]);
    if (by_origin == glm::dvec3(0.0)) {
        info.grid.origin = by_start;
        return;
    }
    info.grid.origin = by_origin;
    constexpr double kSlack = 1e-3;
    if (by_start != glm::dvec3(0.0) &&
        glm::length(by_start - by_origin) > kSlack * glm::length(axes[0]))
        unread.push_back(
            fmt::format("NXSTART {} {} {} (ORIGIN places the map)", start[0], start[1], start[2]));
    constexpr std::int32_t kAsInMrc2014 = 4;
    if (is_of_imod(h) && (h.at<std::int32_t>(156) & kAsInMrc2014) == 0)
        info.notes.emplace_back("the origin is taken as in MRC2014; old versions of IMOD wrote it "
                                "with the other sign (--origin)");
}

/// Volumes that follow each other in a stack.
std::size_t steps_of_stack(const BinaryHeader& h, Three& sizes, const std::string& name,
                           SeriesInfo& info) {
    constexpr std::int32_t kImages = 0, kVolumeStack = 401;
    const auto group = h.at<std::int32_t>(88), sections = h.at<std::int32_t>(36);
    if (group == kImages && sections == 1 && sizes[2] > 1)
        info.notes.emplace_back("a stack of images: they are taken for slices");
    if (group < kVolumeStack || sections < 1)
        return 1;
    if (sizes[2] % sections != 0)
        throw Error("{}: a stack of volumes of {} sections, expected a multiple of MZ, {}", name,
                    sizes[2], sections);
    const std::int32_t steps = sizes[2] / sections;
    sizes[2] = sections;
    return static_cast<std::size_t>(steps);
}

} // namespace

bool is_mrc(const std::string& head) {
    return head.size() >= kMrcBytes &&
           (is_believable({head, false}) || is_believable({head, true}));
}

std::unique_ptr<VolumeFile> open_mrc(const fs::path& path, const ReadOptions& options) {
    const std::string name = path.string(), head = head_of(path, kMrcBytes);
    if (head.size() < kMrcBytes)
        throw Error("{}: truncated: {} bytes, an MRC header has {}", name, head.size(), kMrcBytes);
    const bool swapped = !is_believable({head, false});
    const BinaryHeader h(head, swapped);
    Three sizes = three_at<std::int32_t>(h, 0), order = three_at<std::int32_t>(h, 64);
    if (!is_believable(h)) {
        const BinaryHeader as_is(head, false);
        throw Error("{}: not MRC: {} x {} x {} values of mode {}, axes {} {} {}", name,
                    as_is.at<std::int32_t>(0), as_is.at<std::int32_t>(4), as_is.at<std::int32_t>(8),
                    as_is.at<std::int32_t>(12), as_is.at<std::int32_t>(64),
                    as_is.at<std::int32_t>(68), as_is.at<std::int32_t>(72));
    }
    if (order == Three{0, 0, 0})
        order = {1, 2, 3};
    SeriesInfo info;
    StoredLayout layout;
    layout.data = path;
    layout.big_endian = swapped;
    layout.compression = is_gzip(path) ? Compression::deflate : Compression::none;
    const auto extended = h.at<std::int32_t>(92);
    if (extended < 0)
        throw Error("{}: an extended header of {} bytes, expected 0 or more", name, extended);
    layout.skip = kMrcBytes + static_cast<std::uint64_t>(extended);
    take_mode(h, name, info, layout);
    layout.steps = steps_of_stack(h, sizes, name, info);
    info.grid.vertices = checked_vertices({sizes[0], sizes[1], sizes[2]}, name);
    std::vector<std::string> unread;
    place_mrc(h, order, name, info, unread);
    if (extended > 0)
        unread.push_back(fmt::format("the extended header {}", h.text(104, 4)));
    constexpr std::size_t kLabel = 80;
    if (h.at<std::int32_t>(220) > 0)
        if (const std::string label = h.text(224, kLabel); !label.empty())
            unread.push_back(fmt::format("LABEL {}", excerpt(label)));
    if (auto note = note_on_unread(unread))
        info.notes.push_back(std::move(*note));
    return open_stored(path, std::move(info), layout, options);
}

} // namespace isochron::index
