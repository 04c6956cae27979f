// Captions of pictures.
#include "app/scene/caption.h"

#include "app/frame/explorer_state.h"
#include "app/scene/legend.h"
#include "app/text.h"
#include "index/volume/instant_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace isochron::app {

std::string steps_text(index::Instant at) {
    return at.between() ? fmt::format("between steps {} and {}", at.step + 1, at.step + 2)
                        : fmt::format("step {}", at.step + 1);
}

std::string caption_text(const index::SurfacesQuery& shown, const index::SeriesInfo& info,
                         const std::vector<std::string>& further) {
    std::vector<std::string> values;
    for (const double value : shown.isovalues)
        if (value != kNoSurface)
            values.push_back(with_unit(value, {}, info.digits));
    std::vector<std::string> parts;
    if (!values.empty())
        parts.push_back(fmt::format("{}{}isovalue{} {}{}", info.array,
                                    info.array.empty() ? "" : ", ", values.size() == 1 ? "" : "s",
                                    fmt::join(values, ", "), with_space(info.value_unit)));
    parts.insert(parts.end(), further.begin(), further.end());
    std::string text = fmt::format("{}", fmt::join(parts, ", "));
    if (info.steps() > 1)
        text += fmt::format(", at {} ({} of {})",
                            index::instant_text(info.times, shown.instant, info.time_unit),
                            steps_text(shown.instant), info.steps());
    return text;
}

std::vector<std::string> words_of(const std::vector<ShownFurther>& further) {
    std::vector<std::string> words;
    for (const ShownFurther& each : further)
        words.push_back(
            fmt::format("{} {}{}", each.values.array,
                        with_unit(each.look.isovalue, each.values.unit, each.values.digits),
                        each.simplified ? ", simplified" : ""));
    return words;
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

std::vector<render::ScreenQuad> title_quads(const std::string& words, float opacity,
                                            const render::TextPass& text, const glm::ivec2& picture,
                                            const OverlayColors& overlay, float share) {
    constexpr float kLarger = 1.5f, kWidth = 0.9f, kRow = 1.2f; // row: heights of a line
    constexpr std::size_t kMostLines = 2;
    const float height = std::round(kLarger * text_height(picture, share));
    const float wide = kWidth * static_cast<float>(picture.x) / height;
    const std::vector<std::string> lines = wrapped(
        words,
        [&](const std::string& line) { return render::text_width(text.atlas(), line) <= wide; },
        kMostLines);
    glm::vec4 color = overlay.text, halo = overlay.halo();
    color.w *= opacity;
    halo.w *= opacity;
    std::vector<render::ScreenQuad> quads;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto below = static_cast<float>(lines.size() - i);
        const glm::vec2 middle(0.5f * static_cast<float>(picture.x), kRow * height * below);
        text.set({.text = lines[i],
                  .at = glm::vec3(glm::floor(middle), 0.0f),
                  .color = color,
                  .halo = halo},
                 height, quads);
    }
    return quads;
}

} // namespace isochron::app
