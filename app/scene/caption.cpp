// Captions of pictures.
#include "app/scene/caption.h"

#include "app/scene/legend.h"
#include "app/text.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace isochron::app {

std::string steps_text(index::Instant at) {
    return at.between() ? fmt::format("between steps {} and {}", at.step + 1, at.step + 2)
                        : fmt::format("step {}", at.step + 1);
}

std::string caption_text(const index::SurfacesQuery& shown, const index::SeriesInfo& info) {
    std::vector<std::string> values;
    for (const double value : shown.isovalues)
        values.push_back(fmt::format("{:.6g}", value)); // as the panel has it
    std::string text = fmt::format("{}{}isovalue{} {}{}", info.array,
                                   info.array.empty() ? "" : ", ", values.size() == 1 ? "" : "s",
                                   fmt::join(values, ", "), with_space(info.value_unit));
    if (info.steps() > 1)
        text += fmt::format(", at {} ({} of {})",
                            index::instant_text(info.times, shown.instant, info.time_unit),
                            steps_text(shown.instant), info.steps());
    return text;
}

std::string step_number(index::Instant at) {
    const double number = 1 + static_cast<double>(at.number()) / index::Instant::kFractions;
    return at.between() ? fmt::format("{:.2f}", number) : fmt::format("{:.0f}", number);
}

std::vector<render::ScreenQuad> caption_quads(const std::string& words,
                                              const render::TextPass& text,
                                              const glm::ivec2& picture,
                                              const OverlayColors& overlay, float share) {
    std::vector<render::ScreenQuad> quads;
    const float height = text_height(picture, share);
    const float width = height * render::text_width(text.atlas(), words);
    const glm::vec3 middle(
        glm::floor(glm::vec2(height + 0.5f * width, static_cast<float>(picture.y) - 1.5f * height)),
        0.0f);
    text.set({.text = words, .at = middle, .color = overlay.text, .halo = overlay.halo()}, height,
             quads);
    return quads;
}

} // namespace isochron::app
