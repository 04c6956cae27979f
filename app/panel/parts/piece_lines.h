// Which connected pieces of the surfaces are shown, and the list of them.
#pragma once

#include "app/panel/panel_model.h"
#include "interaction/commands.h"

#include <cstdint>
#include <optional>
#include <string>

namespace isochron::app {

/// Commands that show the piece of a surface at a place without its other pieces.
interaction::Commands only_piece(const ExplorerState& state, const interaction::PlacedPiece& piece);
/// Commands that hide the piece of a surface at a place; nothing where so many are hidden as can be.
std::optional<interaction::Commands> hidden_piece(const ExplorerState& state,
                                                  const interaction::PlacedPiece& piece);
inline constexpr const char* kColorsPiece =
    "give this piece a color of its own: it becomes a surface of the same isovalue";
/// Commands that make a surface of its own of the piece of a surface at a place, with a color that no
/// surface has, and pick it; nothing where there are as many surfaces or pieces as can be.
std::optional<interaction::Commands> colored_piece(const ExplorerState& state,
                                                   const interaction::PlacedPiece& piece);
/// Commands that hide all pieces of fewer active cells; 0: none.
interaction::Commands with_dust(const ExplorerState& state, double cells);
/// What is left of the settings of pieces where a surface is removed.
interaction::ShownPieces without_surface(interaction::ShownPieces pieces, std::uint32_t removed);

/// The piece at the mark, of the surface whose isovalue is nearest to the mark's value; empty without
/// a mark on the array of the surfaces.
std::optional<interaction::PlacedPiece> piece_at_mark(const ExplorerState& state);

/// `12 of 830 shown`; empty where the settings hide nothing.
std::string words_for_pieces(const PanelModel& model);

void piece_lines(const PanelModel& model, PanelPages& pages, interaction::Commands& commands);

} // namespace isochron::app
