// Layout of the legend.
#include "app/scene/legend.h"

#include "app/text.h"
#include "render/gl/srgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

constexpr int kPatches = 64; ///< number of patches in the bar
constexpr int kMostLegendTicks = 6;
// Heights of the text.
constexpr float kBarHeight = 11.0f, kLeastBarHeight = 4.0f, kBarWidth = 1.0f, kMargin = 1.0f,
                kRimmed = 0.1f;

class Layout {
  public:
    Layout(const render::TextPass& text, const glm::ivec2& picture, const OverlayColors& overlay,
           float share)
        : text_(text), picture_(picture), overlay_(overlay), height_(text_height(picture, share)) {}

    /// @param at, size in heights of the text, from the legend's lower left
    void fill(glm::vec2 at, glm::vec2 size, const glm::vec4& color) {
        text_.fill({}, height_ * at, height_ * (at + size), color, quads_);
    }
    /// An area, with a rim so that it is seen before anything.
    void fill_rimmed(glm::vec2 at, glm::vec2 size, const glm::vec4& color) {
        const glm::vec2 rim(kRimmed);
        fill(at - rim, size + 2.0f * rim, overlay_.halo());
        fill(at, size, color);
    }
    void write(const std::string& line, glm::vec2 at) {
        text_.set({.text = line,
                   .anchor = {0.0f, 0.5f},
                   .offset = at,
                   .color = overlay_.text,
                   .halo = overlay_.halo()},
                  height_, quads_);
        right_ = std::max(right_, at.x + render::text_width(text_.atlas(), line));
        top_ = std::max(top_, at.y + 0.5f);
    }

    /// Moves the legend to its corner of the picture.
    std::vector<render::ScreenQuad> finish() {
        const glm::vec2 size = height_ * (glm::vec2(right_, top_) + kMargin);
        const glm::vec2 corner =
            glm::vec2(static_cast<float>(picture_.x), 0.0f) + glm::vec2(-size.x - height_, height_);
        if (corner.x < 0.0f || corner.y + size.y > static_cast<float>(picture_.y))
            return {};
        // Whole pixels keep it sharp; a legend has no depth that this would change.
        const glm::vec2 origin = glm::floor(corner + 0.5f * kMargin * height_);
        for (render::ScreenQuad& quad : quads_)
            quad.at = glm::vec3(origin, 0.0f);
        return std::move(quads_);
    }
    float top() const { return top_; }
    const OverlayColors& overlay() const { return overlay_; }

  private:
    const render::TextPass& text_;
    glm::vec2 picture_;
    OverlayColors overlay_;
    float height_; ///< height of the text, pixels
    float right_ = 0.0f, top_ = 0.0f;
    std::vector<render::ScreenQuad> quads_;
};

/// @param height of the bar
void write_scale(const ColorScale& scale, float height, Layout& layout) {
    const std::vector<glm::vec3> colors = colors_of(scale);
    const float foot = layout.top() + (layout.top() > 0.0f ? 1.0f : 0.5f);
    layout.fill_rimmed({0.0f, foot}, {kBarWidth, height}, layout.overlay().paper);
    for (int i = 0; i < kPatches; ++i) {
        const std::size_t at = i * (colors.size() - 1) / (kPatches - 1);
        layout.fill({0.0f, foot + height * static_cast<float>(i) / kPatches},
                    {kBarWidth, height / kPatches},
                    glm::vec4(render::srgb_from_linear(colors[at]), 1.0f));
    }
    constexpr float kForTick = 1.5f;
    const int most = std::min(kMostLegendTicks, static_cast<int>(height / kForTick));
    for (const ScaleTick& tick : ticks_on(scale, most)) {
        const float y = foot + height * static_cast<float>(tick.share);
        layout.fill_rimmed({kBarWidth, y - 0.04f}, {0.4f, 0.08f}, layout.overlay().text);
        layout.write(tick.words, {kBarWidth + 0.7f, y});
    }
    layout.write(scale.title, {0.0f, foot + height + 1.1f});
}

bool is_seen(const interaction::Isosurface& surface) {
    return surface.of_shown_array() && surface.opacity > 0;
}

void write_surfaces(const Legend& legend, Layout& layout) {
    float y = layout.top() + (layout.top() > 0.0f ? 1.0f : 0.5f);
    for (const interaction::Isosurface& surface : legend.surfaces) {
        if (!is_seen(surface))
            continue;
        if (!legend.colored)
            layout.fill_rimmed({0.0f, y - 0.4f}, {kBarWidth, 0.8f}, glm::vec4(surface.color, 1.0f));
        const std::string value = with_unit(surface.isovalue, legend.value_unit, legend.digits);
        layout.write(legend.further.empty() ? value : legend.array + " " + value,
                     {kBarWidth + 0.7f, y});
        y += 1.3f;
    }
    if (!legend.scales.empty() && legend.further.empty())
        layout.write(legend.array, {0.0f, y});
}

/// The last one on top.
void write_lines(const std::vector<LegendLine>& lines, Layout& layout) {
    float y = layout.top() + (layout.top() > 0.0f ? 1.0f : 0.5f);
    for (const LegendLine& line : lines) {
        if (line.color)
            layout.fill_rimmed({0.0f, y - 0.4f}, {kBarWidth, 0.8f}, glm::vec4(*line.color, 1.0f));
        layout.write(line.words, {kBarWidth + 0.7f, y});
        y += 1.3f;
    }
}

} // namespace

float text_height(const glm::ivec2& picture, float share) {
    constexpr float kLeast = 11.0f, kMost = 40.0f;
    const auto height = static_cast<float>(picture.y);
    return std::round(share > 0.0f ? std::max(kLeast, share * height)
                                   : std::clamp(height / 40.0f, kLeast, kMost));
}

float line_scale(const glm::ivec2& picture, float share) {
    constexpr float kUsual = 15.0f; // height of text beside lines of their usual width
    return share > 0.0f ? std::max(1.0f, text_height(picture, share) / kUsual) : 1.0f;
}

std::vector<render::ScreenQuad> legend_quads(const Legend& legend, const render::TextPass& text,
                                             const glm::ivec2& picture, float share,
                                             float highest) {
    const auto seen = std::ranges::count_if(legend.surfaces, is_seen);
    const bool several = seen > 1 || (seen == 1 && !legend.further.empty());
    if (legend.scales.empty() && !several && legend.further.empty() && legend.ghosts.empty())
        return {};
    const auto with_bars = [&](float height) {
        Layout layout(text, picture, legend.overlay, share);
        for (const ColorScale& scale : legend.scales)
            write_scale(scale, height, layout);
        if (several)
            write_surfaces(legend, layout);
        write_lines(legend.further, layout);
        write_lines(legend.ghosts, layout);
        return layout;
    };
    std::optional<Layout> layout(with_bars(kBarHeight));
    const float over = layout->top() + 2 * kMargin - highest / text_height(picture, share);
    if (highest > 0.0f && over > 0.0f && !legend.scales.empty())
        layout.emplace(with_bars(std::max(
            kLeastBarHeight, kBarHeight - over / static_cast<float>(legend.scales.size()))));
    return layout->finish();
}

} // namespace isochron::app
