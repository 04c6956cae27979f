// Chooses the labels along the box that are shown.
#include "app/scene/axis_labels.h"

#include "app/scene/legend.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace isochron::app {
namespace {

// Distances in heights of the text.
constexpr float kAside = 0.1f;   ///< least gap between two texts that are partly side by side
constexpr float kInLine = 0.6f;  ///< least gap between two texts on one line
constexpr float kOneLine = 0.5f; ///< texts are on one line if their heights overlap by more

class Room {
  public:
    Room(const render::GlyphAtlas& atlas, const glm::mat4& room_from_model,
         std::span<const render::View> views, float share, std::vector<Covered> taken)
        : atlas_(atlas), room_from_model_(room_from_model), views_(views), share_(share),
          taken_(std::move(taken)) {}

    Covered covered(const render::Label& label) const {
        Covered result;
        for (const render::View& view : views_)
            result.push_back(covered_by(
                label, text_height(view.size, share_), atlas_,
                view.steady().clip_from_eye * view.eye_from_room * room_from_model_, view.size));
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

    /// Keeps a label if all of it is in the pictures, and there is room for it. @return whether it is
    bool take(const render::Label& label) {
        Covered here = covered(label);
        if (is_cut(here) ||
            std::ranges::any_of(taken_, [&](const Covered& other) { return touch(here, other); }))
            return false;
        taken_.push_back(std::move(here));
        labels_.push_back(label);
        return true;
    }
    /// The label as far from its place as all of it is in the pictures.
    render::Label moved_inside(render::Label label) const {
        const Covered here = covered(label);
        for (int axis = 0; axis < 2; ++axis) {
            float up = 0, down = 0;
            for (std::size_t i = 0; i < views_.size(); ++i) {
                if (!here[i])
                    continue;
                const float height = text_height(views_[i].size, share_);
                const float size = static_cast<float>(views_[i].size[axis]);
                up = std::max(up, (kRim - here[i]->low[axis]) / height);
                down = std::max(down, (here[i]->high[axis] + kRim - size) / height);
            }
            label.offset[axis] += up > 0 ? up : -down;
        }
        return label;
    }
    /// The title inside the pictures, as near its place as it stands on the fewest numbers; where other
    /// words leave no room beside the box, over the box.
    render::Label beside_numbers(const render::Label& title,
                                 std::span<const AxisLabels> axes) const {
        std::optional<render::Label> best;
        std::ptrdiff_t fewest = 0;
        constexpr std::ptrdiff_t kOtherWords = 100; // worse than all numbers
        const auto consider = [&](float farther, float higher) {
            render::Label moved = title;
            moved.offset = farther * moved.offset + glm::vec2(0.0f, higher);
            moved = moved_inside(moved);
            const Covered here = covered(moved);
            std::ptrdiff_t on =
                kOtherWords * std::ranges::count_if(
                                  taken_, [&](const Covered& taken) { return touch(here, taken); });
            for (const AxisLabels& axis : axes)
                on += std::ranges::count_if(axis.numbers, [&](const AxisLabels::Number& number) {
                    return touch(here, covered(number.label));
                });
            if (!best || on < fewest) {
                best = moved;
                fewest = on;
            }
        };
        for (const float higher : {0.0f, 2.0f, -2.0f, 5.0f, -5.0f}) { // heights of the text
            for (const float farther : {1.0f, 1.3f, 1.7f, 2.2f, 2.8f, -1.0f, -2.0f, -4.0f})
                if (!best || fewest >= (farther > 0.0f && higher == 0.0f ? 1 : kOtherWords))
                    consider(farther, higher);
            if (fewest < kOtherWords)
                break;
        }
        return *best;
    }
    std::vector<render::Label> labels() && { return std::move(labels_); }

  private:
    static constexpr float kRim = 2.0f; ///< [pixel] between the words and the picture's edge

    bool is_cut(const Covered& here) const {
        for (std::size_t i = 0; i < views_.size(); ++i)
            if (here[i] && (glm::any(glm::lessThan(here[i]->low, glm::vec2(0.0f))) ||
                            glm::any(glm::greaterThan(here[i]->high, glm::vec2(views_[i].size)))))
                return true;
        return false;
    }

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
                                            std::span<const render::View> views, float share,
                                            std::vector<Covered> taken) {
    Room room(atlas, room_from_model, views, share, std::move(taken));
    for (const AxisLabels& axis : axes)
        room.take(room.beside_numbers(axis.title, axes));
    // Two numbers of each axis first, as far apart as there is room: of those that are spread evenly,
    // or else of all.
    std::vector<std::vector<render::Label>> even;
    for (const AxisLabels& axis : axes) {
        even.push_back(thinned(axis.numbers, room));
        std::vector<render::Label> all;
        for (const AxisLabels::Number& number : axis.numbers)
            all.push_back(number.label);
        int shown = 0;
        for (const auto& numbers : {even.back(), all}) {
            const auto take = [&](const render::Label& label) {
                return shown < 2 && room.take(label) && ++shown > 0;
            };
            const auto first = std::ranges::find_if(numbers, take);
            std::find_if(numbers.rbegin(), std::make_reverse_iterator(first), take);
        }
    }
    for (const auto& numbers : even)
        for (const render::Label& number : numbers)
            room.take(number);
    return std::move(room).labels();
}

} // namespace isochron::app
