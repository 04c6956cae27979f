// Draws the word "loading" by clearing small rectangles.
#include "stereo/loading_picture.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isochron::stereo {
namespace {

/// Dots of a letter, and to the next one.
constexpr int kColumns = 5, kRows = 8, kAdvance = kColumns + 1;

/// Rows from the top; the leftmost dot is the highest of five bits.
using DotLetter = std::array<std::uint8_t, kRows>;

constexpr std::array<DotLetter, 7> kLoading{{
    {0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110, 0, 0}, // l
    {0, 0, 0b01110, 0b10001, 0b10001, 0b01110, 0, 0},             // o
    {0, 0, 0b01111, 0b10001, 0b10011, 0b01101, 0, 0},             // a
    {0b00001, 0b00001, 0b01111, 0b10001, 0b10001, 0b01111, 0, 0}, // d
    {0b00100, 0, 0b01100, 0b00100, 0b00100, 0b01110, 0, 0},       // i
    {0, 0, 0b11110, 0b10001, 0b10001, 0b10001, 0, 0},             // n
    {0, 0, 0b01111, 0b10001, 0b10001, 0b01111, 0b00001, 0b01110}, // g
}};

template <class Function>
Function entry_of(const render::GlLoader& loader, const char* name) {
    return reinterpret_cast<Function>(loader(name));
}

} // namespace

void draw_loading(const render::GlLoader& loader, glm::ivec2 size, glm::vec3 background) {
    const auto clear = entry_of<PFNGLCLEARPROC>(loader, "glClear");
    const auto clear_color = entry_of<PFNGLCLEARCOLORPROC>(loader, "glClearColor");
    const auto scissor = entry_of<PFNGLSCISSORPROC>(loader, "glScissor");
    const auto enable = entry_of<PFNGLENABLEPROC>(loader, "glEnable");
    const auto disable = entry_of<PFNGLDISABLEPROC>(loader, "glDisable");
    disable(GL_SCISSOR_TEST);
    clear_color(background.x, background.y, background.z, 1);
    clear(GL_COLOR_BUFFER_BIT);
    constexpr int kWidth = static_cast<int>(kLoading.size()) * kAdvance - 1;
    const int dot = std::max(1, std::min(size.x / 4 / kWidth, size.y / 8 / kRows));
    const glm::ivec2 corner = (size - dot * glm::ivec2(kWidth, kRows)) / 2;
    enable(GL_SCISSOR_TEST);
    clear_color(0.75f, 0.77f, 0.8f, 1);
    for (std::size_t letter = 0; letter < kLoading.size(); ++letter)
        for (int row = 0; row < kRows; ++row)
            for (int column = 0; column < kColumns; ++column) {
                if (!(kLoading[letter][static_cast<std::size_t>(row)] >> (kColumns - 1 - column) &
                      1))
                    continue;
                const int x = static_cast<int>(letter) * kAdvance + column;
                scissor(corner.x + dot * x, corner.y + dot * (kRows - 1 - row), dot, dot);
                clear(GL_COLOR_BUFFER_BIT);
            }
    disable(GL_SCISSOR_TEST);
}

void show_loading(const Windows& windows, glm::vec3 background) {
    const auto show = [&](GlContext& window) {
        if (!window.has_window())
            return;
        window.make_current();
        draw_loading(window.loader(), window.framebuffer_size(), background);
        window.present();
    };
    if (windows.room())
        show(*windows.room());
    for (std::size_t i = 0; i < windows.count(); ++i)
        show(windows[i]);
    windows.drawing().make_current();
}

} // namespace isochron::stereo
