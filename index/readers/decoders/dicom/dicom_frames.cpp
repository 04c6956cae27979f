// Places, clocks and kinds of images.
#include "index/readers/decoders/dicom/dicom_frames.h"

#include "index/error.h"
#include "index/readers/decoders/dicom/dicom_clocks.h"
#include "index/readers/decoders/dicom/dicom_mosaic.h"
#include "index/readers/decoders/dicom/dicom_vectors.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string_view>

namespace isochron::index {
namespace {

using gdcm::Tag;

const Tag kFrameGroups(0x5200, 0x9230), kContent(0x0020, 0x9111), kDetector(0x0054, 0x0022),
    kTransformation(0x0028, 0x9145), kMeasures(0x0028, 0x9110);

const Tag kGradient(0x0018, 0x9089); // DiffusionGradientOrientation

/// What tells volumes apart in one series, in a group of a frame or else at the root.
struct KindSource {
    const char *name, *unit; ///< unit of its numbers; null: it is text
    Tag group, tag, root;
};
const std::array<KindSource, 10> kKindSources{{
    {"echo time", " ms", {0x0018, 0x9114}, {0x0018, 0x9082}, {0x0018, 0x0081}},
    {"inversion time", " ms", {0x0018, 0x9115}, {0x0018, 0x9079}, {0x0018, 0x0082}},
    {"b-value", " s/mm2", {0x0018, 0x9117}, {0x0018, 0x9087}, {0x0018, 0x9087}},
    {"gradient", "", kNoTag, kGradient, kGradient},
    {"image type", nullptr, {0x0018, 0x9226}, {0x0008, 0x9007}, {0x0008, 0x0008}},
    {"component", nullptr, {0x0018, 0x9226}, {0x0008, 0x9208}, {0x0008, 0x9208}},
    {"voltage", " kV", {0x0018, 0x9325}, {0x0018, 0x0060}, {0x0018, 0x0060}},
    {"stack", nullptr, kContent, {0x0020, 0x9056}, {0x0020, 0x9056}},
    {"segment", "", {0x0062, 0x000a}, {0x0062, 0x000b}, {0x0062, 0x000b}},
    {"velocity direction", "", {0x0018, 0x9197}, {0x0018, 0x9090}, {0x0018, 0x9090}},
}};

/// Diffusion as the headers of makers have it, from before the standard's attributes of it.
///
/// Li et al., "The first step for neuroimaging data analysis: DICOM to NIfTI conversion",
/// J. Neurosci. Methods 264, 2016, doi:10.1016/j.jneumeth.2016.03.001
struct PrivateKind {
    std::string_view name;
    gdcm::PrivateTag tag;
    char form;           ///< t: text, f: f32, d: f64
    std::size_t count;   ///< numbers of it that count
    double beside = 0.0; ///< its multiples are added to a number, and are no part of it
};
const std::array<PrivateKind, 12> kPrivateKinds{{
    {"b-value", {0x0019, 0x0c, "SIEMENS MR HEADER"}, 't', 1},
    {"gradient", {0x0019, 0x0e, "SIEMENS MR HEADER"}, 'd', 3},
    {"b-value", {0x0043, 0x39, "GEMS_PARM_01"}, 't', 1, 1e9},
    {"gradient", {0x0019, 0xbb, "GEMS_ACQU_01"}, 't', 1},
    {"gradient", {0x0019, 0xbc, "GEMS_ACQU_01"}, 't', 1},
    {"gradient", {0x0019, 0xbd, "GEMS_ACQU_01"}, 't', 1},
    {"b-value", {0x2001, 0x03, "Philips Imaging DD 001"}, 'f', 1},
    {"gradient", {0x2005, 0xb0, "Philips MR Imaging DD 001"}, 'f', 1},
    {"gradient", {0x2005, 0xb1, "Philips MR Imaging DD 001"}, 'f', 1},
    {"gradient", {0x2005, 0xb2, "Philips MR Imaging DD 001"}, 'f', 1},
    {"b-value", {0x0065, 0x09, "Image Private Header"}, 'd', 1},
    {"gradient", {0x0065, 0x37, "Image Private Header"}, 'd', 3},
}};

/// The numbers of a private attribute; of text, those between backslashes.
std::vector<double> numbers_in(std::string bytes, char form) {
    std::vector<double> numbers;
    const std::size_t size = form == 'f' ? sizeof(float) : sizeof(double);
    for (std::size_t at = 0; form != 't' && at + size <= bytes.size(); at += size) {
        float single = 0;
        double number = 0;
        std::memcpy(form == 'f' ? static_cast<void*>(&single) : &number, &bytes[at], size);
        numbers.push_back(form == 'f' ? static_cast<double>(single) : number);
    }
    std::ranges::replace(bytes, '\\', ' ');
    if (form == 't')
        for (const std::string& word : words_of(bytes))
            numbers.push_back(std::strtod(word.c_str(), nullptr));
    return numbers;
}

std::string private_kind(const DicomTags& root, const KindSource& source) {
    std::vector<double> all;
    for (const PrivateKind& kind : kPrivateKinds)
        if (kind.name == source.name)
            if (auto numbers = numbers_in(root.bytes(kind.tag), kind.form);
                numbers.size() >= kind.count)
                for (std::size_t i = 0; i < kind.count; ++i)
                    all.push_back(kind.beside > 0 ? std::fmod(numbers[i], kind.beside)
                                                  : numbers[i]);
    return all.empty() ? "" : fmt::format("{:g}{}", fmt::join(all, " "), source.unit);
}

glm::dvec3 vec3_at(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Directions, spacing and, where it is said of the image itself, position.
void place(const DicomTags& root, const FrameTags& tags, DicomFile& file, const std::string& name,
           DicomImage& image) {
    struct Source {
        Tag group, tag;
        bool of_patient;
    };
    const auto find = [&](std::size_t count, std::initializer_list<Source> sources,
                          double& rounding) {
        for (const Source& source : sources)
            if (auto found = tags.numbers(source.group, source.tag); found.size() == count) {
                if (source.of_patient) // as text
                    rounding = tags.rounding(source.group, source.tag);
                file.of_patient = source.of_patient;
                return found;
            }
        return std::vector<double>();
    };
    const auto along = find(6,
                            {{{0x0020, 0x9116}, {0x0020, 0x0037}, true},
                             {kDetector, {0x0020, 0x0037}, true},
                             {{0x0020, 0x930f}, {0x0020, 0x9302}, false}},
                            image.turn_rounding);
    if (along.size() == 6) {
        image.along = {vec3_at(along, 0), vec3_at(along, 3)};
        const double off = std::abs(glm::dot(image.along[0], image.along[1]));
        for (glm::dvec3& axis : image.along)
            if (!(std::abs(glm::length(axis) - 1) < 1e-2) || !(off < 1e-2))
                throw Error("{}: its rows and columns have directions of other lengths than 1, or "
                            "are not at right angles",
                            name);
        image.along[0] = glm::normalize(image.along[0]);
        image.along[1] = glm::normalize(image.along[1] -
                                        image.along[0] * glm::dot(image.along[0], image.along[1]));
    }
    const auto position = find(3,
                               {{{0x0020, 0x9113}, {0x0020, 0x0032}, true},
                                {kDetector, {0x0020, 0x0032}, true},
                                {{0x0020, 0x930e}, {0x0020, 0x9301}, false}},
                               image.rounding);
    if (position.size() == 3)
        image.position = vec3_at(position, 0);
    for (const Tag& tag : {Tag(0x0028, 0x0030), Tag(0x0018, 0x1164)})
        if (const auto spacing = tags.numbers(kMeasures, tag); spacing.size() == 2) {
            image.spacing = glm::dvec2(spacing[1], spacing[0]);
            break;
        }
    if (const Tag location(0x0020, 0x1041); file.frames == 1 && !image.position) {
        image.level = root.number(location);
        image.rounding = root.rounding(location);
    }
    if (const auto number = tags.number(kContent, {0x0020, 0x9057})) // InStackPositionNumber
        image.level = *number * (file.slice_spacing != 0 ? std::abs(file.slice_spacing) : 1);
}

/// Moves a frame of an older file from the place of the first to its own.
void place_frame(const FrameCounts& counts, const DicomFile& file, DicomImage& image) {
    const double level = counts.levels[image.frame] - counts.first;
    if (!image.position) {
        image.level = std::abs(level); // which side is the first nobody says
        return;
    }
    // The corner of the first tile lies as far from the middle of the mosaic as if it were alone.
    const glm::dvec2 others(file.tiles_across - 1.0, file.tiles_down - 1.0);
    const glm::dvec2 beside =
        image.spacing.value_or(glm::dvec2(1)) * glm::dvec2(file.columns, file.rows) * others / 2.0;
    *image.position += image.along[0] * beside.x + image.along[1] * beside.y +
                       glm::cross(image.along[0], image.along[1]) * level;
}

/// What an enhanced file counts beside places, times and volumes.
class OtherDimensions {
  public:
    OtherDimensions(const DicomTags& root, DicomFile& file) {
        const Tag kIndices(0x0020, 0x9222);
        if (root.items(kIndices) == 0)
            return;
        std::set<Tag> known{{0x0020, 0x9057}, {0x0020, 0x0032}, {0x0020, 0x9301}, {0x0020, 0x0037},
                            {0x0020, 0x9302}, {0x0020, 0x1041}, {0x0020, 0x930d}};
        for (const Tag& tag : tags_of_clocks())
            known.insert(tag);
        for (const KindSource& source : kKindSources)
            if (source.tag != kGradient) // which may be counted without being said
                known.insert({source.tag, source.root});
        for (std::size_t i = 0; i < root.items(kIndices); ++i) {
            const auto pointer = root.within(kIndices, i).numbers({0x0020, 0x9165});
            const Tag tag = pointer.size() == 2 ? Tag(static_cast<std::uint16_t>(pointer[0]),
                                                      static_cast<std::uint16_t>(pointer[1]))
                                                : kNoTag;
            if (known.contains(tag))
                continue;
            places_.push_back(i);
            file.dimensions_by += (places_.size() > 1 ? ", " : "") + keyword_of(tag);
        }
    }

    std::optional<double> value(const FrameTags& tags) const {
        const auto indices = tags.numbers(kContent, {0x0020, 0x9157});
        double value = 0;
        for (const std::size_t place : places_) {
            if (place >= indices.size())
                return std::nullopt;
            value = value * 65536 + indices[place];
        }
        return places_.empty() ? std::nullopt : std::optional(value);
    }

  private:
    std::vector<std::size_t> places_; ///< where their indices are among those of a frame
};

void tell_apart(const DicomTags& root, const FrameTags& tags, const DicomFile& file,
                const std::map<std::string, std::vector<double>>& volumes, DicomImage& image) {
    const auto add = [&](const std::string& what, const std::string& value) {
        image.kind.emplace_back(what, value);
    };
    add("series", fmt::format("{} {}", root.text({0x0020, 0x0011}), file.description));
    add("series UID", root.text({0x0020, 0x000e}));
    add("size", fmt::format("{} x {}", file.columns, file.rows));
    add("type", fmt::format("{}", name_of(file.type)));
    for (const KindSource& source : kKindSources) {
        std::string value;
        for (const Tag& tag : {source.tag, source.root})
            if (!value.empty())
                continue;
            else if (!source.unit)
                value = tags.text(source.group, tag);
            else if (const auto numbers = tags.numbers(source.group, tag); !numbers.empty())
                value = fmt::format("{:g}{}", fmt::join(numbers, " "), source.unit);
        if (value.empty())
            value = private_kind(root, source);
        add(source.name, value);
    }
    for (const std::string& what : counted_volumes()) {
        const auto counted = volumes.find(what);
        add(what,
            counted == volumes.end() ? "" : fmt::format("{:g}", counted->second[image.frame]));
    }
}

} // namespace

std::vector<DicomImage> images_of(const DicomTags& root, DicomFile& file, std::size_t number,
                                  const std::string& name) {
    const Tag groups = file.tiles_across > 1 ? kTileGroups : kFrameGroups;
    const bool grouped = !root.within(groups, 0).empty();
    if (grouped && root.items(groups) != file.frames)
        throw Error("{}: {} frames are described, expected {}", name, root.items(groups),
                    file.frames);
    const double columns = root.number({0x0048, 0x0006}).value_or(0); // TotalPixelMatrixColumns
    if (columns > file.columns && file.frames > 1)
        throw Error("{}: {} tiles of one picture, expected slices of a volume", name, file.frames);
    const bool counted = !grouped && file.frames > 1;
    const FrameCounts counts = counted ? count_frames(root, file, name) : FrameCounts{};
    const OtherDimensions dimensions(root, file);
    std::vector<DicomImage> images;
    for (std::uint32_t frame = 0; frame < file.frames; ++frame) {
        DicomImage image;
        image.file = number;
        image.frame = frame;
        const FrameTags tags(root, groups, frame);
        place(root, tags, file, name, image);
        read_clocks(tags, image);
        image.clock(DicomClock::instance) = frame + root.number({0x0020, 0x0013}).value_or(0);
        image.clock(DicomClock::dimension) = dimensions.value(tags);
        image.duration = tags.number(kNoTag, {0x0018, 0x1242}).value_or(0);
        tell_apart(root, tags, file, counts.volumes, image);
        if (counted) {
            place_frame(counts, file, image);
            if (!counts.times.empty())
                image.clock(counts.timed ? DicomClock::frame_time : DicomClock::frame_count) =
                    counts.times[frame];
        }
        const double dose = root.number({0x3004, 0x000e}).value_or(1);
        image.scaling = {tags.number(kTransformation, {0x0028, 0x1053}).value_or(1) * dose,
                         tags.number(kTransformation, {0x0028, 0x1052}).value_or(0)};
        if (!std::isfinite(image.scaling.slope) || image.scaling.slope == 0 ||
            !std::isfinite(image.scaling.intercept))
            throw Error("{}: RescaleSlope {} and RescaleIntercept {}, expected finite ones, the "
                        "slope not 0",
                        name, image.scaling.slope, image.scaling.intercept);
        images.push_back(std::move(image));
    }
    return images;
}

} // namespace isochron::index
