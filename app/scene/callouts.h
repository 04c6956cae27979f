// Words beside places in the data: of the mark, of tools, and of the cursor. They make room for each
// other.
#pragma once

#include "app/scene/overlay_colors.h"
#include "app/scene/picture.h"
#include "index/volume/volume_series.h"
#include "render/gl/view.h"
#include "render/passes/text_pass.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// What is drawn at the place itself.
enum class CalloutSign : std::uint8_t { none, cross, dot };

struct Callout {
    glm::vec3 at{0.0f};             ///< in the room
    std::vector<std::string> lines; ///< one at least
    glm::vec4 color{1.0f};          ///< color of the first line
    /// Words without a sign stand on their place, those of a sign beside it.
    CalloutSign sign = CalloutSign::none;
};

/// Callouts of a story's step, of the mark, of marks that were kept, of tools, and of the place under the cursor, in the order in which they
/// get room.
std::vector<Callout> callouts_of(const Picture& picture,
                                 const std::optional<interaction::Pointed>& pointed,
                                 const index::SeriesInfo& info);

/// The place of a callout's words, with the room around them, from its place, in heights of the text, up positive.
struct CalloutPaper {
    glm::vec2 low{0.0f}, high{0.0f};
};

/// Where the words of each callout stand: the same in all views, so that both eyes see one callout;
/// in none of them over the words or the sign of another callout, outside the picture or under a
/// panel's tools and cube at its top, as long as there is room.
/// @param share height of the words, see `text_height` @param panel there is one over the picture
std::vector<CalloutPaper> papers_of(std::span<const Callout> callouts,
                                    const render::GlyphAtlas& atlas,
                                    std::span<const render::View> views, float share = 0.0f,
                                    bool panel = false);

/// To be drawn over the surface on which the place lies, at the place's depth.
/// @param overlay colors for the background behind the data
/// @param share height of the words, see `text_height`
std::vector<render::ScreenQuad>
callout_quads(const Callout& callout, const CalloutPaper& paper, const render::TextPass& text,
              const glm::ivec2& picture, const OverlayColors& overlay = {}, float share = 0.0f);

} // namespace isochron::app
