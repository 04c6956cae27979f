// Chooses the labels along the box that are shown.
#include "app/scene/axis_labels.h"

#include "app/scene/legend.h"

#include <glm/common.hpp>

#include <algorithm>

namespace isochron::app {
namespace {

// Distances in heights of the text.
constexpr float kAside = 0.1f;   ///< least gap between two texts that are partly side by side
constexpr float kInLine = 0.6f;  ///< least gap between two texts on one line
constexpr float kOneLine = 0.5f; ///< texts are on one line if their heights overlap by more

/// The rectangle that a label covers in each view.
using Covered = std::vector<std::optional<TextRectangle>>;

class Room {
  public:
    Room(const render::GlyphAtlas& atlas, const glm::mat4& room_from_model,
         std::span<const render::View> views, float share)
        : atlas_(atlas), room_from_model_(room_from_model), views_(views), share_(share) {}

    Covered covered(const render::Label& label) const {
        Covered result;
        for (const render::View& view : views_)
            result.push_back(covered_by(label, text_height(view.size, share_), atlas_,
                                        view.clip_from_eye * view.eye_from_room * room_from_model_,
                                        view.size));
        return result;
    }

    /// Whether two labels come too close in any view.
    bool touch(const Covered& a, const Covered& b) const {
        for (std::size_t i = 0; i < views_.size(); ++i) {
            if (!a[i] || !b[i])
                continue;
            const glm::vec2 apart = glm::max(a[i]->low - b[i]->high, b[i]->low - a[i]->high) /
                                    text_height(views_[i].size, share_);
            if (apart.y < 0.0f && apart.x < (apart.y < -kOneLine ? kInLine : kAside))
                return true;
        }
        return false;
    }

    /// Keeps a label if there is room for it.
    void take(const render::Label& label) {
        Covered here = covered(label);
        if (std::ranges::any_of(taken_, [&](const Covered& other) { return touch(here, other); }))
            return;
        taken_.push_back(std::move(here));
        labels_.push_back(label);
    }
    std::vector<render::Label> labels() && { return std::move(labels_); }

  private:
    const render::GlyphAtlas& atlas_;
    glm::mat4 room_from_model_;
    std::span<const render::View> views_;
    float share_; ///< see `text_height`
    std::vector<Covered> taken_;
    std::vector<render::Label> labels_;
};

/// Every n-th number, with the smallest n for which neighbors do not touch.
std::vector<render::Label> thinned(const std::vector<AxisLabels::Number>& numbers,
                                   const Room& room) {
    std::vector<render::Label> kept;
    for (const std::int64_t every : {1, 2, 5, 10}) {
        kept.clear();
        std::optional<Covered> before;
        bool apart = true;
        for (const AxisLabels::Number& number : numbers) {
            if (number.multiple % every != 0)
                continue;
            Covered here = room.covered(number.label);
            apart = apart && !(before && room.touch(*before, here));
            before = std::move(here);
            kept.push_back(number.label);
        }
        if (apart)
            break;
    }
    return kept;
}

} // namespace

std::optional<TextRectangle> covered_by(const render::Label& label, float height,
                                        const render::GlyphAtlas& atlas,
                                        const glm::mat4& clip_from_model, glm::ivec2 picture) {
    const glm::vec4 clip = clip_from_model * glm::vec4(label.at, 1.0f);
    if (!(clip.w > 0.0f))
        return std::nullopt;
    const glm::vec2 at = (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(picture);
    const glm::vec2 size(render::text_width(atlas, label.text), 1.0f);
    const glm::vec2 low = at + height * (label.offset - label.anchor * size);
    return TextRectangle{low, low + height * size};
}

std::vector<render::Label> labels_with_room(std::span<const AxisLabels> axes,
                                            const render::GlyphAtlas& atlas,
                                            const glm::mat4& room_from_model,
                                            std::span<const render::View> views, float share) {
    Room room(atlas, room_from_model, views, share);
    for (const AxisLabels& axis : axes)
        room.take(axis.title);
    for (const AxisLabels& axis : axes)
        for (const render::Label& number : thinned(axis.numbers, room))
            room.take(number);
    return std::move(room).labels();
}

} // namespace isochron::app
