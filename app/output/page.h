// A page for print: pictures with lines, areas and texts around them, which are written as PDF or
// drawn into pixels. Places are in millimeters from the page's upper left corner, x to the right, y
// down; sizes of letters and widths of lines are in points of 1/72 inch.
#pragma once

#include "render/gl/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

inline constexpr double kPointsOfMillimeter = 72 / 25.4;
/// Height of a line of text, and of the part below its baseline, in sizes of the letters: DejaVu Sans.
inline constexpr double kLineOfText = 1.164, kBelowBaseline = 0.236;

struct PageText {
    glm::dvec2 at{0.0};
    std::string text{};
    double points = 8;
    bool bold = false;
    /// Shares of the text's width, from its left, and of its line's height, from below, that lie at
    /// `at`.
    glm::dvec2 anchor{0.0};
    glm::dvec3 color{0.0}; ///< sRGB, 0 to 1; also below
};

struct PageLine {
    glm::dvec2 from{0.0}, to{0.0};
    double points = 0.5;
    glm::dvec3 color{0.0};
};

struct PageArea {
    glm::dvec2 at{0.0}, size{0.0};
    glm::dvec3 color{0.0};
};

struct PagePicture {
    glm::dvec2 at{0.0}, size{0.0};
    render::Image image{};
};

/// Drawn on white in this order: lines behind, pictures, areas, lines, texts.
struct Page {
    glm::dvec2 size{0.0};
    std::vector<PageLine> lines_behind{};
    std::vector<PagePicture> pictures{};
    std::vector<PageArea> areas{};
    std::vector<PageLine> lines{};
    std::vector<PageText> texts{};
    std::string note{}; ///< kept in a PDF, for `note_in_pdf`; ASCII
};

/// Width of a text [mm]. @throws index::Error as `pdf_of`
double width_of_text(const std::string& text, double points, bool bold);

/// @param path named by errors
/// @throws index::Error: cairo, which writes pages, is missing; or what it says
std::vector<std::byte> pdf_of(const Page& page, const std::filesystem::path& path);
/// The page in pixels, `dpi` an inch, which the image says, too. @throws as `pdf_of`
render::Image pixels_of(const Page& page, double dpi, const std::filesystem::path& path);

inline constexpr const char* kFigureFormat = "isochron figure"; ///< format that notes of figures name

/// The note of a figure that this program wrote, .pdf, .png or .tiff; empty: it is none.
/// @throws index::Error, render::Error naming the file
std::string figure_note_in(const std::filesystem::path& file);

/// What the module of pages does; errors pass as text.
namespace page_module {
using Pdf = void(const Page& page, std::vector<std::byte>& bytes, std::string& error);
using Pixels = void(const Page& page, double dpi, render::Image& image, std::string& error);
using Width = double(const std::string& text, double points, bool bold, std::string& error);
constexpr const char *kPdf = "isochron_page_pdf", *kPixels = "isochron_page_pixels",
                     *kWidth = "isochron_page_width";
} // namespace page_module

} // namespace isochron::app
