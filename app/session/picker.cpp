// Presses of the picking buttons, and what they find.
#include "app/session/picker.h"

#include "index/extraction/cell_ray.h"
#include "index/volume/sample.h"
#include "interaction/device_reading.h"

#include <glm/matrix.hpp>

#include <utility>

namespace isochron::app {
namespace {

using namespace interaction;

const HapticPulse kFound{"wand", 0.04, 0.8f};

glm::dvec3 in_data(const ExplorerState& state, const glm::dvec4& in_room) {
    return glm::dvec3(glm::inverse(matrix(state.room_from_physical)) * in_room);
}

std::uint32_t visible(const ExplorerState& state) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < state.isosurfaces.size(); ++i)
        bits |= std::uint32_t{state.isosurfaces[i].opacity > 0} << i;
    return bits;
}

} // namespace

Picker::Picker(std::shared_ptr<const index::IndexFile> file) : file_(std::move(file)) {}

Mark Picker::picked(const Pose& wand, const ExplorerState& state,
                    const index::Extraction& shown) const {
    const glm::dvec3 ahead(wand.orientation * glm::vec3(0.0f, 0.0f, -1.0f));
    const index::Ray ray{in_data(state, glm::dvec4(wand.position, 1.0)),
                         in_data(state, glm::dvec4(ahead, 0.0))};
    const auto hit = index::first_hit(shown, file_->info().grid, ray, visible(state));
    if (!hit)
        return {};
    return {MarkedPoint{hit->at, shown.query.step, shown.query.isovalues[hit->surface]}};
}

void Picker::read_at(const Pose& wand, const ExplorerState& state) {
    const glm::dvec3 at = in_data(state, glm::dvec4(wand.position, 1.0));
    reading_.post([file = file_, slot = read_, at, step = state.step] {
        const index::LoadedStep loaded = file->load(step);
        const auto value = index::value_at(loaded.values, step, at);
        const std::lock_guard lock(slot->mutex);
        slot->mark = value ? Mark{MarkedPoint{at, step, *value}} : Mark{};
        return std::string();
    });
}

Commands Picker::update(const InputState& input, bool aims, const ExplorerState& state,
                        const index::ExtractionPtr& shown) {
    const Reading now(input);
    const bool picks = now.key(Action::pick) || now.wand_button(WandButton::pick);
    const bool probes = now.key(Action::probe) || now.wand_button(WandButton::probe);
    const bool picked_before = std::exchange(picked_before_, picks);
    const bool probed_before = std::exchange(probed_before_, probes);
    const auto wand = Reading::hand(now.wand);
    Commands commands;
    if (probes && !probed_before && wand)
        read_at(*wand, state);
    if (picks && !picked_before && wand && aims && shown)
        commands.mark = picked(*wand, state, *shown);
    {
        const std::lock_guard lock(read_->mutex); // held by the reader for one assignment
        if (const auto read = std::exchange(read_->mark, std::nullopt))
            commands.mark = *read;
    }
    if (commands.mark && commands.mark->point)
        commands.haptics.push_back(kFound);
    return commands;
}

} // namespace isochron::app
