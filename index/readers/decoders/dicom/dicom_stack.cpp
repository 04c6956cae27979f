// Slices by position, steps by time.
#include "index/readers/decoders/dicom/dicom_stack.h"

#include "index/error.h"
#include "index/readers/formats/axis_positions.h"
#include "index/readers/formats/stored_file.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace isochron::index {
namespace {

using Slice = std::vector<DicomImage>; ///< images at one place

/// [mm] along the normal of the images.
double height_of(const DicomImage& image) {
    return glm::dot(*image.position, glm::cross(image.along[0], image.along[1]));
}

std::optional<double> clock_of(const DicomImage& image, DicomClock clock) {
    return image.clocks[static_cast<std::size_t>(clock)];
}

/// Images at the same height, from the lowest on; without positions, each apart, as they are
/// numbered.
std::vector<Slice> slices_of(std::vector<DicomImage> images) {
    std::vector<Slice> slices;
    if (!std::ranges::all_of(images,
                             [](const auto& image) { return image.position.has_value(); })) {
        std::ranges::stable_sort(images, {}, [](const DicomImage& image) {
            return clock_of(image, DicomClock::instance).value_or(0);
        });
        for (DicomImage& image : images)
            slices.push_back({std::move(image)});
        return slices;
    }
    std::ranges::stable_sort(images, {}, height_of);
    constexpr double kSame = 0.01; // share of the distance between pixels
    for (DicomImage& image : images) {
        const double slack = kSame * image.spacing.value_or(glm::dvec2(1)).x;
        if (slices.empty() || height_of(image) - height_of(slices.back().front()) > slack)
            slices.emplace_back();
        slices.back().push_back(std::move(image));
    }
    return slices;
}

void expect_upright(const std::vector<Slice>& slices, const std::vector<std::string>& names) {
    const DicomImage& first = slices.front().front();
    const glm::dvec3 normal = glm::cross(first.along[0], first.along[1]);
    const double pixel = first.spacing.value_or(glm::dvec2(1)).x;
    for (const Slice& slice : slices)
        for (const DicomImage& image : slice) {
            const glm::dvec3 way = *image.position - *first.position;
            const double up = glm::dot(way, normal), aside = glm::length(way - up * normal);
            constexpr double kSlack = 0.02, kShare = 1e-3;
            if (aside <= kSlack * pixel + kShare * std::abs(up))
                continue;
            throw Error(fmt::format("{}: lies {:.4g} mm beside the slice of {}: slices of a gantry "
                                    "tilted by {:.3g} degrees, expected them straight behind each "
                                    "other",
                                    names[image.file], aside, names[first.file],
                                    std::atan2(aside, std::abs(up)) * 180 / std::numbers::pi));
        }
}

/// Distances from the first slice. @throws Error where one is missing
void place_slices(const std::vector<Slice>& slices, const std::vector<std::string>& names,
                  DicomStack& stack) {
    std::vector<double> at;
    for (const Slice& slice : slices)
        at.push_back(height_of(slice.front()));
    if (at.size() < 2)
        return;
    stack.grid.spacing.z = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
    double least = at[1] - at[0], most = least;
    for (std::size_t i = 1; i < at.size(); ++i) {
        least = std::min(least, at[i] - at[i - 1]);
        most = std::max(most, at[i] - at[i - 1]);
    }
    constexpr double kEven = 0.01, kMultiple = 0.02;
    if (most - least <= kEven * least)
        return;
    const bool multiples = std::ranges::all_of(slices, [&](const Slice& slice) {
        const double share = (height_of(slice.front()) - at.front()) / least;
        return std::abs(share - std::round(share)) < kMultiple;
    });
    for (std::size_t i = 1; multiples && i < at.size(); ++i)
        if (at[i] - at[i - 1] > 1.5 * least)
            throw Error(fmt::format("{}: {:.4g} mm behind {}, others {:.4g} mm: slices are missing",
                                    names[slices[i].front().file], at[i] - at[i - 1],
                                    names[slices[i - 1].front().file], least));
    set_positions(stack.grid, 2, at);
    stack.notes.push_back(
        fmt::format("slices are {:.4g} to {:.4g} mm apart: kept as positions", least, most));
}

/// Whether it gives every image at a place another value.
bool tells_apart(const std::vector<Slice>& slices, DicomClock clock) {
    return std::ranges::all_of(slices, [&](const Slice& slice) {
        std::set<double> values;
        return std::ranges::all_of(slice, [&](const DicomImage& image) {
            const auto value = clock_of(image, clock);
            return value && values.insert(*value).second;
        });
    });
}

/// Means over all slices, and what they are counted in.
void give_dicom_times(const std::vector<Slice>& slices, DicomClock clock, double resolution,
                      DicomStack& stack) {
    double factor = 1;
    switch (clock) {
    case DicomClock::time_offset:
    case DicomClock::acquisition_time:
    case DicomClock::content_time: stack.time_unit = "s"; break;
    case DicomClock::trigger_time: stack.time_unit = "ms"; break;
    case DicomClock::temporal_position:
        if (resolution > 0)
            stack.time_unit = "ms";
        factor = resolution > 0 ? resolution : 1;
        break;
    case DicomClock::acquisition:
    case DicomClock::instance:
        stack.notes.push_back("images at the same place are told apart by their numbers alone: "
                              "taken for steps in time");
        return;
    }
    const bool of_day = clock == DicomClock::acquisition_time || clock == DicomClock::content_time;
    for (std::size_t step = 0; step < slices.front().size(); ++step) {
        double sum = 0;
        for (const Slice& slice : slices)
            sum += *clock_of(slice[step], clock);
        stack.times.push_back(sum / static_cast<double>(slices.size()) * factor);
    }
    const double first = of_day ? stack.times.front() : 0;
    for (double& time : stack.times)
        time -= first;
}

void sort_times(std::vector<Slice>& slices, const DicomFile& file,
                const std::vector<std::string>& names, DicomStack& stack) {
    const std::size_t steps = slices.front().size();
    for (const Slice& slice : slices)
        if (slice.size() != steps)
            throw Error(fmt::format("{}: {} images at its place, {} has {} at its own",
                                    names[slice.front().file], slice.size(),
                                    names[slices.front().front().file], steps));
    if (steps == 1)
        return;
    for (std::size_t i = 0; i < kDicomClocks; ++i) {
        const auto clock = static_cast<DicomClock>(i);
        if (!tells_apart(slices, clock))
            continue;
        for (Slice& slice : slices)
            std::ranges::sort(slice, {},
                              [&](const DicomImage& image) { return *clock_of(image, clock); });
        return give_dicom_times(slices, clock, file.temporal_resolution, stack);
    }
    const Slice& slice = slices.front();
    throw Error(fmt::format("{}, {}: images of the same place that neither time nor number tells "
                            "apart",
                            names[slice[0].file], names[slice[1].file]));
}

} // namespace

std::vector<DicomVolume> dicom_volumes(const std::vector<DicomFile>& files) {
    using Kind = std::vector<std::pair<std::string, std::string>>;
    std::map<Kind, std::vector<DicomImage>> found;
    std::string modality = "image";
    for (const DicomFile& file : files)
        for (const DicomImage& image : file.images) {
            found[image.kind].push_back(image);
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
                       const std::vector<std::string>& names) {
    DicomStack stack;
    std::vector<Slice> slices = slices_of(images);
    const DicomImage& image = slices.front().front();
    stack.in_space = image.position.has_value();
    if (stack.in_space)
        expect_upright(slices, names);
    sort_times(slices, first, names, stack);
    if (slices.size() == 1 && slices.front().size() > 1) {
        // A volume of it shows more than nothing.
        stack.notes.push_back("frames of one slice each: they are taken for slices");
        stack.times.clear();
        stack.time_unit.clear();
        Slice frames = std::move(slices.front());
        slices.clear();
        for (DicomImage& frame : frames)
            slices.push_back({std::move(frame)});
        stack.in_space = false;
    }
    const DicomImage& lowest = slices.front().front();
    stack.grid.vertices = checked_vertices(
        {first.columns, first.rows, static_cast<std::int64_t>(slices.size())}, names[lowest.file]);
    const glm::dvec2 spacing = lowest.spacing.value_or(glm::dvec2(1));
    stack.grid.spacing = {spacing, first.slice_spacing != 0 ? std::abs(first.slice_spacing) : 1.0};
    if (stack.in_space)
        place_slices(slices, names, stack);
    else
        stack.notes.push_back(
            "positions of its slices are not said: in the order of their numbers");
    if (!lowest.spacing)
        stack.notes.push_back("the distance between its pixels is not said: 1 mm");
    const glm::dvec3 scale = stack.grid.spacing;
    set_axes(stack.grid,
             {lowest.along[0] * scale.x, lowest.along[1] * scale.y,
              glm::cross(lowest.along[0], lowest.along[1]) * scale.z},
             names[lowest.file]);
    stack.grid.origin = lowest.position.value_or(glm::dvec3(0));
    stack.steps.resize(slices.front().size());
    for (Slice& slice : slices)
        for (std::size_t step = 0; step < slice.size(); ++step)
            stack.steps[step].push_back(std::move(slice[step]));
    return stack;
}

} // namespace isochron::index
