// The menu of a place in the picture.
#include "app/panel/parts/place_menu.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/piece_lines.h"
#include "app/panel/parts/time_track.h"
#include "app/scene/caption.h"
#include "app/scene/mark.h"
#include "interaction/navigation/navigation.h"
#include "interaction/tools/clip_tool.h"
#include "interaction/tools/slice_tool.h"

#include <imgui.h>

#include <string>

namespace isochron::app {
namespace {

constexpr const char* kMenu = "place";

} // namespace

void open_place_menu() {
    ImGui::OpenPopup(kMenu);
}

bool place_menu(const PanelModel& model, const std::optional<interaction::Pointed>& place,
                interaction::Commands& commands, DesktopWish& wish) {
    if (!ImGui::BeginPopup(kMenu))
        return false;
    const interaction::Similarity& room = model.asked.room_from_physical;
    const interaction::MarkedPoint point = place ? place->point : interaction::MarkedPoint{};
    popup_title(place ? mark_lines(point, model.info).front().c_str() : "no surface here");
    if (ImGui::MenuItem("copy value", nullptr, false, place.has_value()))
        wish.text = mark_text(point, model.info);
    if (ImGui::MenuItem("mark here", nullptr, false, place.has_value()))
        commands.mark = interaction::Mark{point};
    if (ImGui::MenuItem("clip here", nullptr, false, place.has_value()))
        commands.clip = interaction::laid_through(point.position, room,
                                                  transform(room, point.position) -
                                                      glm::dvec3(model.head.position));
    if (ImGui::MenuItem("slice here", nullptr, false, place.has_value())) {
        interaction::Slices slices = model.asked.slices;
        if (slices.picked >= slices.planes.size())
            slices = with_slice(slices, model.data);
        slices.planes[slices.picked].point = point.position;
        commands.slices = slices;
    }
    if (ImGui::MenuItem("isovalue here", nullptr, false, place && model.asked.is_of_picked(point)))
        commands.isovalue = point.value;
    const bool of_other_step = place && point.instant != model.asked.shown_instant();
    if (of_other_step) {
        const std::string words = "go to step " + step_number(point.instant);
        if (ImGui::MenuItem(words.c_str()))
            show(point.instant, commands);
    }
    const bool on_surface = place && !place->on_slice && !of_other_step;
    const interaction::PlacedPiece piece{place ? static_cast<std::uint32_t>(place->surface) : 0,
                                         point.position};
    if (ImGui::MenuItem("show this piece alone", nullptr, false, on_surface))
        interaction::merge(commands, only_piece(model.asked, piece));
    const auto hidden = hidden_piece(model.asked, piece);
    if (ImGui::MenuItem("hide this piece", nullptr, false, on_surface && hidden))
        interaction::merge(commands, *hidden);
    const auto colored = colored_piece(model.asked, piece);
    if (ImGui::MenuItem("color this piece", nullptr, false, on_surface && colored))
        interaction::merge(commands, *colored);
    tip(kColorsPiece);
    if (!model.asked.pieces.all() && ImGui::MenuItem("show all pieces"))
        commands.pieces = interaction::ShownPieces{};
    ImGui::Separator();
    const bool all = ImGui::MenuItem("show all", "C");
    ImGui::EndPopup();
    return all;
}

} // namespace isochron::app
