// Counts frames by their vectors.
//
// https://dicom.nema.org/medical/dicom/current/output/chtml/part03/sect_C.8.4.8.html (nuclear
// medicine), sect_C.7.6.5.html (films).
#include "index/readers/decoders/dicom/dicom_vectors.h"

#include "index/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

using gdcm::Tag;

const Tag kSpacingBetweenSlices(0x0018, 0x0088), kFrameTime(0x0018, 0x1063),
    kFrameTimeVector(0x0018, 0x1065), kFrameOffsets(0x3004, 0x000c);

/// A number for each frame of an older file.
struct FrameVector {
    enum { volumes, time, slices, views } counts;
    const char* name;
    Tag tag;
};
const std::array<FrameVector, 12> kFrameVectors{{
    {FrameVector::volumes, "energy window", {0x0054, 0x0010}},
    {FrameVector::volumes, "detector", {0x0054, 0x0020}},
    {FrameVector::volumes, "rotation", {0x0054, 0x0050}},
    {FrameVector::volumes, "RR interval", {0x0054, 0x0060}},
    {FrameVector::time, "PhaseVector", {0x0054, 0x0030}},
    {FrameVector::time, "TimeSlotVector", {0x0054, 0x0070}},
    {FrameVector::time, "TimeSliceVector", {0x0054, 0x0100}},
    {FrameVector::slices, "SliceVector", {0x0054, 0x0080}},
    {FrameVector::slices, "GridFrameOffsetVector", kFrameOffsets},
    {FrameVector::slices, "SliceLocationVector", {0x0018, 0x2005}},
    {FrameVector::views, "AngularViewVector", {0x0054, 0x0090}},
    {FrameVector::views, "FramePrimaryAngleVector", {0x0018, 0x2003}},
}};

/// [ms] when each frame of a dynamic study begins; empty: not said.
/// @param phases, slices of the frames, counted from 1
std::vector<double> starts_in_phases(const DicomTags& root, const std::vector<double>& phases,
                                     const std::vector<double>& slices) {
    const Tag kPhases(0x0054, 0x0032);
    std::vector<double> starts, durations, times;
    double start = 0;
    for (std::size_t i = 0; i < root.items(kPhases); ++i) {
        const DicomTags phase = root.within(kPhases, i);
        durations.push_back(phase.number(Tag(0x0018, 0x1242)).value_or(0));
        start += phase.number({0x0054, 0x0036}).value_or(0);
        starts.push_back(start);
        start += durations.back() * phase.number({0x0054, 0x0033}).value_or(1);
    }
    std::map<double, double> first; // a phase may go on counting
    for (std::size_t i = 0; i < slices.size(); ++i) {
        const double phase = phases.empty() ? 1 : phases[i];
        first[phase] = std::min(first.try_emplace(phase, slices[i]).first->second, slices[i]);
    }
    for (std::size_t i = 0; i < slices.size(); ++i) {
        const double phase = phases.empty() ? 1 : phases[i];
        if (!(phase >= 1) || phase > static_cast<double>(starts.size()))
            return {};
        const auto at = static_cast<std::size_t>(phase - 1);
        if (!(durations[at] > 0))
            return {};
        times.push_back(starts[at] + (slices[i] - first[phase]) * durations[at]);
    }
    return times;
}

/// [ms] between the slots of a heartbeat; 0: not said.
double slot_time(const DicomTags& root) {
    const DicomTags gated = root.within({0x0054, 0x0062}, 0),
                    data = gated.within({0x0054, 0x0063}, 0);
    if (const auto time = data.number(kFrameTime))
        return *time;
    const auto interval = data.number({0x0018, 0x1062});
    const double slots = root.number({0x0054, 0x0071}).value_or(0);
    return interval && slots > 0 ? *interval / slots : 0;
}

/// Times of frames that come one after the other; none: they are slices.
void take_film(const DicomTags& root, DicomFile& file, FrameCounts& counts) {
    static const std::set<std::string_view> kFilms{"US", "XA", "RF", "ES", "XC", "GM", "OP"};
    const auto pointers = root.numbers({0x0028, 0x0009});
    bool pointed = pointers.empty() && kFilms.contains(file.modality);
    for (std::size_t i = 0; i + 1 < pointers.size(); i += 2)
        for (const Tag& tag : {kFrameTime, kFrameTimeVector})
            pointed =
                pointed || (pointers[i] == tag.GetGroup() && pointers[i + 1] == tag.GetElement());
    const bool spaced = root.number(kSpacingBetweenSlices).value_or(0) != 0;
    if (pointed && spaced)
        file.notes.push_back(
            "its frames are said to follow in time, and SpacingBetweenSlices: they "
            "are taken for slices");
    if (!pointed || spaced)
        return;
    const auto steps = root.numbers(kFrameTimeVector);
    const double rate = root.number({0x0018, 0x0040}).value_or(0);
    const double each = root.number(kFrameTime).value_or(rate > 0 ? 1000 / rate : 0);
    const bool uneven = steps.size() == file.frames;
    counts.timed = uneven || each > 0;
    file.frames_by = uneven     ? "FrameTimeVector"
                     : each > 0 ? "FrameTime"
                                : "the number of the frame";
    double time = 0;
    for (std::uint32_t frame = 0; frame < file.frames; ++frame) {
        if (frame > 0)
            time += uneven ? steps[frame] : counts.timed ? each : 1;
        counts.times.push_back(time);
    }
}

} // namespace

FrameCounts count_frames(const DicomTags& root, DicomFile& file, const std::string& name) {
    FrameCounts counts;
    std::map<std::string, std::vector<double>> times;
    std::vector<double> slices;
    bool in_mm = false;
    for (const FrameVector& vector : kFrameVectors) {
        const auto numbers = root.numbers(vector.tag);
        if (numbers.size() != file.frames ||
            std::ranges::all_of(numbers, [&](double each) { return each == numbers.front(); }))
            continue;
        if (vector.counts == FrameVector::views)
            throw Error("{}: {} frames of other directions of view ({}), expected slices that were "
                        "computed of them",
                        name, file.frames, vector.name);
        if (vector.counts == FrameVector::volumes)
            counts.volumes[vector.name] = numbers;
        if (vector.counts == FrameVector::time)
            times[vector.name] = numbers;
        if (vector.counts == FrameVector::slices && slices.empty()) {
            slices = numbers;
            in_mm = vector.tag != Tag(0x0054, 0x0080);
        }
    }
    // Without vectors, the numbers of slots and slices may say it: those of a slot are together.
    for (const auto& [number, vector] : {std::pair(Tag(0x0054, 0x0071), "TimeSlotVector"),
                                         {Tag(0x0054, 0x0101), "TimeSliceVector"}}) {
        const double slots = root.number(number).value_or(1);
        const double layers = root.number({0x0054, 0x0081}).value_or(0);
        if (times.empty() && slots > 1 && slots * layers == file.frames)
            for (std::uint32_t frame = 0; frame < file.frames; ++frame)
                times[vector].push_back(std::floor(frame / layers) + 1);
    }
    for (const auto& [vector, numbers] : times) { // PhaseVector is the first, if there is one
        file.frames_by += (file.frames_by.empty() ? "" : ", ") + vector;
        counts.times.resize(file.frames);
        for (std::uint32_t frame = 0; frame < file.frames; ++frame)
            counts.times[frame] = counts.times[frame] * 65536 + numbers[frame];
    }
    if (const auto slot = times.find("TimeSlotVector"); slot != times.end()) {
        const double each = slot_time(root);
        for (std::uint32_t frame = 0; each > 0 && frame < file.frames; ++frame)
            counts.times[frame] = (slot->second[frame] - 1) * each;
        counts.timed = each > 0;
    } else if (!times.empty()) {
        auto& of_phase = times["TimeSliceVector"];
        of_phase.resize(file.frames, 1);
        if (auto starts = starts_in_phases(root, times["PhaseVector"], of_phase); !starts.empty()) {
            counts.times = std::move(starts);
            counts.timed = true;
        }
    } else if (slices.empty() && counts.volumes.empty()) {
        take_film(root, file, counts);
    }
    // Frames that nothing else tells apart are slices, in their order.
    std::map<std::vector<double>, double> seen;
    const double step = in_mm ? 1 : file.slice_spacing != 0 ? file.slice_spacing : 1;
    for (std::uint32_t frame = 0; frame < file.frames; ++frame) {
        std::vector<double> rest{counts.times.empty() ? 0 : counts.times[frame]};
        for (const auto& [what, numbers] : counts.volumes)
            rest.push_back(numbers[frame]);
        const double slice = slices.empty() ? seen[rest]++ : slices[frame];
        counts.levels.push_back(slice * step);
    }
    const auto [lowest, highest] = std::ranges::minmax(counts.levels);
    counts.first = in_mm ? counts.levels.front() : step < 0 ? highest : lowest;
    return counts;
}

std::vector<std::string> counted_volumes() {
    std::vector<std::string> names;
    for (const FrameVector& vector : kFrameVectors)
        if (vector.counts == FrameVector::volumes)
            names.emplace_back(vector.name);
    return names;
}

} // namespace isochron::index
