// Colors and measures of the panel: one theme for dark rooms, one for light rooms.
#include "app/panel/parts/theme.h"

#include "app/scene/overlay_colors.h"

#include <array>
#include <cstddef>

namespace isochron::app {
namespace {

constexpr std::size_t kInks = 12;

/// 0xRRGGBB, in the order of `Ink`.
using Palette = std::array<std::uint32_t, kInks>;
constexpr Palette kDark{0xe7e9ec, 0xa6acb5, 0x6cb2ff, 0x7fd8a0, 0xf2bb66, 0xff8f80,
                        0x1c1e22, 0x24272c, 0x2f333a, 0x27466b, 0x3a3f47, 0x667080};
constexpr Palette kLight{0x1b1f24, 0x545b65, 0x0b5cb8, 0x1c6a3b, 0x7d4a00, 0xa8231c,
                         0xf6f7f8, 0xebedf0, 0xe0e3e7, 0xbfd8f3, 0xc9cdd3, 0x8c96a3};

/// Dear ImGui keeps the colors: those of the inks lie in colors of its own that the panel does not
/// use otherwise.
constexpr std::array<ImGuiCol_, kInks> kPlaces{
    ImGuiCol_Text,      ImGuiCol_TextDisabled,     ImGuiCol_CheckMark,
    ImGuiCol_PlotLines, ImGuiCol_PlotLinesHovered, ImGuiCol_PlotHistogramHovered,
    ImGuiCol_WindowBg,  ImGuiCol_MenuBarBg,        ImGuiCol_FrameBg,
    ImGuiCol_Header,    ImGuiCol_Separator,        ImGuiCol_PlotHistogram};

ImVec4 unpacked(std::uint32_t color) {
    const auto part = [color](unsigned shift) {
        return static_cast<float>(color >> shift & 0xff) / 255.0f;
    };
    return {part(16), part(8), part(0), 1.0f};
}

ImVec4 between(const ImVec4& a, const ImVec4& b, float share) {
    const auto mix = [share](float from, float to) { return from + share * (to - from); };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), 1.0f};
}

} // namespace

Theme theme_for(const interaction::Look& look) {
    return is_light(look.background) ? Theme::light : Theme::dark;
}

ImVec4 color_of(Ink ink) {
    return ImGui::GetStyle().Colors[kPlaces[static_cast<std::size_t>(ink)]];
}

ImU32 packed(Ink ink) {
    return ImGui::ColorConvertFloat4ToU32(color_of(ink));
}

void use_theme(Theme theme) {
    if (theme == Theme::dark)
        ImGui::StyleColorsDark();
    else
        ImGui::StyleColorsLight();
    ImVec4* colors = ImGui::GetStyle().Colors;
    const Palette& palette = theme == Theme::dark ? kDark : kLight;
    for (std::size_t ink = 0; ink < kInks; ++ink)
        colors[kPlaces[ink]] = unpacked(palette[ink]);
    const ImVec4 control = color_of(Ink::control), text = color_of(Ink::text);
    const ImVec4 hovered = between(control, text, 0.10f), held = between(control, text, 0.18f);
    const ImVec4 chosen = color_of(Ink::chosen), nothing{0, 0, 0, 0};
    for (const ImGuiCol_ each : {ImGuiCol_Button, ImGuiCol_ScrollbarGrab, ImGuiCol_TitleBg,
                                 ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed})
        colors[each] = control;
    for (const ImGuiCol_ each : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered,
                                 ImGuiCol_HeaderHovered, ImGuiCol_ScrollbarGrabHovered})
        colors[each] = hovered;
    for (const ImGuiCol_ each : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive,
                                 ImGuiCol_HeaderActive, ImGuiCol_ScrollbarGrabActive})
        colors[each] = held;
    colors[ImGuiCol_PopupBg] = color_of(Ink::bar);
    colors[ImGuiCol_ChildBg] = colors[ImGuiCol_ScrollbarBg] = nothing;
    colors[ImGuiCol_Border] = color_of(Ink::line);
    colors[ImGuiCol_SliderGrab] = colors[ImGuiCol_SliderGrabActive] = color_of(Ink::accent);
    colors[ImGuiCol_TextSelectedBg] = chosen;
}

void use_measures() {
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = style.PopupRounding = style.ChildRounding = 5.0f;
    style.FrameRounding = style.GrabRounding = 3.0f;
    style.WindowPadding = {12.0f, 8.0f};
    style.FramePadding = {7.0f, 3.0f};
    style.ItemSpacing = {6.0f, 4.0f};
    style.ItemInnerSpacing = {6.0f, 4.0f};
    style.ScrollbarSize = 9.0f;
    style.WindowMinSize = {1.0f, 1.0f};
    style.WindowBorderSize = 0.0f;
    style.PopupBorderSize = 1.0f;
    style.DisabledAlpha = 0.75f;
}

} // namespace isochron::app
