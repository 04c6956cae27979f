// Icons of the panel, drawn as lines.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string_view>

namespace isochron::app {

enum class Icon : std::uint8_t {
    open,
    undo,
    redo,
    record,
    picture,
    movie,
    search,
    help,
    menu,
    close,
    eye,
    eye_shut,
    add,
    first,
    back,
    play,
    pause,
    forward,
    last,
    loop,
    data,
    objects,
    surfaces,
    color,
    view,
    flip,
    remove,
    to_and_fro,
    blend,
    bookmark,
    bookmark_back,
    bookmark_forward,
    up,
    go,
    send,
    curves,
    count
};

/// What to draw on a square of 24 units, y down. A letter, then numbers: `M` begins a line at a
/// point and `L` goes on to the next one; `Z` closes the line and `F` fills it; `O` is a circle
/// and `D` a disc, each with its middle and its radius.
struct IconPath {
    std::string_view steps;
    constexpr explicit IconPath(std::string_view path) : steps(path) {}
    IconPath(Icon icon);
};

/// @param size of its square, panel pixels
void draw_icon(ImDrawList& list, IconPath icon, const ImVec2& middle, float size, ImU32 color);

inline constexpr float kIconButton = 28.0f; ///< side of a button with an icon, panel pixels

/// A button with an icon and a tip. @param tip_words empty: none @param on drawn as switched on
/// @return whether it was pressed
bool icon_button(const char* id, IconPath icon, const char* tip_words, bool on = false,
                 float side = kIconButton);

} // namespace isochron::app
