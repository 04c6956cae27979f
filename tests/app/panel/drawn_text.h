// The text that Dear ImGui has laid out, as it will be seen: whether it is cut, overlaps other text,
// or hardly differs from what is behind it.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// A run of characters that were drawn one after the other, and what is wrong with it.
struct TextFault {
    std::string text, fault, window;
};

inline constexpr const char* kHidden = "is partly hidden"; ///< the fault of text that lies below

struct ReadText {
    std::size_t runs = 0; ///< runs of characters
    std::vector<TextFault> faults;
};

/// What is drawn, painted in its order. Colors of the picture behind the windows are not known:
/// text that lies directly on it is a fault, too.
/// @param least contrast, as WCAG 2.1 defines it
ReadText read_text(const ImDrawData& data, const ImFont& font, double least = 4.5);

/// The middle of a text that was drawn, in panel pixels; of several, the one that was drawn last.
/// @param text with or without its spaces
std::optional<ImVec2> place_of_text(const ImDrawData& data, const ImFont& font, std::string text);

} // namespace isochron::app
