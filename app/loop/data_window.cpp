// A window for choosing data, or for the progress of indexing them.
#include "app/loop/data_window.h"

#include "app/config/series_names.h"

#include <algorithm>
#include <utility>

namespace isochron::app {

namespace fs = std::filesystem;

std::optional<fs::path> choose_data(const stereo::Windows& windows,
                                    const DataWindowOptions& options) {
    PageWindow window(windows, options.window);
    PanelLayer& layer = window.layer();
    layer.pages().offer_files([&options] { return options.recent; });
    layer.pages().offer_beside_files(options.offers);
    layer.pages().open_files();
    std::string complaint;
    while (layer.pages().any() && window.goes_on()) {
        window.frame([&](glm::ivec2 size, interaction::Seconds time) {
            layer.lay_out_files(size, complaint, time);
        });
        std::optional<fs::path> wanted = layer.pages().take_chosen();
        const std::vector<fs::path> dropped = window.take_dropped();
        if (!dropped.empty()) {
            wanted = one_name_of(dropped);
            complaint = wanted ? std::string() : kNoCommonName;
        }
        if (!wanted)
            continue;
        complaint = options.why_not_open(*wanted);
        if (complaint.empty())
            return wanted;
        layer.pages().open_files_again();
    }
    return std::nullopt;
}

Waited wait_for_data(const stereo::Windows& windows, const std::string& name,
                     const std::function<DataProgress()>& progress, PageWindowOptions options,
                     const ArrayChoice& choice) {
    Waited end = Waited::ready;
    {
        PageWindow window(windows, std::move(options));
        std::optional<std::size_t> first; ///< array
        for (DataProgress now = progress(); !now.ready && end == Waited::ready; now = progress()) {
            if (!now.arrays.empty() && !first)
                first = choice.first();
            std::optional<std::size_t> chosen;
            const auto events = window.frame([&](glm::ivec2 size, interaction::Seconds time) {
                if (now.arrays.empty())
                    window.layer().lay_out_progress(size, name, now.line, now.fraction, time);
                else
                    chosen = window.layer().lay_out_arrays(size, name, now.arrays, *first, time);
            });
            if (chosen)
                choice.choose(*chosen);
            const bool escapes = interaction::is_pressed(interaction::Key::escape, events);
            end = !window.goes_on() ? Waited::left : escapes ? Waited::canceled : Waited::ready;
        }
    }
    windows.drawing().make_current();
    return end;
}

} // namespace isochron::app
