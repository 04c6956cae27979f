// Program statistics, notes and failures in the panel.
#include "app/panel/panel_statistics.h"

#include "app/config/first_placement.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace isochron::app {

std::string words_for_cells(const FrameReport& frame) {
    if (frame.coarsest == 0)
        return fmt::format("{} cells", frame.cells);
    const std::string drawn =
        fmt::format("{} drawn, of levels {} to {}", frame.cells, frame.finest, frame.coarsest);
    return frame.volume_cells ? fmt::format("{} cells ({})", *frame.volume_cells, drawn)
                              : fmt::format("cells not counted yet ({})", drawn);
}

void measurements(const PanelModel& model) {
    const FrameReport& frame = model.frame;
    text(words_for_cells(frame));
    ImGui::SameLine();
    note(model.work.searching
             ? "searching ..."
             : fmt::format("of {} candidates, {} reused", frame.candidates, frame.reused),
         color_of(Ink::dim));
    const glm::dvec3 size = physical_size(model.info.grid);
    note(fmt::format("volume {}   shown at {:.3g} m",
                     lengths_text({size.x, size.y, size.z}, model.info.length_unit),
                     std::max({size.x, size.y, size.z}) * model.asked.room_from_physical.scale),
         color_of(Ink::dim));
    note(fmt::format("search {:.2f} ms   blocks {:.2f} ms", frame.search.count(),
                     frame.gather.count()),
         color_of(Ink::dim));
    const index::ReadUse& use = model.work.reading;
    note(fmt::format("read {}   cache {} of {}   {} of {} steps were in memory",
                     human_bytes(static_cast<double>(use.bytes)),
                     human_bytes(static_cast<double>(use.held)),
                     human_bytes(static_cast<double>(use.budget)), use.hits, use.hits + use.misses),
         color_of(Ink::dim));
    note(fmt::format("{:.0f} frames/s   median {:.1f} ms   99 % {:.1f} ms",
                     model.work.frames.per_second, model.work.frames.times.median,
                     model.work.frames.times.p99),
         color_of(Ink::dim));
    for (const DeviceTracking& device : frame.tracking)
        note(in_words(device),
             color_of(device.tracking == interaction::Tracking::tracked ? Ink::dim : Ink::warning));
}

void complaints(const PanelModel& model) {
    if (!model.notes.failure.empty())
        note(model.notes.failure, color_of(Ink::error));
}

} // namespace isochron::app
