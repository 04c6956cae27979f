// Reads headers with GDCM, up to the pixels.
#include "index/readers/decoders/dicom/dicom_header.h"

#include "index/error.h"
#include "index/readers/decoders/dicom/dicom_place.h"
#include "index/readers/decoders/dicom/dicom_tags.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <gdcmReader.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

const gdcm::Tag kPixelData(0x7fe0, 0x0010), kSharedGroups(0x5200, 0x9229),
    kFrameGroups(0x5200, 0x9230);

glm::dvec3 vec3_at(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Looks in the data set of a frame, then in the data set that all frames share, then at the root.
class FrameTags {
  public:
    FrameTags(const DicomTags& root, std::uint32_t frame)
        : places_{root.within(kFrameGroups, frame), root.within(kSharedGroups, 0), root} {}

    /// Numbers of an attribute that stands at the root, or, in files of many frames, in a group.
    std::vector<double> numbers(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        for (const DicomTags& place : places_)
            for (const DicomTags& one : {place.within(group, 0), place})
                if (auto found = one.numbers(tag); !found.empty())
                    return found;
        return {};
    }
    std::optional<double> number(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        const auto found = numbers(group, tag);
        return found.empty() ? std::nullopt : std::optional(found.front());
    }
    std::string text(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        for (const DicomTags& place : places_)
            for (const DicomTags& one : {place.within(group, 0), place})
                if (auto found = one.text(tag); !found.empty())
                    return found;
        return {};
    }

  private:
    std::array<DicomTags, 3> places_;
};

const gdcm::Tag kPosition(0x0020, 0x9113), kOrientation(0x0020, 0x9116), kMeasures(0x0028, 0x9110),
    kTransformation(0x0028, 0x9145), kContent(0x0020, 0x9111), kCardiac(0x0018, 0x9118),
    kTemporal(0x0020, 0x9310), kEcho(0x0018, 0x9114), kDiffusion(0x0018, 0x9117),
    kImageType(0x0018, 0x9226), kDetector(0x0054, 0x0022);

/// Seconds of a day: `HHMMSS.FFF`.
std::optional<double> seconds_of_day(const std::string& text) {
    if (text.size() < 6 || text.find_first_not_of("0123456789.") != text.npos)
        return std::nullopt;
    return std::stod(text.substr(0, 2)) * 3600 + std::stod(text.substr(2, 2)) * 60 +
           std::stod(text.substr(4));
}

void place(const DicomTags& root, const FrameTags& tags, const DicomFile& file,
           const std::string& name, DicomImage& image) {
    const auto direction = tags.numbers(kOrientation, {0x0020, 0x0037});
    const auto detector = root.within(kDetector, 0).numbers({0x0020, 0x0037});
    const std::vector<double>& along = direction.size() == 6 ? direction : detector;
    if (along.size() == 6) {
        image.along = {vec3_at(along, 0), vec3_at(along, 3)};
        const double off = std::abs(glm::dot(image.along[0], image.along[1]));
        for (glm::dvec3& axis : image.along)
            if (!(std::abs(glm::length(axis) - 1) < 1e-2) || !(off < 1e-2))
                throw Error(fmt::format("{}: its rows and columns have directions of other lengths "
                                        "than 1, or are not at right angles",
                                        name));
        image.along[0] = glm::normalize(image.along[0]);
        image.along[1] = glm::normalize(image.along[1] -
                                        image.along[0] * glm::dot(image.along[0], image.along[1]));
    }
    auto position = tags.numbers(kPosition, {0x0020, 0x0032});
    if (position.size() != 3)
        position = root.within(kDetector, 0).numbers({0x0020, 0x0032});
    if (position.size() == 3)
        image.position = vec3_at(position, 0);
    for (const gdcm::Tag& tag : {gdcm::Tag(0x0028, 0x0030), gdcm::Tag(0x0018, 0x1164)})
        if (const auto spacing = tags.numbers(kMeasures, tag); spacing.size() == 2) {
            image.spacing = glm::dvec2(spacing[1], spacing[0]);
            break;
        }
    // A file of many slices in the older way has one position, and says how far they are apart.
    if (!image.position || !root.within(kFrameGroups, 0).empty() || file.frames == 1)
        return;
    const glm::dvec3 normal = glm::cross(image.along[0], image.along[1]);
    const auto offsets = root.numbers({0x3004, 0x000c});
    const double step = root.number({0x0018, 0x0088}).value_or(file.slice_spacing);
    if (offsets.size() == file.frames)
        *image.position += normal * (offsets[image.frame] - offsets[0]);
    else if (step != 0)
        *image.position += normal * (step * image.frame);
}

void time(const DicomTags& root, const FrameTags& tags, DicomImage& image) {
    const auto set = [&](DicomClock clock, std::optional<double> value) {
        if (value && std::isfinite(*value))
            image.clocks[static_cast<std::size_t>(clock)] = value;
    };
    set(DicomClock::time_offset, tags.number(kTemporal, {0x0020, 0x930d}));
    set(DicomClock::trigger_time, tags.number(kCardiac, {0x0020, 0x9153}));
    set(DicomClock::trigger_time, root.number({0x0018, 0x1060}));
    set(DicomClock::temporal_position, root.number({0x0020, 0x0100}));
    set(DicomClock::temporal_position, tags.number(kContent, {0x0020, 0x9128}));
    set(DicomClock::acquisition_time, seconds_of_day(root.text({0x0008, 0x0032})));
    set(DicomClock::content_time, seconds_of_day(root.text({0x0008, 0x0033})));
    set(DicomClock::acquisition, root.number({0x0020, 0x0012}));
    set(DicomClock::instance, image.frame + root.number({0x0020, 0x0013}).value_or(0));
}

void tell_apart(const DicomTags& root, const FrameTags& tags, const DicomFile& file,
                DicomImage& image) {
    const auto add = [&](const char* what, const std::string& value) {
        image.kind.emplace_back(what, value);
    };
    add("series", fmt::format("{} {}", root.text({0x0020, 0x0011}), root.text({0x0008, 0x103e})));
    add("series UID", root.text({0x0020, 0x000e}));
    add("size", fmt::format("{} x {}", file.columns, file.rows));
    add("type", fmt::format("{}", name_of(file.type)));
    std::string directions;
    for (const glm::dvec3& axis : image.along)
        directions +=
            fmt::format(" ({:.2f} {:.2f} {:.2f})", axis.x + 0.0, axis.y + 0.0, axis.z + 0.0);
    add("directions", directions);
    const auto value = [](std::optional<double> number, const char* unit) {
        return number ? fmt::format("{:g} {}", *number, unit) : "";
    };
    auto echo = tags.number(kEcho, {0x0018, 0x9082});
    add("echo time", value(echo ? echo : root.number({0x0018, 0x0081}), "ms"));
    add("inversion time", value(root.number({0x0018, 0x0082}), "ms"));
    add("b-value", value(tags.number(kDiffusion, {0x0018, 0x9087}), "s/mm2"));
    add("image type", tags.text(kImageType, {0x0008, 0x9007}).empty()
                          ? root.text({0x0008, 0x0008})
                          : tags.text(kImageType, {0x0008, 0x9007}));
}

/// The values of pixels. @throws Error
void describe_pixels(const DicomTags& root, const std::string& name, DicomFile& file) {
    const auto whole = [&](const gdcm::Tag& tag, const char* what, double least, double most,
                           std::optional<double> otherwise = {}) {
        const auto number = root.number(tag);
        const double value = number.value_or(otherwise.value_or(-1));
        if (!(value >= least && value <= most) || value != std::floor(value))
            throw Error(fmt::format("{}: {} {}, expected {} to {}", name, what,
                                    number ? fmt::format("{}", value) : "is not said", least,
                                    most));
        return static_cast<std::uint32_t>(value);
    };
    file.rows = whole({0x0028, 0x0010}, "Rows", 1, 65535);
    file.columns = whole({0x0028, 0x0011}, "Columns", 1, 65535);
    constexpr double kMostFrames = 1 << 20;
    file.frames = whole({0x0028, 0x0008}, "NumberOfFrames", 1, kMostFrames, 1);
    file.samples = whole({0x0028, 0x0002}, "SamplesPerPixel", 1, 3, 1);
    const std::uint32_t allocated = whole({0x0028, 0x0100}, "BitsAllocated", 1, 64);
    file.planar = whole({0x0028, 0x0006}, "PlanarConfiguration", 0, 1, 0) == 1;
    file.bits = whole({0x0028, 0x0101}, "BitsStored", 1, allocated, allocated);
    const std::uint32_t high =
        whole({0x0028, 0x0102}, "HighBit", file.bits - 1, allocated - 1, file.bits - 1);
    file.lowest_bit = high + 1 - file.bits;
    const bool with_sign = whole({0x0028, 0x0103}, "PixelRepresentation", 0, 1, 0) == 1;
    switch (allocated) {
    case 8: file.type = with_sign ? StoredType::i8 : StoredType::u8; break;
    case 16: file.type = with_sign ? StoredType::i16 : StoredType::u16; break;
    case 32: file.type = with_sign ? StoredType::i32 : StoredType::u32; break;
    default:
        throw Error(fmt::format("{}: BitsAllocated {}, expected 8, 16 or 32", name, allocated));
    }
    const std::string colors = root.text({0x0028, 0x0004});
    if (colors == "MONOCHROME1")
        file.notes.push_back("its low values are meant to be shown bright (MONOCHROME1)");
    else if (colors != "MONOCHROME2" && colors != "RGB" && !colors.empty())
        throw Error(fmt::format("{}: PhotometricInterpretation {}, expected MONOCHROME2 or RGB",
                                name, excerpt(colors)));
    if (const auto padding = root.number({0x0028, 0x0120}))
        file.notes.push_back(fmt::format("its padding value {} counts as data", *padding));
}

/// @throws Error: there are fewer than the header says
void find_pixels(const fs::path& path, const gdcm::TransferSyntax& syntax, DicomFile& file) {
    if (syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian)
        return;
    const bool big = syntax.GetSwapCode() == gdcm::SwapCode::BigEndian;
    const auto place = place_of_pixels(path, {!syntax.IsImplicit(), big});
    const std::string name = path.string();
    if (!place)
        throw Error(fmt::format("{}: no pixels in it, or damaged before them", name));
    if (place->packed || syntax.IsEncapsulated())
        return;
    const std::uint64_t expected =
        std::uint64_t{file.columns} * file.rows * file.samples * size_of(file.type) * file.frames;
    const std::uint64_t size = file_bytes(path);
    const std::uint64_t there = std::min(place->bytes, size - std::min(size, place->at));
    if (there < expected)
        throw Error(fmt::format("{}: truncated: its pixels have {} bytes, expected {}", name, there,
                                expected));
    file.pixels_at = place->at;
    file.big_endian = big;
}

std::string unit_of(const DicomTags& root, const FrameTags& tags, const std::string& modality) {
    std::string unit = tags.text(kTransformation, {0x0028, 0x1054});
    if (unit.empty())
        unit = root.text({0x0054, 0x1001}); // PET
    if (unit.empty())
        unit = root.text({0x3004, 0x0002}); // dose
    if (unit.empty() && modality == "CT")
        unit = "HU";
    return unit == "US" || unit == "NONE" ? "" : unit;
}

} // namespace

DicomFile read_dicom_header(const fs::path& path, std::size_t number) {
    const std::string name = path.string();
    gdcm::Reader reader;
    reader.SetFileName(path.c_str());
    if (!reader.ReadUpToTag(kPixelData, {kPixelData}))
        throw Error(fmt::format("{}: not DICOM, or damaged", name));
    const DicomTags root(reader.GetFile().GetDataSet(), name);
    DicomFile file;
    if (!root.number({0x0028, 0x0010}) && !root.number({0x0028, 0x0011}))
        return file; // a report, a directory, contours
    describe_pixels(root, name, file);
    find_pixels(path, reader.GetFile().GetHeader().GetDataSetTransferSyntax(), file);
    file.modality = root.text({0x0008, 0x0060});
    if (root.text({0x0008, 0x0008}).find("MOSAIC") != std::string::npos)
        throw Error(fmt::format("{}: a mosaic of slices, expected an image for each slice", name));
    file.slice_spacing =
        root.number({0x0018, 0x0088}).value_or(root.number({0x0018, 0x0050}).value_or(0));
    file.temporal_resolution = root.number({0x0020, 0x0110}).value_or(0);
    const std::uint64_t least = root.within(kFrameGroups, 0).empty() ? 0 : file.frames;
    if (least != 0 && root.items(kFrameGroups) != least)
        throw Error(fmt::format("{}: {} frames are described, expected {}", name,
                                root.items(kFrameGroups), file.frames));
    for (std::uint32_t frame = 0; frame < file.frames; ++frame) {
        DicomImage image;
        image.file = number;
        image.frame = frame;
        const FrameTags tags(root, frame);
        place(root, tags, file, name, image);
        time(root, tags, image);
        tell_apart(root, tags, file, image);
        const double dose = root.number({0x3004, 0x000e}).value_or(1);
        image.scaling = {tags.number(kTransformation, {0x0028, 0x1053}).value_or(1) * dose,
                         tags.number(kTransformation, {0x0028, 0x1052}).value_or(0)};
        if (!std::isfinite(image.scaling.slope) || image.scaling.slope == 0 ||
            !std::isfinite(image.scaling.intercept))
            throw Error(fmt::format("{}: RescaleSlope {} and RescaleIntercept {}, expected finite "
                                    "ones, the slope not 0",
                                    name, image.scaling.slope, image.scaling.intercept));
        if (frame == 0)
            file.value_unit = unit_of(root, tags, file.modality);
        file.images.push_back(std::move(image));
    }
    return file;
}

} // namespace isochron::index
