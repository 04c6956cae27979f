// The table of what can stand in the picture, a row for each kind: how many there are, what a line of
// the panel's list says of one, and what its eye, its swatch and its menu do.
//
// The list and the search of commands follow from the table. A further kind is a row there.
#pragma once

#include "app/panel/panel_model.h"
#include "app/panel/parts/icons.h"
#include "interaction/commands.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// What a line of the list says of one thing.
struct Item {
    std::string words;   ///< `vorticity`
    std::string value{}; ///< `9.4 1/s`, seen whole where the words are cut; may be empty
    std::string note{};  ///< tip: what there is no room for
    std::string name{};  ///< in the search
    bool named = false;  ///< `rename` changes the name
    bool shown = true;   ///< it is seen
    bool picked = false; ///< keys and tools move it
    bool faulty = false; ///< it cannot be shown; the note says why
    std::optional<glm::vec3> color{}; ///< sRGB, 0 to 1
    std::optional<float> opacity{};   ///< 0 to 1
};

/// A line of an item's menu.
struct ItemAct {
    const char* words;
    /// Null: always.
    bool (*offered)(const PanelModel& model, std::size_t i);
    void (*run)(const PanelModel& model, std::size_t i, interaction::Commands& commands);
};

/// Functions take the number of an item and add to commands, which may change other items of the kind
/// already. Those that are null do not apply to the kind.
struct ItemKind {
    std::string_view name; ///< `surface`; in the search for ever: `surface=1`
    IconPath icon;         ///< stands where an item has no color
    std::size_t (*count)(const PanelModel& model);
    Item (*item)(const PanelModel& model, std::size_t i);
    /// The eye; null: an opacity of 0 hides it.
    void (*show)(const PanelModel& model, std::size_t i, bool shown, interaction::Commands&) = {};
    void (*recolor)(const PanelModel& model, std::size_t i, const glm::vec3& color,
                    interaction::Commands&) = {};
    void (*fade)(const PanelModel& model, std::size_t i, float opacity,
                 interaction::Commands&) = {};
    void (*rename)(const PanelModel& model, std::size_t i, const std::string& name,
                   interaction::Commands&) = {};
    const char* go_words = ""; ///< what a press on the line does, see `go_to_item`
    void (*go)(const PanelModel& model, std::size_t i, interaction::Commands&) = {};
    /// The places between which it lies, in physical space, which a press brings into view; none: it
    /// lies nowhere, or is not there yet.
    std::vector<glm::dvec3> (*places)(const PanelModel& model, std::size_t i) = {};
    std::span<const ItemAct> acts = {};
    /// Not for the last item of a kind that needs one.
    void (*remove)(const PanelModel& model, std::size_t i, interaction::Commands&) = {};
    std::size_t least = 0; ///< items that cannot be removed
    bool alone = false;    ///< one can be shown without the others of its kind

    bool has_eye() const { return show || fade; }
    bool can_go() const { return go || places; }
};

/// In the order of the list.
std::span<const ItemKind> item_kinds();

/// Shows or hides an item. @param opacity of one that is shown again and that opacity 0 has hidden
void show_item(const ItemKind& kind, const PanelModel& model, std::size_t i, bool shown,
               interaction::Commands& commands, float opacity = 1.0f);
/// What a press on an item's line does: `go`, and the data are moved if it is out of sight. The kind
/// can go.
void go_to_item(const ItemKind& kind, const PanelModel& model, std::size_t i,
                interaction::Commands& commands);
/// Shows an item and hides the others of its kind, which has `alone`.
void show_alone(const ItemKind& kind, const PanelModel& model, std::size_t i,
                interaction::Commands& commands);

/// `vorticity 9.4 1/s`
std::string words_of_item(const Item& item);
/// `5 of 7 shown`
std::string words_for_items(const PanelModel& model);

} // namespace isochron::app
