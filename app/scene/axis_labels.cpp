// Chooses the labels along the box that are shown.
#include "app/scene/axis_labels.h"

#include "app/scene/legend.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
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
    Room(const render::GlyphAtlas& atlas, const render::Placement& placement,
         std::span<const render::View> views, float share, std::vector<Covered> taken)
        : atlas_(atlas), placement_(placement), views_(views), share_(share),
          taken_(std::move(taken)) {}

    Covered covered(const render::Label& label) const {
        Covered result;
        for (const render::View& view : views_)
            result.push_back(covered_by(label, text_height(view.size, share_), atlas_,
                                        clip_from_index(view), view.size));
        return result;
    }

    /// Whether words lie over the box in a view, where cells may hide them.
    bool is_over_box(const Covered& here) const {
        for (std::size_t i = 0; i < views_.size(); ++i)
            for (int face = 0; here[i] && face < 6; ++face)
                if (const auto seen = face_in(views_[i], face); seen && meet(*here[i], *seen))
                    return true;
        return false;
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
    /// The title inside the pictures, as near its place as it stands on the fewest numbers; over the
    /// box where there is no room beside it, and on other words where there is none at all.
    render::Label beside_numbers(const render::Label& title,
                                 std::span<const AxisLabels> axes) const {
        std::optional<render::Label> best;
        std::ptrdiff_t fewest = 0;
        constexpr std::ptrdiff_t kOverBox = 50, kOtherWords = 100; // worse than all numbers
        const auto consider = [&](float farther, const glm::vec2& aside) {
            render::Label moved = title;
            moved.offset = farther * moved.offset + aside;
            const glm::vec2 before = moved.offset;
            moved = moved_inside(moved);
            const Covered here = covered(moved);
            std::ptrdiff_t on =
                kOtherWords * std::ranges::count_if(
                                  taken_, [&](const Covered& taken) { return touch(here, taken); });
            if ((farther < 0.0f || moved.offset != before) && is_over_box(here))
                on += kOverBox;
            for (const AxisLabels& axis : axes)
                on += std::ranges::count_if(axis.numbers, [&](const AxisLabels::Number& number) {
                    return touch(here, covered(number.label));
                });
            if (!best || on < fewest) {
                best = moved;
                fewest = on;
            }
        };
        for (const float aside : {0.0f, 6.0f, -6.0f, 12.0f, -12.0f}) // heights of the text
            for (const float higher : {0.0f, 2.0f, -2.0f, 5.0f, -5.0f}) {
                const glm::vec2 from(aside, higher);
                for (const float farther : {1.0f, 1.3f, 1.7f, 2.2f, 2.8f, -1.0f, -2.0f, -4.0f})
                    if (!best ||
                        fewest >= (farther > 0.0f && from == glm::vec2(0.0f) ? 1 : kOverBox))
                        consider(farther, from);
                if (fewest < kOverBox)
                    return *best;
            }
        return *best;
    }
    std::vector<render::Label> labels() && { return std::move(labels_); }

  private:
    static constexpr float kRim = 2.0f; ///< [pixel] between the words and the picture's edge

    /// The corners of a convex quadrilateral, in order [pixel].
    using Quadrilateral = std::array<glm::vec2, 4>;

    glm::mat4 clip_from_index(const render::View& view) const {
        return view.steady().clip_from_eye * view.eye_from_room * placement_.room_from_index;
    }
    /// A face of the box in a view; empty if a part of it is behind the eye.
    std::optional<Quadrilateral> face_in(const render::View& view, int face) const {
        constexpr std::array<std::array<float, 2>, 4> kAround{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        Quadrilateral seen;
        for (std::size_t i = 0; i < 4; ++i) {
            glm::vec4 at(0.0f, 0.0f, 0.0f, 1.0f);
            const int axis = face / 2;
            at[axis] = face % 2 == 0 ? 0.0f : placement_.extent[axis];
            for (int k = 0; k < 2; ++k)
                at[(axis + 1 + k) % 3] =
                    kAround[i][static_cast<std::size_t>(k)] * placement_.extent[(axis + 1 + k) % 3];
            const glm::vec4 clip = clip_from_index(view) * at;
            if (!(clip.w > 0.0f))
                return std::nullopt;
            seen[i] = (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(view.size);
        }
        return seen;
    }
    /// Whether no line along one of their sides parts them.
    static bool meet(const TextRectangle& words, const Quadrilateral& face) {
        const Quadrilateral corners{words.low, glm::vec2(words.high.x, words.low.y), words.high,
                                    glm::vec2(words.low.x, words.high.y)};
        const auto parted_by = [&](const glm::vec2& way) {
            const auto along = [&](const glm::vec2& at) { return glm::dot(at, way); };
            const auto [a, b] = std::ranges::minmax(corners, {}, along);
            const auto [c, d] = std::ranges::minmax(face, {}, along);
            return along(b) < along(c) || along(d) < along(a);
        };
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::vec2 side = face[(i + 1) % 4] - face[i];
            if (parted_by({-side.y, side.x}))
                return false;
        }
        return !parted_by({1.0f, 0.0f}) && !parted_by({0.0f, 1.0f});
    }

    bool is_cut(const Covered& here) const {
        for (std::size_t i = 0; i < views_.size(); ++i)
            if (here[i] && (glm::any(glm::lessThan(here[i]->low, glm::vec2(0.0f))) ||
                            glm::any(glm::greaterThan(here[i]->high, glm::vec2(views_[i].size)))))
                return true;
        return false;
    }

    const render::GlyphAtlas& atlas_;
    render::Placement placement_;
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
                                            const render::Placement& placement,
                                            std::span<const render::View> views, float share,
                                            std::vector<Covered> taken) {
    Room room(atlas, placement, views, share, std::move(taken));
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
