// NIfTI-1 and -2, in either byte order. Read without VTK, whose reader reverses the slices if qfac
// is -1, and decompresses the whole file again for every step.
//
// Cox et al., "A (sort of) new image data format standard: NIfTI-1", NeuroImage 22, 2004;
// field meanings after the comments of nifti1.h, https://nifti.nimh.nih.gov/nifti-1.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/formats/binary_header.h"
#include "index/readers/formats/medical/nifti_codes.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/reordered_file.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"
#include "index/readers/formats/unread_fields.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The fields that both versions of the header have.
struct NiftiHeader {
    std::int64_t dim[8];
    double pixdim[8];
    std::int32_t datatype, intent, xyzt_units, qform_code, sform_code;
    double vox_offset, scl_slope, scl_inter, toffset;
    double quatern[3], qoffset[3];
    double srow[3][4];
    std::size_t bytes; ///< size of the header itself
    std::vector<std::string> unread;
    bool big_endian, pair;
};

using Fields = BinaryHeader;

constexpr std::size_t kBytes1 = 348, kBytes2 = 540;

template <class Real>
void read_geometry(const Fields& f, std::size_t quatern, NiftiHeader& h) {
    for (std::size_t i = 0; i < 3; ++i) {
        h.quatern[i] = f.at<Real>(quatern + i * sizeof(Real));
        h.qoffset[i] = f.at<Real>(quatern + (3 + i) * sizeof(Real));
        for (std::size_t j = 0; j < 4; ++j)
            h.srow[i][j] = f.at<Real>(quatern + (6 + 4 * i + j) * sizeof(Real));
    }
}

/// Where fields are that nothing is done with.
struct UnreadPlaces {
    std::size_t dim_info, intent_name, slice_start, slice_end, slice_code, cal_max, cal_min,
        slice_duration, descrip, aux_file;
};

/// @tparam Whole of codes @tparam Index of slices @tparam Real of the others
template <class Whole, class Index, class Real>
std::vector<std::string> unread_in(const Fields& f, const UnreadPlaces& at) {
    std::vector<std::string> unread;
    const auto number = [&](const char* name, double value) {
        if (value != 0)
            unread.push_back(fmt::format("{} {}", name, value));
    };
    const auto text = [&](const char* name, const std::string& value) {
        if (!value.empty())
            unread.push_back(fmt::format("{} {}", name, excerpt(value)));
    };
    number("dim_info", f.at<std::uint8_t>(at.dim_info));
    text("intent_name", f.text(at.intent_name, 16));
    number("slice_start", static_cast<double>(f.at<Index>(at.slice_start)));
    number("slice_end", static_cast<double>(f.at<Index>(at.slice_end)));
    number("slice_code", f.at<std::uint8_t>(at.slice_code));
    number("slice_duration", f.at<Real>(at.slice_duration));
    number("cal_max", f.at<Real>(at.cal_max));
    number("cal_min", f.at<Real>(at.cal_min));
    text("descrip", f.text(at.descrip, 80));
    text("aux_file", f.text(at.aux_file, 24));
    return unread;
}

NiftiHeader header_1(const Fields& f) {
    NiftiHeader h{};
    h.unread = unread_in<std::int16_t, std::int16_t, float>(
        f, {39, 328, 74, 120, 122, 124, 128, 132, 148, 228});
    for (std::size_t i = 0; i < 8; ++i) {
        h.dim[i] = f.at<std::int16_t>(40 + 2 * i);
        h.pixdim[i] = f.at<float>(76 + 4 * i);
    }
    h.intent = f.at<std::int16_t>(68);
    h.datatype = f.at<std::int16_t>(70);
    h.vox_offset = f.at<float>(108);
    h.scl_slope = f.at<float>(112);
    h.scl_inter = f.at<float>(116);
    h.xyzt_units = f.at<std::uint8_t>(123);
    h.toffset = f.at<float>(136);
    h.qform_code = f.at<std::int16_t>(252);
    h.sform_code = f.at<std::int16_t>(254);
    read_geometry<float>(f, 256, h);
    return h;
}

NiftiHeader header_2(const Fields& f) {
    NiftiHeader h{};
    h.unread = unread_in<std::int32_t, std::int64_t, double>(
        f, {524, 508, 224, 232, 496, 192, 200, 208, 240, 320});
    for (std::size_t i = 0; i < 8; ++i) {
        h.dim[i] = f.at<std::int64_t>(16 + 8 * i);
        h.pixdim[i] = f.at<double>(104 + 8 * i);
    }
    h.intent = f.at<std::int32_t>(504);
    h.datatype = f.at<std::int16_t>(12);
    h.vox_offset = static_cast<double>(f.at<std::int64_t>(168));
    h.scl_slope = f.at<double>(176);
    h.scl_inter = f.at<double>(184);
    h.xyzt_units = f.at<std::int32_t>(500);
    h.toffset = f.at<double>(216);
    h.qform_code = f.at<std::int32_t>(344);
    h.sform_code = f.at<std::int32_t>(348);
    read_geometry<double>(f, 352, h);
    return h;
}

// Analyze 7.5, "ANALYZE Header File Format", Mayo Foundation 1990; the scaling is SPM's.
NiftiHeader analyze_header(const Fields& f, bool swapped) {
    NiftiHeader h = header_1(f);
    h.unread.clear();
    if (const int orient = f.at<std::uint8_t>(252); orient != 0)
        h.unread.push_back(fmt::format("orient {}", orient));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (f.at<std::int16_t>(253 + 2 * axis) != 0) {
            h.unread.emplace_back("originator, the origin by SPM (--origin)");
            break;
        }
    h.intent = h.qform_code = h.sform_code = 0;
    h.scl_inter = h.toffset = 0;
    h.vox_offset = std::abs(h.vox_offset); // negative: of each volume
    h.xyzt_units = f.at<char>(56) == 'm' && f.at<char>(57) == 'm' ? 2 : 0;
    h.bytes = kBytes1;
    h.big_endian = swapped;
    h.pair = true;
    return h;
}

NiftiHeader read_header(const fs::path& path) {
    const std::string name = path.string();
    const std::string head = head_of(path, kBytes2);
    if (head.size() < kBytes1)
        throw Error("{}: truncated: {} bytes, a NIfTI header has {}", name, head.size(), kBytes1);
    for (const bool swapped : {false, true}) {
        const Fields fields(head, swapped);
        const auto size = fields.at<std::int32_t>(0);
        if (size != kBytes1 && (size != kBytes2 || head.size() < kBytes2))
            continue;
        const std::string magic = head.substr(size == kBytes1 ? 344 : 4, 4);
        const bool nifti =
            magic[0] == 'n' && (magic[1] == '+' || magic[1] == 'i') && magic[3] == '\0';
        if (!nifti && size == kBytes1)
            return analyze_header(fields, swapped);
        if (!nifti)
            throw Error("{}: not NIfTI: its magic word is missing", name);
        NiftiHeader header = size == kBytes1 ? header_1(fields) : header_2(fields);
        header.bytes = static_cast<std::size_t>(size);
        header.big_endian = swapped;
        header.pair = magic[1] == 'i';
        return header;
    }
    throw Error("{}: not NIfTI: the header's size is {}, expected {} or {}", name,
                Fields(head, false).at<std::int32_t>(0), kBytes1, kBytes2);
}

// The rotation of METHOD 2 in nifti1.h; columns are scaled by pixdim, the third also by qfac.
glm::dmat3 quaternion_axes(const NiftiHeader& h) {
    double b = h.quatern[0], c = h.quatern[1], d = h.quatern[2];
    double a = 1.0 - (b * b + c * c + d * d);
    if (a < 1e-7) { // a rotation by half a turn: `a` is not 0 only because of rounding
        const double scale = 1.0 / std::sqrt(b * b + c * c + d * d);
        b *= scale;
        c *= scale;
        d *= scale;
        a = 0;
    } else {
        a = std::sqrt(a);
    }
    const double qfac = h.pixdim[0] < 0 ? -1.0 : 1.0;
    const glm::dvec3 x(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c));
    const glm::dvec3 y(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b));
    const glm::dvec3 z(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c);
    return {x * std::abs(h.pixdim[1]), y * std::abs(h.pixdim[2]),
            z * (std::abs(h.pixdim[3]) * qfac)};
}

// The sform wins over the qform, as in most tools. Only the sform can be sheared; shear is kept.
void orient(const NiftiHeader& h, const std::string& name, SeriesInfo& info) {
    glm::dmat3 axes(0.0);
    if (h.sform_code > 0) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                axes[column][row] = h.srow[row][column];
            info.grid.origin[row] = h.srow[row][3];
        }
        info.anatomy = Anatomy::ras;
    } else if (h.qform_code > 0) {
        axes = quaternion_axes(h);
        info.grid.origin = {h.qoffset[0], h.qoffset[1], h.qoffset[2]};
        info.anatomy = Anatomy::ras;
    } else {
        for (int axis = 0; axis < 3; ++axis)
            axes[axis][axis] = h.pixdim[axis + 1] == 0 ? 1.0 : std::abs(h.pixdim[axis + 1]);
        info.notes.push_back("the file says nothing of left and right");
    }
    set_axes(info.grid, axes, name);
    const glm::dmat3& d = info.grid.direction;
    const double skew = std::max({std::abs(glm::dot(d[0], d[1])), std::abs(glm::dot(d[1], d[2])),
                                  std::abs(glm::dot(d[2], d[0]))});
    if (skew > 1e-3)
        info.notes.push_back("the axes are sheared");
}

/// Whether the qform places the volume elsewhere than the sform.
bool differ(const NiftiHeader& h) {
    constexpr double kSlack = 1e-3; // share of the distance between vertices
    const glm::dmat3 axes = quaternion_axes(h);
    for (int row = 0; row < 3; ++row) {
        const double size = std::abs(h.pixdim[row + 1]);
        if (!(std::abs(h.qoffset[row] - h.srow[row][3]) <= kSlack * size))
            return true;
        for (int column = 0; column < 3; ++column)
            if (!(std::abs(axes[column][row] - h.srow[row][column]) <=
                  kSlack * std::abs(h.pixdim[column + 1])))
                return true;
    }
    return false;
}

/// `scan.hdr` of `scan.img`, which may be given in its place; empty: it is not there.
fs::path header_of_pair(const fs::path& path) {
    const std::string name = path.string();
    const std::size_t image = name.rfind(".img");
    if (image == std::string::npos || (image + 4 != name.size() && !name.ends_with(".img.gz")))
        return path;
    std::error_code ignored;
    for (const char* extension : {".hdr", ".hdr.gz"})
        if (fs::path header = name.substr(0, image) + extension; fs::exists(header, ignored))
            return header;
    return {};
}

fs::path image_beside(const fs::path& header) {
    std::string name = header.string();
    const std::size_t dot = name.rfind(".hdr");
    std::error_code ignored;
    for (const char* extension : {".img", ".img.gz"}) {
        fs::path image = name.substr(0, dot) + extension;
        if (fs::exists(image, ignored))
            return image;
    }
    throw Error("{}: its .img is not beside it", name);
}

} // namespace

bool has_nifti_header_beside(const fs::path& path) {
    const fs::path header = header_of_pair(path);
    return !header.empty() && header != path;
}

namespace {

/// The file of b-values beside an image, by its name; empty: there is none.
std::string directions_beside(const fs::path& path) {
    fs::path stem = path;
    if (lower_case(stem.extension().string()) == ".gz")
        stem.replace_extension();
    std::error_code ignored;
    for (const char* end : {".bval", ".bvals", ".bvec", ".bvecs"})
        if (fs::exists(stem.replace_extension(end), ignored))
            return stem.filename().string();
    for (const char* name : {"bvals", "bvecs"}) // as FSL names them
        if (fs::exists(path.parent_path() / name, ignored))
            return name;
    return {};
}

} // namespace

std::unique_ptr<VolumeFile> open_nifti(const fs::path& given, const ReadOptions& options) {
    fs::path path = header_of_pair(given);
    if (path.empty()) { // one file for all, or no pair
        path = given;
        const std::string head = head_of(given, kBytes1);
        if (head.size() < kBytes1 || !head.substr(kBytes1 - 4).starts_with("n+1"))
            throw Error("{}: its .hdr is not beside it", given.string());
    }
    const std::string name = path.string();
    const NiftiHeader h = read_header(path);
    const std::int64_t dimensions = h.dim[0];
    if (dimensions < 3 || dimensions > 7)
        throw Error("{}: {} dimensions, expected 3, or 4 with time, or 5 with components", name,
                    dimensions);
    for (std::int64_t i = 6; i <= dimensions; ++i)
        if (h.dim[i] > 1)
            throw Error("{}: {} dimensions, the {}th with {} values; expected 3, or 4 with time, "
                        "or 5 with components",
                        name, dimensions, i, h.dim[i]);

    SeriesInfo info;
    info.grid.vertices = checked_vertices({h.dim[1], h.dim[2], h.dim[3]}, name);
    orient(h, name, info);
    std::vector<std::string> unread = h.unread;
    const NiftiIntent intent = nifti_intent(h.intent);
    const std::string stated = fmt::format(
        "intent_code {}{}", h.intent, intent.name.empty() ? "" : fmt::format(" ({})", intent.name));
    // Components are to be on the fifth axis, but many programs write them on the fourth.
    const bool has_fourth = dimensions == 4 && h.dim[4] > 1;
    const std::string directions = has_fourth ? directions_beside(path) : "";
    const bool diffusion = !directions.empty();
    const bool fourth = has_fourth && (intent.components || diffusion);
    if (diffusion)
        info.notes.push_back(
            fmt::format("{} is beside it: its fourth axis is not time but directions of diffusion",
                        directions));
    else if (fourth)
        info.notes.push_back(stated + ": its fourth axis is not time but components");
    else if (h.intent != 0 && !(intent.components && dimensions > 4) && h.intent != 2001)
        unread.push_back(stated);
    if (h.sform_code > 0 && h.qform_code > 0 && differ(h))
        unread.emplace_back("qform, which differs from the sform");
    std::error_code ignored;
    if (fs::path mat = fs::path(path).replace_extension(".mat"); h.pair && fs::exists(mat, ignored))
        unread.push_back(fmt::format("{} beside it, the place by SPM", mat.filename().string()));
    if (auto note = note_on_unread(unread))
        info.notes.push_back(std::move(*note));
    info.length_unit = nifti_length_unit(h.xyzt_units);
    // scl_slope 0 means that there is no scaling.
    if (h.scl_slope != 0 && std::isfinite(h.scl_slope) && std::isfinite(h.scl_inter))
        info.scaling = {h.scl_slope, h.scl_inter};

    StoredLayout layout;
    layout.array = {diffusion ? "diffusion" : "values", nifti_type(h.datatype, name)};
    layout.big_endian = h.big_endian;
    layout.data = h.pair ? image_beside(path) : path;
    layout.compression = is_gzip(layout.data) ? Compression::deflate : Compression::none;
    const double least = h.pair ? 0.0 : static_cast<double>(h.bytes);
    if (!(h.vox_offset >= least) || h.vox_offset > 1e15)
        throw Error("{}: the data's offset is {}, expected at least {}", name, h.vox_offset, least);
    layout.skip = static_cast<std::uint64_t>(h.vox_offset);
    if (dimensions >= 4) {
        if (h.dim[4] < 1)
            throw Error("{}: {} steps, expected at least 1", name, h.dim[4]);
        layout.steps = static_cast<std::size_t>(h.dim[4]);
    }
    layout.first_time = h.toffset;
    layout.time_step = h.pixdim[4];
    info.time_unit = nifti_time_unit(h.xyzt_units);
    constexpr int kUnitOfFourth = 56, kHertz = 32; // this and those above are no times
    if (layout.steps > 1 && !fourth && (h.xyzt_units & kUnitOfFourth) >= kHertz)
        info.notes.push_back(fmt::format(
            "its fourth axis is in {}, no time: its steps are along it", info.time_unit));
    const int axis = fourth ? 4 : 5;
    if (dimensions < axis || h.dim[axis] <= 1 || (fourth && options.extra_axis_is_time))
        return open_stored(path, std::move(info), layout, options);
    if (fourth)
        layout.steps = 1;
    constexpr std::int64_t kMostComponents = 4096;
    if (h.dim[axis] > kMostComponents)
        throw Error("{}: {} components, expected at most {}", name, h.dim[axis], kMostComponents);
    if (options.extra_axis_is_time && layout.steps == 1) {
        layout.steps = static_cast<std::size_t>(h.dim[5]);
        layout.time_step = h.pixdim[5];
        return open_stored(path, std::move(info), layout, options);
    }
    layout.array.components = static_cast<std::uint32_t>(h.dim[axis]);
    layout.array.maybe_steps = layout.steps == 1;
    return open_stacked_components(path, std::move(info), layout, false, options);
}

} // namespace isochron::index
