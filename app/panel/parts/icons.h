// Icons of the panel, drawn as lines.
#pragma once

#include <imgui.h>

#include <cstdint>

namespace isochron::app {

enum class Icon : std::uint8_t {
    open,
    undo,
    redo,
    hand,
    pick,
    clip,
    ruler,
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
    surfaces,
    color,
    view,
    flip,
    remove,
    to_and_fro,
    bookmark,
    bookmark_back,
    bookmark_forward,
    up,
    go,
    send,
    count
};

/// @param size of its square, panel pixels
void draw_icon(ImDrawList& list, Icon icon, const ImVec2& middle, float size, ImU32 color);

inline constexpr float kIconButton = 28.0f; ///< side of a button with an icon, panel pixels

/// A button with an icon and a tip. @param tip_words empty: none @param on drawn as switched on
/// @return whether it was pressed
bool icon_button(const char* id, Icon icon, const char* tip_words, bool on = false,
                 float side = kIconButton);

} // namespace isochron::app
