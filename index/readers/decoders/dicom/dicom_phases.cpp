// Finds phases in attributes and descriptions of series.
#include "index/readers/decoders/dicom/dicom_phases.h"

#include "index/lower_case.h"
#include "index/readers/decoders/dicom/dicom_clocks.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <utility>

namespace isochron::index {
namespace {

/// What one series says of its phase.
struct Phase {
    DicomClock clock = DicomClock::described_phase;
    double number = 0;
    std::string rest = {}; ///< rest of the description, which phases of one scan share
    const DicomVolume* volume = nullptr;
};

std::optional<Phase> phase_of(const DicomVolume& volume, const std::vector<DicomFile>& files,
                              const std::vector<std::string>& names) {
    const DicomImage& first = volume.images.front();
    const DicomFile& file = files[first.file];
    Phase phase{.rest = file.description, .volume = &volume};
    // `Gated, 20.0%`, `T=20%`, `20% Ex`, `phase_3`, `Ph3/Dynamic`
    static const std::regex kPercent(R"((\d+(?:\.\d+)?) ?%(?: ?\b(?:in|ex)\w*)?)"),
        kCounted(R"((?:^|[^a-z])ph(?:ase)?[ _=#:-]?(\d+(?:\.\d+)?))");
    for (const std::string& words :
         {file.description, file.comments,
          std::filesystem::path(names[first.file]).parent_path().filename().string()}) {
        constexpr std::size_t kLongest = 256;
        const std::string said = lower_case(words.substr(0, kLongest));
        std::smatch found;
        const bool percent = std::regex_search(said, found, kPercent);
        if (!percent && !std::regex_search(said, found, kCounted))
            continue;
        phase.number = std::stod(found[1]);
        // What the description says beside its phase, or all of it.
        const std::string rest = std::string(found.prefix()) + std::string(found.suffix());
        phase.rest = words == file.description ? rest : file.description + rest;
        phase.clock = percent ? DicomClock::described_phase : DicomClock::described_number;
        return phase;
    }
    for (const DicomClock clock : {DicomClock::cardiac_phase, DicomClock::respiratory_phase,
                                   DicomClock::temporal_position}) {
        const auto& value = first.clock(clock);
        if (!value || (clock == DicomClock::temporal_position && file.temporal_positions < 2) ||
            !std::ranges::all_of(volume.images, [&](const DicomImage& image) {
                return image.clock(clock) == value;
            }))
            continue;
        phase.clock = clock;
        phase.number = *value;
        return phase;
    }
    return std::nullopt;
}

/// Whether both have an image at each place of the other.
bool at_same_places(const DicomVolume& one, const DicomVolume& other) {
    const auto places = [](const DicomVolume& volume) {
        std::vector<double> heights;
        for (const DicomImage& image : volume.images)
            heights.push_back(image.position ? glm::dot(*image.position,
                                                        glm::cross(image.along[0], image.along[1]))
                                             : image.level.value_or(0));
        std::ranges::sort(heights);
        return heights;
    };
    constexpr double kSame = 0.01; // [mm]
    return std::ranges::equal(places(one), places(other),
                              [](double a, double b) { return std::abs(a - b) <= kSame; });
}

/// All that tells volumes apart besides their series.
auto kind_of(const DicomVolume& volume) {
    auto kind = volume.images.front().kind;
    kind.erase(kind.begin(), kind.begin() + 2);
    return kind;
}

} // namespace

std::size_t join_phases(std::vector<DicomVolume>& volumes, const std::vector<DicomFile>& files,
                        const std::vector<std::string>& names) {
    std::map<std::pair<DicomClock, std::string>, std::vector<Phase>> scans;
    for (const DicomVolume& volume : volumes)
        if (auto phase = phase_of(volume, files, names)) {
            const std::pair scan(phase->clock, phase->rest);
            scans[scan].push_back(std::move(*phase));
        }
    const auto is_scan = [](const auto& scan) {
        const std::vector<Phase>& phases = scan.second;
        return phases.size() > 1 && std::ranges::all_of(phases, [&](const Phase& phase) {
                   return std::ranges::count(phases, phase.number, &Phase::number) == 1 &&
                          kind_of(*phase.volume) == kind_of(*phases.front().volume) &&
                          at_same_places(*phase.volume, *phases.front().volume);
               });
    };
    const auto scan = std::ranges::find_if(scans, is_scan);
    if (scan == scans.end() || std::ranges::count_if(scans, is_scan) > 1)
        return 0;
    std::vector<Phase>& phases = scan->second;
    std::ranges::sort(phases, {}, &Phase::number);
    DicomVolume joined{
        .name = fmt::format("{} by phase", files[volumes.front().images.front().file].modality),
        .images = {}};
    for (const Phase& phase : phases)
        for (DicomImage image : phase.volume->images) {
            // What a phase says of times is of the scan in which all of them were made.
            if (!unit_of(phase.clock).empty())
                image.clocks = {};
            image.clock(phase.clock) = phase.number;
            joined.images.push_back(std::move(image));
        }
    const std::size_t count = phases.size();
    volumes.insert(volumes.begin(), std::move(joined)); // ends the phases' places
    return count;
}

} // namespace isochron::index
