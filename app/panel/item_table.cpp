// The table of what can stand in the picture.
#include "app/panel/item_table.h"

#include "app/panel/parts/curve_drawer.h"
#include "app/panel/parts/ghost_rows.h"
#include "app/panel/parts/mark_lines.h"
#include "app/panel/parts/piece_lines.h"
#include "app/panel/parts/slice_lines.h"
#include "app/panel/parts/surfaces_section.h"
#include "app/scene/mark.h"
#include "app/text.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/navigation.h"
#include "interaction/tools/clip_box.h"
#include "interaction/tools/plane_hold.h"
#include "interaction/tools/ruler_tool.h"
#include "interaction/tools/slice_tool.h"
#include "interaction/tools/tool_table.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Settings;
using interaction::ToolKind;

/// A setting as these commands leave it, to be changed further.
template <auto command, auto setting>
auto& changed(const PanelModel& model, Commands& commands) {
    auto& held = commands.*command;
    if (!held)
        held = model.asked.*setting;
    return *held;
}

template <class List>
void erase_at(List& list, std::size_t i) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
}

IconPath icon_of(ToolKind kind) {
    return IconPath(interaction::tool_row(kind).icon);
}

// Surfaces.

auto& surfaces(const PanelModel& model, Commands& commands) {
    return changed<&Commands::isosurfaces, &Settings::isosurfaces>(model, commands);
}

std::string surface_words(const PanelModel& model, std::size_t i) {
    const index::SeriesInfo& info = model.info_of(i);
    return fmt::format(
        "{} {}", info.array,
        with_unit(model.asked.isosurfaces[i].isovalue, info.value_unit, info.digits));
}

Item surface_item(const PanelModel& model, std::size_t i) {
    const interaction::Isosurface& surface = model.asked.isosurfaces[i];
    const index::SeriesInfo& info = model.info_of(i);
    return {.words = info.array,
            .value = with_unit(surface.isovalue, info.value_unit, info.digits),
            .name = fmt::format("{}", i + 1),
            .shown = surface.opacity > 0,
            .picked = model.asked.isosurfaces.size() > 1 && model.asked.picked == i,
            .color = surface.color,
            .opacity = surface.opacity};
}

constexpr ItemAct kSurfaceActs[] = {
    {"isovalue: the value at the mark",
     [](const PanelModel& model, std::size_t) {
         return model.asked.mark.point && model.asked.mark.point->array.empty();
     },
     [](const PanelModel& model, std::size_t i, Commands& commands) {
         commands.picked = static_cast<std::uint32_t>(i);
         commands.isovalue = model.asked.mark.point->value;
     }}};

// Slices, and what cuts.

auto& slices(const PanelModel& model, Commands& commands) {
    return changed<&Commands::slices, &Settings::slices>(model, commands);
}

/// `x = 12.5 m`, or that the plane is oblique.
std::string plane_words(const PanelModel& model, const glm::dvec3& point,
                        const glm::dvec3& normal) {
    const auto axis = interaction::axis_across(normal, model.data);
    if (!axis)
        return "oblique";
    return fmt::format(
        "{} = {}", "xyz"[*axis],
        with_unit(glm::dot(point, interaction::across(*axis, model.data)), model.info.length_unit));
}

Item slice_item(const PanelModel& model, std::size_t i) {
    const interaction::Plane& plane = model.asked.slices.planes[i];
    return {.words = "slice",
            .value = plane_words(model, plane.point, plane.normal),
            .name = fmt::format("{}", i + 1),
            .shown = plane.shown,
            .picked = model.asked.slices.planes.size() > 1 && model.asked.slices.picked == i};
}

void pick_slice(const PanelModel& model, std::size_t i, Commands& commands) {
    slices(model, commands).picked = static_cast<std::uint32_t>(i);
}

constexpr ItemAct kSliceActs[] = {{"look straight at it", nullptr,
                                   [](const PanelModel& model, std::size_t i, Commands& commands) {
                                       interaction::Slices picked = model.asked.slices;
                                       picked.picked = static_cast<std::uint32_t>(i);
                                       picked.planes[i].shown = true;
                                       merge(commands, flat_view(model, std::move(picked)));
                                   }}};

bool has_clip(const PanelModel& model) {
    return model.asked.clip != interaction::ClipPlane{};
}

/// The clip plane, then the box.
std::size_t count_cuts(const PanelModel& model) {
    return std::size_t{has_clip(model)} +
           std::size_t{model.asked.clip_box != interaction::ClipBox{}};
}

bool is_plane(const PanelModel& model, std::size_t i) {
    return i == 0 && has_clip(model);
}

Item cut_item(const PanelModel& model, std::size_t i) {
    if (is_plane(model, i)) {
        const interaction::ClipPlane& clip = model.asked.clip;
        return {.words = "clip plane",
                .value = plane_words(model, clip.point, clip.normal),
                .name = "plane",
                .shown = clip.shown};
    }
    const interaction::ClipBox& box = model.asked.clip_box;
    return {.words = "clip box",
            .note = fmt::format("{:.4g}:{:.4g}, {:.4g}:{:.4g}, {:.4g}:{:.4g}", box.low.x,
                                box.high.x, box.low.y, box.high.y, box.low.z, box.high.z),
            .name = "box",
            .shown = box.shown};
}

void show_cut(const PanelModel& model, std::size_t i, bool shown, Commands& commands) {
    if (is_plane(model, i))
        changed<&Commands::clip, &Settings::clip>(model, commands).shown = shown;
    else
        changed<&Commands::clip_box, &Settings::clip_box>(model, commands).shown = shown;
}

void remove_cut(const PanelModel& model, std::size_t i, Commands& commands) {
    if (is_plane(model, i))
        commands.clip = interaction::ClipPlane{};
    else
        commands.clip_box = interaction::ClipBox{};
}

// Models.

auto& models(const PanelModel& model, Commands& commands) {
    return changed<&Commands::models, &Settings::models>(model, commands);
}

ListedModel line_of_model(const PanelModel& model, std::size_t i) {
    return i < model.models.lines.size() ? model.models.lines[i] : ListedModel{};
}

Item model_item(const PanelModel& model, std::size_t i) {
    const interaction::Model& shown = model.asked.models[i];
    const ListedModel line = line_of_model(model, i);
    const std::string name = std::filesystem::path(shown.path).filename().string();
    return {.words = name,
            .note = line.fault.empty() ? fmt::format("{}\n{}", shown.path, line.words)
                    : line.refused     ? line.fault + "\nits eye opens it all the same"
                                       : line.fault,
            .name = name,
            .shown = shown.shown && line.fault.empty(),
            .faulty = !line.fault.empty(),
            .color = shown.color,
            .opacity = shown.opacity};
}

/// A model that lies elsewhere than the data is opened.
void show_model(const PanelModel& model, std::size_t i, bool shown, Commands& commands) {
    if (line_of_model(model, i).refused && shown && model.models.allow)
        model.models.allow(model.asked.models[i].path);
    models(model, commands)[i].shown = shown;
}

constexpr ItemAct kModelActs[] = {{"edges or faces of its triangles", nullptr,
                                   [](const PanelModel& model, std::size_t i, Commands& commands) {
                                       interaction::Model& changed = models(model, commands)[i];
                                       changed.lines = !changed.lines;
                                   }}};

template <auto list>
void recolor(const PanelModel& model, std::size_t i, const glm::vec3& color, Commands& commands) {
    list(model, commands)[i].color = color;
}
template <auto list>
void fade(const PanelModel& model, std::size_t i, float opacity, Commands& commands) {
    list(model, commands)[i].opacity = opacity;
}

// Ghosts.

std::size_t count_ghosts(const PanelModel& model) {
    return model.asked.ghosts.earlier + model.asked.ghosts.later > 0 ? 1 : 0;
}

Item ghost_item(const PanelModel& model, std::size_t) {
    const interaction::Ghosts& ghosts = model.asked.ghosts;
    return {.words = fmt::format("ghosts: {} earlier, {} later", ghosts.earlier, ghosts.later),
            .note = model.place == PanelPlace::in_room ? model.ghosts.wished : model.ghosts.shown,
            .name = "all",
            .shown = ghosts.shown(),
            .opacity = ghosts.opacity};
}

// Pieces: those that stand alone, those that are hidden, and dust.

auto& pieces(const PanelModel& model, Commands& commands) {
    return changed<&Commands::pieces, &Settings::pieces>(model, commands);
}

std::size_t count_pieces(const PanelModel& model) {
    const interaction::ShownPieces& all = model.asked.pieces;
    return all.only.size() + all.hidden.size() + (all.dust > 0 ? 1 : 0);
}

/// The item among those that stand alone, or else those that are hidden; null: it is the dust.
template <class Pieces>
auto* piece_of(Pieces& all, std::size_t i) {
    if (i < all.only.size())
        return &all.only[i];
    i -= all.only.size();
    return i < all.hidden.size() ? &all.hidden[i] : nullptr;
}

Item piece_item(const PanelModel& model, std::size_t i) {
    const interaction::ShownPieces& all = model.asked.pieces;
    const interaction::PlacedPiece* const piece = piece_of(all, i);
    const bool alone = i < all.only.size();
    const std::string what = !piece ? fmt::format("dust below {} cells", all.dust)
                             : piece->surface < model.asked.isosurfaces.size()
                                 ? fmt::format("{} of {}", alone ? "piece alone" : "piece",
                                               surface_words(model, piece->surface))
                                 : std::string("piece");
    return {.words = what,
            .note = words_for_pieces(model) + (alone ? "\nits eye shows the others again" : ""),
            .name = fmt::format("{}", i + 1),
            .shown = alone};
}

/// What is hidden is shown again; around what stands alone the others are.
void free_piece(const PanelModel& model, std::size_t i, Commands& commands) {
    interaction::ShownPieces& all = pieces(model, commands);
    if (i < all.only.size())
        erase_at(all.only, i);
    else if (i - all.only.size() < all.hidden.size())
        erase_at(all.hidden, i - all.only.size());
    else
        all.dust = 0;
}

constexpr ItemAct kPieceActs[] = {
    {"give it a color of its own",
     [](const PanelModel& model, std::size_t i) {
         const auto& only = model.asked.pieces.only;
         return i < only.size() && colored_piece(model.asked, only[i]);
     },
     [](const PanelModel& model, std::size_t i, Commands& commands) {
         merge(commands, *colored_piece(model.asked, model.asked.pieces.only[i]));
     }}};

// Marks: those that were kept, then the mark if it was not.

std::size_t count_marks(const PanelModel& model) {
    return model.asked.marks.size() + std::size_t{has_loose_mark(model.asked)};
}

const interaction::MarkedPoint& mark_at(const PanelModel& model, std::size_t i) {
    const auto& kept = model.asked.marks;
    return i < kept.size() ? kept[i].point : *model.asked.mark.point;
}

bool is_the_mark(const PanelModel& model, std::size_t i) {
    const auto& here = model.asked.mark.point;
    return here && here->position == mark_at(model, i).position;
}

Item mark_item(const PanelModel& model, std::size_t i) {
    const interaction::MarkedPoint& point = mark_at(model, i);
    const bool kept = i < model.asked.marks.size();
    return {.words = fmt::format("mark {}", kept ? model.asked.marks[i].name : "here"),
            .value = value_text(point, model.info),
            .note = mark_text(point, model.info),
            .name = kept ? model.asked.marks[i].name : "here",
            .named = kept,
            .shown = point.shown,
            .picked = is_the_mark(model, i)};
}

void show_mark(const PanelModel& model, std::size_t i, bool shown, Commands& commands) {
    if (i < model.asked.marks.size())
        changed<&Commands::marks, &Settings::marks>(model, commands)[i].point.shown = shown;
    if (is_the_mark(model, i))
        changed<&Commands::mark, &Settings::mark>(model, commands).point->shown = shown;
}

void remove_mark(const PanelModel& model, std::size_t i, Commands& commands) {
    if (i < model.asked.marks.size())
        erase_at(changed<&Commands::marks, &Settings::marks>(model, commands), i);
    else
        commands.mark = interaction::Mark{};
}

constexpr ItemAct kMarkActs[] = {
    {"keep it",
     [](const PanelModel& model, std::size_t i) {
         return i == model.asked.marks.size() && i < interaction::kMostMarks;
     },
     [](const PanelModel& model, std::size_t i, Commands& commands) {
         commands.marks = with_mark(model.asked.marks, mark_at(model, i), model.info);
     }}};

// Rulers.

auto& rulers(const PanelModel& model, Commands& commands) {
    return changed<&Commands::rulers, &Settings::rulers>(model, commands);
}

Item ruler_item(const PanelModel& model, std::size_t i) {
    const interaction::Ruler& ruler = model.asked.rulers.list[i];
    const std::string value = interaction::measured_text(ruler, model.data.unit);
    return {.words = fmt::format("{} {}", ruler.angle ? "angle" : "ruler", ruler.name),
            .value = !ruler.complete()
                         ? fmt::format("{} of {} places", ruler.places.size(), ruler.wanted())
                     : value.empty() ? "no angle"
                                     : value,
            .name = ruler.name,
            .named = true,
            .shown = ruler.shown,
            .picked = model.asked.rulers.picked == i};
}

constexpr ItemAct kRulerActs[] = {
    {"values along it (Ctrl + Shift + D)",
     [](const PanelModel& model, std::size_t i) { return model.asked.rulers.list[i].complete(); },
     [](const PanelModel& model, std::size_t i, Commands& commands) {
         rulers(model, commands).picked = static_cast<std::uint32_t>(i);
         commands.curves = model.asked.curves;
         commands.curves->shown = true;
         commands.curves->measure = kProfileCurve;
     }}};

// Where they lie.

constexpr const char* kIntoView = "bring it into view";

std::vector<glm::dvec3> places_of_cut(const PanelModel& model, std::size_t i) {
    if (is_plane(model, i)) {
        const interaction::ClipPlane& clip = model.asked.clip;
        return interaction::outline({clip.point, clip.normal}, model.data);
    }
    Settings boxed;
    boxed.clip_box = model.asked.clip_box;
    boxed.clip_box.shown = true;
    std::vector<glm::dvec3> corners;
    for (const interaction::ToolLine& edge : draw_clip_box(boxed, model.data).lines)
        corners.insert(corners.end(), {edge.from, edge.to});
    return corners;
}

std::vector<glm::dvec3> places_of_model(const PanelModel& model, std::size_t i) {
    std::vector<glm::dvec3> corners;
    if (const auto box = line_of_model(model, i).box)
        for (unsigned corner = 0; corner < 8; ++corner)
            corners.emplace_back((*box)[corner & 1].x, (*box)[corner >> 1 & 1].y,
                                 (*box)[corner >> 2].z);
    return corners;
}

/// None of the dust.
std::vector<glm::dvec3> places_of_piece(const PanelModel& model, std::size_t i) {
    const interaction::PlacedPiece* const piece = piece_of(model.asked.pieces, i);
    return piece ? std::vector{piece->place} : std::vector<glm::dvec3>();
}

std::vector<glm::dvec3> places_of_slice(const PanelModel& model, std::size_t i) {
    return interaction::outline(model.asked.slices.planes[i], model.data);
}

// Key frames.

Item key_item(const PanelModel& model, std::size_t i) {
    const std::vector<interaction::KeyFrame>& keys = model.asked.keys;
    return {.words = fmt::format("key frame {}",
                                 keys[i].name.empty() ? fmt::format("{}", i + 1) : keys[i].name),
            .value = fmt::format("{:.4g} s", keys[i].time),
            .note = keys[i].text,
            .name = keys[i].name,
            .named = true};
}

void rename_key(const PanelModel& model, std::size_t i, const std::string& name,
                Commands& commands) {
    if (name.size() <= interaction::kLongestText)
        changed<&Commands::keys, &Settings::keys>(model, commands)[i].name = name;
}

// Curves.

std::size_t count_curves(const PanelModel& model) {
    return model.asked.curves != interaction::CurveDrawer{} ? 1 : 0;
}

std::vector<ItemKind> all_kinds() {
    return {
        {.name = "surface",
         .icon = Icon::surfaces,
         .count = [](const PanelModel& model) { return model.asked.isosurfaces.size(); },
         .item = surface_item,
         .recolor = recolor<surfaces>,
         .fade = fade<surfaces>,
         .go_words = "move this surface with keys and wheel (I: the next one)",
         .go = [](const PanelModel&, std::size_t i,
                  Commands& commands) { commands.picked = static_cast<std::uint32_t>(i); },
         .acts = kSurfaceActs,
         .remove =
             [](const PanelModel& model, std::size_t i, Commands& commands) {
                 merge(commands, without_surface(model, static_cast<std::uint32_t>(i)));
             },
         .least = 1,
         .alone = true},
        {.name = "slice",
         .icon = icon_of(ToolKind::slice),
         .count = [](const PanelModel& model) { return model.asked.slices.planes.size(); },
         .item = slice_item,
         .show = [](const PanelModel& model, std::size_t i, bool shown,
                    Commands& commands) { slices(model, commands).planes[i].shown = shown; },
         .go_words = "move this slice with keys and hands; out of sight it is brought into view",
         .go = pick_slice,
         .places = places_of_slice,
         .acts = kSliceActs,
         .remove =
             [](const PanelModel& model, std::size_t i, Commands& commands) {
                 pick_slice(model, i, commands);
                 commands.slices = without_slice(*commands.slices);
             },
         .alone = true},
        {.name = "clip",
         .icon = icon_of(ToolKind::clip),
         .count = count_cuts,
         .item = cut_item,
         .show = show_cut,
         .go_words = kIntoView,
         .places = places_of_cut,
         .remove = remove_cut},
        {.name = "model",
         .icon = Icon::data,
         .count = [](const PanelModel& model) { return model.asked.models.size(); },
         .item = model_item,
         .show = show_model,
         .recolor = recolor<models>,
         .fade = fade<models>,
         .go_words = kIntoView,
         .places = places_of_model,
         .acts = kModelActs,
         .remove = [](const PanelModel& model, std::size_t i,
                      Commands& commands) { erase_at(models(model, commands), i); },
         .alone = true},
        {.name = "ghosts",
         .icon = IconPath(kGhostIcon),
         .count = count_ghosts,
         .item = ghost_item,
         .fade =
             [](const PanelModel& model, std::size_t, float opacity, Commands& commands) {
                 changed<&Commands::ghosts, &Settings::ghosts>(model, commands).opacity = opacity;
             },
         .remove =
             [](const PanelModel& model, std::size_t, Commands& commands) {
                 auto& ghosts = changed<&Commands::ghosts, &Settings::ghosts>(model, commands);
                 ghosts.earlier = ghosts.later = 0;
             }},
        {.name = "piece",
         .icon = Icon::surfaces,
         .count = count_pieces,
         .item = piece_item,
         .show = [](const PanelModel& model, std::size_t i, bool,
                    Commands& commands) { free_piece(model, i, commands); },
         .go_words = kIntoView,
         .places = places_of_piece,
         .acts = kPieceActs,
         .remove = free_piece},
        {.name = "mark",
         .icon = icon_of(ToolKind::pick),
         .count = count_marks,
         .item = mark_item,
         .show = show_mark,
         .rename =
             [](const PanelModel& model, std::size_t i, const std::string& name,
                Commands& commands) {
                 changed<&Commands::marks, &Settings::marks>(model, commands)[i].name = name;
             },
         .go_words = "go to this mark at its time, and point it out",
         .go = [](const PanelModel& model, std::size_t i,
                  Commands& commands) { merge(commands, way_to_mark(model, mark_at(model, i))); },
         .places = [](const PanelModel& model,
                      std::size_t i) { return std::vector{mark_at(model, i).position}; },
         .acts = kMarkActs,
         .remove = remove_mark,
         .alone = true},
        {.name = "ruler",
         .icon = icon_of(ToolKind::ruler),
         .count = [](const PanelModel& model) { return model.asked.rulers.list.size(); },
         .item = ruler_item,
         .show = [](const PanelModel& model, std::size_t i, bool shown,
                    Commands& commands) { rulers(model, commands).list[i].shown = shown; },
         .rename = [](const PanelModel& model, std::size_t i, const std::string& name,
                      Commands& commands) { rulers(model, commands).list[i].name = name; },
         .go_words = "go to this ruler and pick it: its values are plotted, Delete removes it",
         .go =
             [](const PanelModel& model, std::size_t i, Commands& commands) {
                 rulers(model, commands).picked = static_cast<std::uint32_t>(i);
             },
         .places = [](const PanelModel& model,
                      std::size_t i) { return model.asked.rulers.list[i].places; },
         .acts = kRulerActs,
         .remove =
             [](const PanelModel& model, std::size_t i, Commands& commands) {
                 commands.rulers = without_ruler(rulers(model, commands), i);
             },
         .alone = true},
        {.name = "curve",
         .icon = Icon::curves,
         .count = count_curves,
         .item =
             [](const PanelModel& model, std::size_t) {
                 const std::string& measure = model.asked.curves.measure;
                 return Item{.words = fmt::format("curve: {}{}", words_of_measure(measure),
                                                  measure == kProfileCurve ? "" : " over time"),
                             .name = "drawer",
                             .shown = model.asked.curves.shown};
             },
         .show =
             [](const PanelModel& model, std::size_t, bool shown, Commands& commands) {
                 changed<&Commands::curves, &Settings::curves>(model, commands).shown = shown;
             },
         .remove = [](const PanelModel&, std::size_t,
                      Commands& commands) { commands.curves = interaction::CurveDrawer{}; }},
        {.name = "key",
         .icon = Icon::movie,
         .count = [](const PanelModel& model) { return model.asked.keys.size(); },
         .item = key_item,
         .rename = rename_key,
         .go_words = "show what this key frame shows",
         .go =
             [](const PanelModel& model, std::size_t i, Commands& commands) {
                 merge(commands,
                       interaction::way_to_key(model.asked.keys[i], model.asked, model.head));
             },
         .remove =
             [](const PanelModel& model, std::size_t i, Commands& commands) {
                 commands.keys = interaction::without_key(
                     changed<&Commands::keys, &Settings::keys>(model, commands), i);
             }},
    };
}

} // namespace

std::span<const ItemKind> item_kinds() {
    static const std::vector<ItemKind> kinds = all_kinds();
    return kinds;
}

void show_item(const ItemKind& kind, const PanelModel& model, std::size_t i, bool shown,
               Commands& commands, float opacity) {
    if (kind.show)
        kind.show(model, i, shown, commands);
    else
        kind.fade(model, i, shown ? opacity : 0.0f, commands);
}

void go_to_item(const ItemKind& kind, const PanelModel& model, std::size_t i, Commands& commands) {
    if (kind.go)
        kind.go(model, i, commands);
    if (!kind.places)
        return;
    const std::vector<glm::dvec3> places = kind.places(model, i);
    const interaction::Similarity& now = model.asked.room_from_physical;
    if (const auto seen = places.empty() ? now : brought_into_view(now, places, model.head);
        seen != now)
        commands.room_from_physical = seen;
}

void show_alone(const ItemKind& kind, const PanelModel& model, std::size_t i, Commands& commands) {
    const std::size_t count = kind.count(model);
    for (std::size_t each = 0; each < count; ++each)
        if (const Item item = kind.item(model, each); item.shown != (each == i))
            show_item(kind, model, each, each == i, commands);
}

std::string words_of_item(const Item& item) {
    return item.value.empty() ? item.words : fmt::format("{} {}", item.words, item.value);
}

std::string words_for_items(const PanelModel& model) {
    std::size_t all = 0, shown = 0;
    for (const ItemKind& kind : item_kinds()) {
        if (!kind.has_eye())
            continue;
        const std::size_t count = kind.count(model);
        all += count;
        for (std::size_t i = 0; i < count; ++i)
            shown += std::size_t{kind.item(model, i).shown};
    }
    return fmt::format("{} of {} shown", shown, all);
}

} // namespace isochron::app
