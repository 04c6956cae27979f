// Slices by position, steps by time.
#include "index/readers/decoders/dicom/dicom_stack.h"

#include "index/error.h"
#include "index/readers/decoders/dicom/dicom_times.h"
#include "index/readers/formats/axis_positions.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace isochron::index {
namespace {

/// [mm] along the normal of the images, or the number of the slice.
double height_of(const DicomImage& image) {
    return image.position ? glm::dot(*image.position, glm::cross(image.along[0], image.along[1]))
                          : *image.level;
}

double pixel_of(const DicomImage& image) {
    return image.spacing.value_or(glm::dvec2(1)).x;
}

/// [mm] by which each number of a position may be off, as scanners round them: half of the last
/// digit that any has. A part of a pixel at most.
double rounding_of(const std::vector<DicomImage>& images) {
    constexpr double kMost = 0.125;
    double least = 0;
    for (const DicomImage& image : images)
        if (image.rounding > 0 && (least == 0 || image.rounding < least))
            least = image.rounding;
    return std::min(least, kMost * pixel_of(images.front()));
}

/// Images at the same height, from the lowest on; without positions, each apart, as they are
/// numbered.
/// @param distance between slices whose places are not said
std::vector<DicomSlice> slices_of(std::vector<DicomImage> images, double distance) {
    std::vector<DicomSlice> slices;
    if (!std::ranges::all_of(images,
                             [](const auto& image) { return image.position.has_value(); })) {
        std::ranges::stable_sort(images, {}, [](const DicomImage& image) {
            return image.clock(DicomClock::instance).value_or(0);
        });
        const bool level = std::ranges::all_of(
            images, [](const DicomImage& image) { return image.level.has_value(); });
        for (std::size_t i = 0; i < images.size(); ++i) {
            images[i].position.reset();
            if (!level)
                images[i].level = static_cast<double>(i) * distance;
        }
    }
    std::ranges::stable_sort(images, {}, height_of);
    constexpr double kSame = 0.01; // share of the distance between pixels
    const double slack = kSame * pixel_of(images.front()) + rounding_of(images);
    for (DicomImage& image : images) {
        if (slices.empty() || height_of(image) - height_of(slices.back().front()) > slack)
            slices.emplace_back();
        slices.back().push_back(std::move(image));
    }
    return slices;
}

void expect_upright(const std::vector<DicomSlice>& slices, double rounding, const DicomFile& file,
                    const std::vector<std::string>& names) {
    const DicomImage& first = slices.front().front();
    const glm::dvec3 normal = glm::cross(first.along[0], first.along[1]);
    constexpr double kSlack = 0.02, kShare = 1e-3, kMostShare = 1e-2;
    const double share = std::clamp(2 * first.turn_rounding, kShare, kMostShare);
    const double still = kSlack * pixel_of(first) + 2 * std::numbers::sqrt3 * rounding;
    for (const DicomSlice& slice : slices)
        for (const DicomImage& image : slice) {
            const glm::dvec3 way = *image.position - *first.position;
            const double up = glm::dot(way, normal), aside = glm::length(way - up * normal);
            if (aside <= still + share * std::abs(up))
                continue;
            throw Error("{}: lies {:.4g} mm beside the slice of {}: slices {} {:.3g} degrees, "
                        "expected them straight behind each other",
                        names[image.file], aside, names[first.file],
                        file.modality == "CT" ? "of a gantry tilted by"
                                              : "that are shifted sideways, by",
                        std::atan2(aside, std::abs(up)) * 180 / std::numbers::pi);
        }
}

/// Distances from the first slice. @throws Error where one is missing
void place_slices(const std::vector<DicomSlice>& slices, double rounding,
                  const std::vector<std::string>& names, DicomStack& stack) {
    std::vector<double> at;
    for (const DicomSlice& slice : slices)
        at.push_back(height_of(slice.front()));
    if (at.size() < 2)
        return;
    stack.grid.spacing.z = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
    std::vector<double> gaps;
    for (std::size_t i = 1; i < at.size(); ++i)
        gaps.push_back(at[i] - at[i - 1]);
    const auto [least, most] = std::ranges::minmax(gaps);
    const DicomImage& first = slices.front().front();
    const glm::dvec3 normal = glm::abs(glm::cross(first.along[0], first.along[1]));
    const double off = 2 * rounding * (stack.in_space ? normal.x + normal.y + normal.z : 1);
    constexpr double kEven = 0.01, kMultiple = 0.02;
    bool even = true, multiples = true;
    for (std::size_t i = 1; i < at.size(); ++i) {
        even =
            even && std::abs(at[i] - at[0] - static_cast<double>(i) * stack.grid.spacing.z) <= off;
        const double times = std::round(gaps[i - 1] / least);
        multiples = multiples && std::abs(gaps[i - 1] - times * least) <
                                     kMultiple * least + std::min(off * times, least / 4);
    }
    if (even || most - least <= kEven * least)
        return;
    for (std::size_t i = 1; multiples && i < at.size(); ++i)
        if (gaps[i - 1] > 1.5 * least)
            throw Error("{}: {:.4g} mm behind {}, others {:.4g} mm: slices are missing",
                        names[slices[i].front().file], gaps[i - 1],
                        names[slices[i - 1].front().file], least);
    set_positions(stack.grid, 2, at);
    stack.notes.push_back(
        fmt::format("slices are {:.4g} to {:.4g} mm apart: kept as positions", least, most));
}

using Directions = std::array<glm::dvec3, 2>;

/// Those seen before that are as good as these, or these, which are seen then.
const Directions& directions_among(std::vector<Directions>& seen, const Directions& these) {
    constexpr double kSame = 0.01;
    const auto known = std::ranges::find_if(seen, [&](const Directions& other) {
        return glm::length(other[0] - these[0]) < kSame && glm::length(other[1] - these[1]) < kSame;
    });
    return known != seen.end() ? *known : seen.emplace_back(these);
}

std::string text_of(const Directions& directions) {
    std::string text;
    for (const glm::dvec3& axis : directions)
        text += fmt::format(" ({:.2f} {:.2f} {:.2f})", axis.x + 0.0, axis.y + 0.0, axis.z + 0.0);
    return text;
}

} // namespace

std::vector<DicomVolume> dicom_volumes(const std::vector<DicomFile>& files) {
    using Kind = std::vector<std::pair<std::string, std::string>>;
    std::map<Kind, std::vector<DicomImage>> found;
    std::vector<Directions> seen;
    std::string modality = "image";
    for (const DicomFile& file : files)
        for (const DicomImage& image : file.images) {
            Kind kind = image.kind;
            kind.emplace_back("directions", text_of(directions_among(seen, image.along)));
            found[std::move(kind)].push_back(image);
            if (!file.modality.empty())
                modality = file.modality;
        }
    std::vector<DicomVolume> volumes;
    if (found.empty())
        return volumes;
    const Kind& first = found.begin()->first;
    std::set<std::size_t> differing;
    for (const auto& [kind, images] : found)
        for (std::size_t i = 0; i < kind.size(); ++i)
            if (kind[i].second != first[i].second)
                differing.insert(i);
    if (differing.contains(0) && differing.contains(1))
        differing.erase(1); // the UID of a series says nothing that its number does not
    std::set<std::string> names;
    for (auto& [kind, images] : found) {
        std::string name = found.size() == 1 ? modality : "";
        for (const std::size_t i : differing)
            name += fmt::format("{}{}{}", name.empty() ? "" : ", ",
                                i == 0 ? "" : kind[i].first + " ", kind[i].second);
        name = trimmed(name).empty() ? "unnamed" : std::string(trimmed(name));
        std::string unique = name;
        for (int number = 2; !names.insert(unique).second; ++number)
            unique = fmt::format("{} ({})", name, number);
        volumes.push_back({std::move(unique), std::move(images)});
    }
    return volumes;
}

DicomStack dicom_stack(const std::vector<DicomImage>& images, const DicomFile& first,
                       const std::vector<std::string>& names, bool spaced) {
    DicomStack stack;
    const double rounding = rounding_of(images);
    const double distance = first.slice_spacing != 0 ? std::abs(first.slice_spacing) : 1;
    std::vector<DicomSlice> slices = slices_of(images, distance);
    stack.in_space = slices.front().front().position.has_value();
    if (stack.in_space)
        expect_upright(slices, rounding, first, names);
    DicomTimes found = sort_times(slices, first, names);
    const std::string by = found.notes.empty() ? "" : found.notes.back();
    stack.grid.spacing.z = distance;
    if (slices.size() == 1 && slices.front().size() > 1) {
        if (!spaced)
            throw Error("{}: a film, {} frames of one slice ({}), expected slices; --spacing X Y Z "
                        "takes the frames for slices, Z apart",
                        names[slices.front().front().file], slices.front().size(), by);
        found = {
            .notes = {fmt::format("frames of one slice each ({}): they are taken for slices", by)}};
        DicomSlice frames = std::move(slices.front());
        slices.clear();
        for (DicomImage& frame : frames)
            slices.push_back({std::move(frame)});
        stack.in_space = false;
    } else {
        place_slices(slices, rounding, names, stack);
    }
    stack.times = std::move(found.times);
    stack.time_unit = std::move(found.unit);
    stack.notes.insert(stack.notes.begin(), found.notes.begin(), found.notes.end());
    if (!stack.in_space)
        stack.notes.push_back(
            "positions of its slices are not said: in the order of their numbers");
    const DicomImage& lowest = slices.front().front();
    stack.grid.vertices = checked_vertices(
        {first.columns, first.rows, static_cast<std::int64_t>(slices.size())}, names[lowest.file]);
    if (!lowest.spacing)
        stack.notes.push_back("the distance between its pixels is not said: 1 mm");
    const glm::dvec3 scale(lowest.spacing.value_or(glm::dvec2(1)), stack.grid.spacing.z);
    set_axes(stack.grid,
             {lowest.along[0] * scale.x, lowest.along[1] * scale.y,
              glm::cross(lowest.along[0], lowest.along[1]) * scale.z},
             names[lowest.file]);
    stack.grid.origin = lowest.position.value_or(glm::dvec3(0));
    stack.steps.resize(slices.front().size());
    for (DicomSlice& slice : slices)
        for (std::size_t step = 0; step < slice.size(); ++step)
            stack.steps[step].push_back(std::move(slice[step]));
    return stack;
}

} // namespace isochron::index
