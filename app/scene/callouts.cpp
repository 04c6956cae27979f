// Words beside places in the data, and room for them.
#include "app/scene/callouts.h"

#include "app/scene/caption.h"
#include "app/scene/legend.h"
#include "app/scene/mark.h"
#include "interaction/navigation/navigation.h"

#include <glm/common.hpp>

#include <algorithm>

namespace isochron::app {
namespace {

// In heights of the text.
constexpr float kOff = 0.5f;               ///< words, from the place beside which they stand
constexpr float kPad = 0.4f, kRow = 1.15f; ///< around them; from line to line
constexpr float kArm = 0.6f, kHalfWidth = 0.07f, kRim = 0.07f, kDot = 0.12f; ///< sizes of the signs
constexpr float kBetween = 0.15f; ///< from one callout to another one

constexpr glm::vec4 kMarkColor(1.0f, 0.45f, 0.85f, 1.0f);

/// A color in which words can be read in their halo, whatever lies behind it.
glm::vec4 readable(const glm::vec3& color, const OverlayColors& overlay) {
    return {legible_on(overlay.halo(), color, overlay), 1.0f};
}

float reach_of(CalloutSign sign) {
    switch (sign) {
    case CalloutSign::none: break;
    case CalloutSign::cross: return kArm + kRim;
    case CalloutSign::dot: return kDot + kRim;
    }
    return 0.0f;
}

glm::vec2 size_of(const Callout& callout, const render::GlyphAtlas& atlas) {
    float width = 0.0f;
    for (const std::string& line : callout.lines)
        width = std::max(width, render::text_width(atlas, line));
    return {width + 2 * kPad, kRow * static_cast<float>(callout.lines.size()) + 2 * kPad};
}

/// Lower left corners of the words, the best first.
std::vector<glm::vec2> choices_for(const Callout& callout, const glm::vec2& size) {
    constexpr int kRows = 4; // rows of callouts, over and below
    std::vector<glm::vec2> choices;
    for (int row = 0; row < kRows; ++row) {
        const float away = static_cast<float>(row) * (size.y + kBetween);
        if (callout.sign == CalloutSign::none) {
            choices.emplace_back(-0.5f * size.x, away - 0.5f * size.y);
            choices.emplace_back(-0.5f * size.x, -away - 0.5f * size.y);
        } else {
            for (const float y : {kOff + away, -kOff - away - size.y})
                for (const float x : {kOff, -kOff - size.x})
                    choices.emplace_back(x, y);
        }
    }
    return choices;
}

struct Area {
    glm::vec2 low{0.0f}, high{0.0f}; ///< [pixel]

    bool meets(const Area& other, float apart) const {
        return low.x < other.high.x + apart && other.low.x < high.x + apart &&
               low.y < other.high.y + apart && other.low.y < high.y + apart;
    }
};
/// One area in each view; none where the place is behind the eye.
using Areas = std::vector<std::optional<Area>>;

Areas areas_of(const glm::vec3& at, const CalloutPaper& paper, std::span<const render::View> views,
               float share) {
    Areas areas;
    for (const render::View& view : views) {
        const glm::vec4 clip =
            view.steady().clip_from_eye * view.eye_from_room * glm::vec4(at, 1.0f);
        const glm::vec2 pixel = (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(view.size);
        const float height = text_height(view.size, share);
        if (clip.w > 0.0f)
            areas.push_back(Area{pixel + height * paper.low, pixel + height * paper.high});
        else
            areas.emplace_back();
    }
    return areas;
}

bool meet(const Areas& a, const Areas& b, std::span<const render::View> views, float share) {
    for (std::size_t i = 0; i < views.size(); ++i)
        if (a[i] && b[i] && a[i]->meets(*b[i], kBetween * text_height(views[i].size, share)))
            return true;
    return false;
}

/// Whether an area lies in the picture, and where a panel over it leaves it free: below the line of
/// its chip and its tools, and beside its cube in the upper right corner.
/// @param height of the text
bool is_free(const Area& area, const glm::vec2& picture, bool panel, float height) {
    constexpr float kLine = 3.3f, kCube = 7.0f; // heights of the text
    if (glm::any(glm::lessThan(area.low, glm::vec2(0.0f))) ||
        glm::any(glm::greaterThan(area.high, picture)))
        return false;
    return !panel || (area.high.y <= picture.y - kLine * height &&
                      !area.meets({picture - kCube * height, picture}, 0.0f));
}

bool are_free(const Areas& areas, std::span<const render::View> views, float share, bool panel) {
    for (std::size_t i = 0; i < views.size(); ++i)
        if (areas[i] &&
            !is_free(*areas[i], glm::vec2(views[i].size), panel, text_height(views[i].size, share)))
            return false;
    return true;
}

void add_sign(const Callout& callout, float height, const render::TextPass& text,
              const OverlayColors& overlay, std::vector<render::ScreenQuad>& quads) {
    const auto fill = [&](const glm::vec2& reach, const glm::vec4& color) {
        text.fill(callout.at, -height * reach, height * reach, color, quads);
    };
    for (const float rim : {kRim, 0.0f}) {
        const glm::vec4 paper = overlay.halo();
        if (callout.sign == CalloutSign::dot)
            fill(glm::vec2(kDot + rim), rim > 0 ? paper : overlay.text);
        if (callout.sign == CalloutSign::cross)
            for (const bool upright : {false, true}) {
                const glm::vec2 arm(kArm + rim, kHalfWidth + rim);
                fill(upright ? glm::vec2(arm.y, arm.x) : arm, rim > 0 ? paper : callout.color);
            }
    }
}

} // namespace

std::vector<Callout> callouts_of(const Picture& picture,
                                 const std::optional<interaction::Pointed>& pointed,
                                 const index::SeriesInfo& info) {
    const auto in_room = [&](const glm::dvec3& place) {
        return glm::vec3(interaction::transform(picture.room_from_physical, place));
    };
    const OverlayColors overlay = overlay_colors_on(picture.look.background);
    const auto instant_of = [](const ShownGhost& ghost) { return ghost.surfaces->query.instant; };
    std::vector<Callout> callouts;
    if (picture.told)
        callouts.push_back(
            {in_room(picture.told->place), picture.told->lines, overlay.text, CalloutSign::dot});
    const auto& mark = picture.mark.point;
    if (mark && mark->shown)
        callouts.push_back({in_room(mark->position), mark_lines(*mark, info),
                            readable(kMarkColor, overlay), CalloutSign::cross});
    for (const interaction::NamedMark& kept : picture.marks)
        if (kept.point.shown && (!mark || kept.point.position != mark->position))
            callouts.push_back({in_room(kept.point.position),
                                {kept.name},
                                readable(kMarkColor, overlay),
                                CalloutSign::cross});
    for (const interaction::ToolLabel& label : picture.tools.labels)
        callouts.push_back({in_room(label.at), {label.text}, overlay.text, CalloutSign::none});
    if (pointed && pointed->surface < picture.isosurfaces.size()) {
        callouts.push_back({in_room(pointed->point.position),
                            pointed_lines(*pointed, picture.isosurfaces.size(), info),
                            pointed->on_slice
                                ? overlay.text
                                : readable(picture.isosurfaces[pointed->surface].color, overlay),
                            CalloutSign::dot});
        const index::Instant at = pointed->point.instant;
        if (!pointed->on_slice &&
            std::ranges::find(picture.ghosts, at, instant_of) != picture.ghosts.end())
            callouts.back().lines.push_back("ghost: step " + step_number(at));
    }
    return callouts;
}

std::vector<CalloutPaper> papers_of(std::span<const Callout> callouts,
                                    const render::GlyphAtlas& atlas,
                                    std::span<const render::View> views, float share, bool panel) {
    std::vector<Areas> signs, taken;
    for (const Callout& callout : callouts) {
        const glm::vec2 reach(reach_of(callout.sign));
        signs.push_back(areas_of(callout.at, {-reach, reach}, views, share));
    }
    std::vector<CalloutPaper> papers;
    for (std::size_t i = 0; i < callouts.size(); ++i) {
        const glm::vec2 size = size_of(callouts[i], atlas);
        const auto choices = choices_for(callouts[i], size);
        std::optional<CalloutPaper> free, inside;
        for (const glm::vec2& low : choices) {
            const CalloutPaper paper{low, low + size};
            const Areas areas = areas_of(callouts[i].at, paper, views, share);
            bool covers = std::ranges::any_of(
                taken, [&](const Areas& other) { return meet(areas, other, views, share); });
            for (std::size_t other = 0; other < callouts.size(); ++other)
                covers = covers || (other != i && callouts[other].sign != CalloutSign::none &&
                                    meet(areas, signs[other], views, share));
            if (covers)
                continue;
            if (!free)
                free = paper;
            if (!inside && are_free(areas, views, share, panel))
                inside = paper;
        }
        const CalloutPaper usual{choices.front(), choices.front() + size};
        papers.push_back(inside ? *inside : free.value_or(usual));
        taken.push_back(areas_of(callouts[i].at, papers.back(), views, share));
    }
    return papers;
}

std::vector<render::ScreenQuad> callout_quads(const Callout& callout, const CalloutPaper& paper,
                                              const render::TextPass& text,
                                              const glm::ivec2& picture,
                                              const OverlayColors& overlay, float share) {
    const float height = text_height(picture, share);
    std::vector<render::ScreenQuad> quads;
    add_sign(callout, height, text, overlay, quads);
    for (std::size_t i = 0; i < callout.lines.size(); ++i)
        text.set(
            {.text = callout.lines[i],
             .at = callout.at,
             .anchor = {0.0f, 0.0f},
             .offset = {paper.low.x + kPad, paper.high.y - kPad - kRow * static_cast<float>(i + 1)},
             .color = i == 0 ? callout.color : overlay.text,
             .halo = overlay.halo()},
            height, quads);
    return quads;
}

} // namespace isochron::app
