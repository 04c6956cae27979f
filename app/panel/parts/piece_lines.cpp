// Which connected pieces of the surfaces are shown, and the list of them.
#include "app/panel/parts/piece_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/free_color.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/text.h"
#include "interaction/navigation/navigation.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::PlacedPiece;
using interaction::ShownPieces;

constexpr double kMostDust = 1e9; ///< [cells]
constexpr const char* kPieceList = "pieces";

/// Brings a piece to the middle of the view, at the same distance, and marks it. A piece that would
/// look small is enlarged.
Commands way_to_piece(const PanelModel& model, const PieceList& list,
                      const index::MeasuredPiece& piece) {
    constexpr double kNearest = 0.5, kSmall = 1.0 / 12, kLarger = 1.0 / 4;
    const auto place = [](const std::array<double, 3>& at) {
        return glm::dvec3(at[0], at[1], at[2]);
    };
    const interaction::Similarity& now = model.asked.room_from_physical;
    const glm::dvec3 head(model.head.position),
        centroid = transform(now, place(piece.centroid)),
        ahead = glm::dvec3(model.head.orientation * glm::vec3(0.0f, 0.0f, -1.0f));
    const double away = std::max(kNearest, glm::distance(centroid, head));
    const glm::dvec3 middle = head + away * ahead;
    interaction::Similarity there = moved(now, middle - centroid);
    const double length =
        glm::distance(transform(now, place(piece.low)), transform(now, place(piece.high)));
    if (length < kSmall * away)
        there = scaled(there, middle, std::min(kLarger * away / length, interaction::kScaleRange),
                       std::numeric_limits<double>::min(), now.scale * interaction::kScaleRange);
    Commands commands;
    commands.room_from_physical = there;
    commands.mark = interaction::Mark{
        interaction::MarkedPoint{place(piece.place), list.query.instant, list.query.isovalue}};
    return commands;
}

void piece_cell(const std::string& words) {
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    text(words);
}

void piece_row(const PanelModel& model, const PieceList& list, const index::MeasuredPiece& piece,
               Commands& commands) {
    constexpr float kIcon = 24.0f;
    const PlacedPiece placed{list.surface, {piece.place[0], piece.place[1], piece.place[2]}};
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (icon_button("go", Icon::go, "bring this piece to the middle of the view", false, kIcon))
        merge(commands, way_to_piece(model, list, piece));
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("hide", Icon::eye, "hide this piece", false, kIcon))
        if (const auto hidden = hidden_piece(model.asked, placed))
            merge(commands, *hidden);
    ImGui::SameLine(0.0f, 2.0f);
    if (ImGui::Button("alone"))
        merge(commands, only_piece(model.asked, placed));
    tip("show this piece without the others");
    ImGui::SameLine(0.0f, 2.0f);
    const auto colored = colored_piece(model.asked, placed);
    if (colored && ImGui::Button("color"))
        merge(commands, *colored);
    if (colored)
        tip(kColorsPiece);
    piece_cell(grouped(piece.cells));
    piece_cell(fmt::format("{:.4g}", piece.area));
    piece_cell(std::isnan(piece.volume) ? "-" : fmt::format("{:.4g}", piece.volume));
    piece_cell(piece.closed ? "yes" : "no");
}

/// The order that the user chose by the columns' heads.
PieceOrder order_of_table() {
    PieceOrder order;
    const ImGuiTableSortSpecs* const specs = ImGui::TableGetSortSpecs();
    if (specs && specs->SpecsCount > 0) {
        order.by = static_cast<PieceColumn>(specs->Specs[0].ColumnUserID);
        order.rising = specs->Specs[0].SortDirection == ImGuiSortDirection_Ascending;
    }
    return order;
}

void table_of_pieces(const PanelModel& model, Commands& commands) {
    constexpr ImGuiTableFlags kTable =
        ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit;
    constexpr float kWidth = 510.0f, kHeight = 300.0f, kColumn = 84.0f;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 size(std::min(kWidth, 0.9f * screen.x), std::min(kHeight, 0.6f * screen.y));
    if (!ImGui::BeginTable("list", 1 + static_cast<int>(kPieceColumns.size()), kTable, size))
        return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_NoSort);
    for (std::size_t i = 0; i < kPieceColumns.size(); ++i) {
        const bool first = static_cast<PieceColumn>(i) == PieceOrder{}.by;
        ImGui::TableSetupColumn(kPieceColumns[i].data(),
                                ImGuiTableColumnFlags_PreferSortDescending |
                                    (first ? ImGuiTableColumnFlags_DefaultSort : 0),
                                kColumn, static_cast<ImGuiID>(i));
    }
    ImGui::TableHeadersRow();
    model.pieces.want(order_of_table());
    if (const PieceListPtr& list = model.pieces.list)
        for (std::size_t i = 0; i < list->rows.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            piece_row(model, *list, list->rows[i], commands);
            ImGui::PopID();
        }
    ImGui::EndTable();
}

void list_of_pieces(const PanelModel& model, PanelPages& pages, Commands& commands) {
    if (!ImGui::BeginPopup(kPieceList))
        return;
    popup_title("Pieces of the surface");
    table_of_pieces(model, commands);
    const PieceListPtr& list = model.pieces.list;
    if (!model.pieces.failure.empty()) {
        note(model.pieces.failure, color_of(Ink::error));
    } else if (!list) {
        note("measuring ...", color_of(Ink::dim));
    } else {
        const std::size_t rest = list->pieces - list->rows.size();
        const std::string& unit = model.info.length_unit;
        note(fmt::format("{} piece{}", grouped(list->pieces), list->pieces == 1 ? "" : "s") +
                 (rest == 0 ? ""
                            : fmt::format("; {} more, of {} cells", grouped(rest),
                                          grouped(list->other_cells))) +
                 (unit.empty() ? "" : fmt::format("; areas in {}^2, volumes in {}^3", unit, unit)),
             color_of(Ink::dim));
        ImGui::SameLine();
        if (ImGui::Button("copy as CSV"))
            pages.text = csv_of(*list, model.info_of(list->surface));
        tip("the lines of this list for the clipboard; `isochron measure --pieces` writes all");
    }
    ImGui::EndPopup();
}

/// What the mark is good for.
void lines_at_mark(const PanelModel& model, Commands& commands) {
    const auto piece = piece_at_mark(model.asked);
    const bool all = model.asked.pieces.all();
    if (!piece && all)
        return;
    if (piece) {
        row("at the mark");
        if (ImGui::Button("alone"))
            merge(commands, only_piece(model.asked, *piece));
        tip("show the piece at the mark without the other pieces of its surface");
        ImGui::SameLine();
        const auto hidden = hidden_piece(model.asked, *piece);
        ImGui::BeginDisabled(!hidden);
        if (ImGui::Button("hide") && hidden)
            merge(commands, *hidden);
        ImGui::EndDisabled();
        tip("hide the piece at the mark");
        ImGui::SameLine();
        const auto colored = colored_piece(model.asked, *piece);
        ImGui::BeginDisabled(!colored);
        if (ImGui::Button("color") && colored)
            merge(commands, *colored);
        ImGui::EndDisabled();
        tip(kColorsPiece);
        if (!all)
            ImGui::SameLine();
    } else {
        row("");
    }
    if (all)
        return;
    if (ImGui::Button("show all"))
        commands.pieces = ShownPieces{};
    tip("show all pieces of all surfaces again");
    if (!piece)
        ImGui::SameLine();
    fitted_text(words_for_pieces(model), ImGui::GetContentRegionAvail().x,
                color_of(model.pieces.told.too_many_cells ? Ink::warning : Ink::dim));
}

} // namespace

Commands only_piece(const ExplorerState& state, const PlacedPiece& piece) {
    Commands commands;
    commands.pieces = state.pieces;
    std::erase_if(commands.pieces->only,
                  [&](const PlacedPiece& each) { return each.surface == piece.surface; });
    commands.pieces->only.push_back(piece);
    return commands;
}

std::optional<Commands> colored_piece(const ExplorerState& state, const PlacedPiece& piece) {
    const std::size_t count = state.isosurfaces.size();
    auto commands = hidden_piece(state, piece);
    if (!commands || count >= interaction::kMostIsosurfaces || piece.surface >= count ||
        state.pieces.only.size() >= interaction::kMostPlacedPieces)
        return std::nullopt;
    commands->isosurfaces = state.isosurfaces;
    interaction::Isosurface own = state.isosurfaces[piece.surface];
    own.color = free_color(state.isosurfaces);
    commands->isosurfaces->push_back(std::move(own));
    commands->picked = static_cast<std::uint32_t>(count);
    commands->pieces->only.push_back({*commands->picked, piece.place});
    return commands;
}

std::optional<Commands> hidden_piece(const ExplorerState& state, const PlacedPiece& piece) {
    if (state.pieces.hidden.size() >= interaction::kMostPlacedPieces)
        return std::nullopt;
    Commands commands;
    commands.pieces = state.pieces;
    commands.pieces->hidden.push_back(piece);
    return commands;
}

Commands with_dust(const ExplorerState& state, double cells) {
    Commands commands;
    commands.pieces = state.pieces;
    const double least = std::round(std::clamp(cells, 0.0, kMostDust));
    commands.pieces->dust = least <= 1 ? 0 : static_cast<std::uint32_t>(least); // each has one
    return commands;
}

ShownPieces without_surface(ShownPieces pieces, std::uint32_t removed) {
    for (auto* const list : {&pieces.only, &pieces.hidden}) {
        std::erase_if(*list, [&](const PlacedPiece& each) { return each.surface == removed; });
        for (PlacedPiece& each : *list)
            each.surface -= each.surface > removed;
    }
    return pieces;
}

std::optional<PlacedPiece> piece_at_mark(const ExplorerState& state) {
    const auto& mark = state.mark.point;
    if (!mark)
        return std::nullopt;
    const auto nearest =
        std::ranges::min_element(state.isosurfaces, {}, [&](const interaction::Isosurface& each) {
            return each.array == mark->array ? std::abs(each.isovalue - mark->value)
                                             : std::numeric_limits<double>::infinity();
        });
    if (nearest->array != mark->array)
        return std::nullopt;
    return PlacedPiece{static_cast<std::uint32_t>(nearest - state.isosurfaces.begin()),
                       mark->position};
}

std::string words_for_pieces(const PanelModel& model) {
    const index::ToldPieces& told = model.pieces.told;
    if (model.asked.pieces.all())
        return {};
    if (model.pieces.come)
        return "pieces are being told apart ...";
    if (told.too_many_cells)
        return "too many cells to tell pieces apart: all are shown";
    const auto& surfaces = model.asked.isosurfaces;
    if (told.all == 0 && !std::ranges::all_of(surfaces, &interaction::Isosurface::of_shown_array))
        return {}; // those of other arrays are not counted
    return fmt::format("{} of {} shown", grouped(told.kept), grouped(told.all));
}

void piece_lines(const PanelModel& model, PanelPages& pages, Commands& commands) {
    constexpr float kList = 48.0f;
    row("pieces", model.pieces.want ? kList + ImGui::GetStyle().ItemSpacing.x : 0.0f);
    double dust = model.asked.pieces.dust;
    if (number_field("##dust", dust,
                     {.low = 1, .high = 100'000, .logarithmic = true, .bounded = false},
                     dust == 0 ? "of all sizes" : "from %.0f cells"))
        merge(commands, with_dust(model.asked, dust));
    tip("hide connected pieces of the surfaces that have fewer active cells: drag, or click and "
        "type");
    if (model.pieces.want) {
        ImGui::SameLine();
        if (ImGui::Button("list", {kList, 0.0f}))
            ImGui::OpenPopup(kPieceList);
        tip("the pieces of the picked surface with their sizes: go to one, hide it, show it alone");
        list_of_pieces(model, pages, commands);
    }
    lines_at_mark(model, commands);
}

} // namespace isochron::app
