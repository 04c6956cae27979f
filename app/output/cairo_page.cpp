// The module that draws pages with cairo: loaded when the first is drawn.
#include "app/output/page.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo.h>

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>

namespace isochron::app {
namespace {

constexpr const char* kFontFolders[]{"/usr/share/fonts/truetype/dejavu/",
                                     "/usr/share/fonts/dejavu-sans-fonts/", "/usr/share/fonts/TTF/",
                                     "/usr/share/fonts/truetype/"};

template <auto Free>
struct Freed {
    template <class T>
    void operator()(T* thing) const {
        Free(thing);
    }
};
using Surface = std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>>;
using Cairo = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;

/// A font of a file, which is never given back: the module stays loaded.
cairo_font_face_t* font(bool bold) {
    static const std::array fonts = [] {
        FT_Library library = nullptr;
        if (FT_Init_FreeType(&library) != 0)
            throw std::runtime_error("FreeType cannot be used");
        std::array<cairo_font_face_t*, 2> both{};
        for (const bool heavy : {false, true}) {
            FT_Face face = nullptr;
            for (const char* const folder : kFontFolders)
                if (!face)
                    FT_New_Face(
                        library,
                        fmt::format("{}DejaVuSans{}.ttf", folder, heavy ? "-Bold" : "").c_str(), 0,
                        &face);
            if (!face)
                throw std::runtime_error("the font DejaVu Sans is missing (Debian: apt install "
                                         "fonts-dejavu-core)");
            both[heavy ? 1 : 0] = cairo_ft_font_face_create_for_ft_face(face, 0);
        }
        return both;
    }();
    return fonts[bold ? 1 : 0];
}

void expect_good(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(fmt::format("cairo: {}", cairo_status_to_string(status)));
}

/// Lengths are as on paper, whatever the pixels are.
void set_font(cairo_t* cairo, double points, bool bold) {
    cairo_set_font_face(cairo, font(bold));
    cairo_set_font_size(cairo, points / kPointsOfMillimeter);
    cairo_font_options_t* const options = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
}

double advance_of(cairo_t* cairo, const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text.c_str(), &extents);
    return extents.x_advance;
}

/// The share of a color that covers a pixel so far, 0 to 255 of both.
std::uint32_t covering(std::uint32_t color, std::uint32_t cover) {
    return (color * cover + 127) / 255;
}

void draw_picture(cairo_t* cairo, const PagePicture& picture) {
    const render::Image& image = picture.image;
    const Surface surface(cairo_image_surface_create(
        image.opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, image.width, image.height));
    expect_good(cairo_surface_status(surface.get()));
    std::uint8_t* const to = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* const from = image.at(x, y);
            const std::uint32_t cover = image.opaque ? 255 : from[3];
            reinterpret_cast<std::uint32_t*>(to + std::ptrdiff_t{y} * stride)[x] =
                cover << 24 | covering(from[0], cover) << 16 | covering(from[1], cover) << 8 |
                covering(from[2], cover);
        }
    cairo_surface_mark_dirty(surface.get());
    cairo_save(cairo);
    cairo_translate(cairo, picture.at.x, picture.at.y);
    cairo_rectangle(cairo, 0, 0, picture.size.x, picture.size.y);
    cairo_clip(cairo);
    cairo_scale(cairo, picture.size.x / image.width, picture.size.y / image.height);
    cairo_set_source_surface(cairo, surface.get(), 0, 0);
    cairo_pattern_set_extend(cairo_get_source(cairo), CAIRO_EXTEND_PAD);
    cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_GOOD);
    cairo_paint(cairo);
    cairo_restore(cairo);
}

void set_color(cairo_t* cairo, const glm::dvec3& color) {
    cairo_set_source_rgb(cairo, color.x, color.y, color.z);
}

/// @param cairo in millimeters
void draw(cairo_t* cairo, const Page& page) {
    const auto draw_lines = [&](const std::vector<PageLine>& lines) {
        for (const PageLine& line : lines) {
            set_color(cairo, line.color);
            cairo_set_line_width(cairo, line.points / kPointsOfMillimeter);
            cairo_move_to(cairo, line.from.x, line.from.y);
            cairo_line_to(cairo, line.to.x, line.to.y);
            cairo_stroke(cairo);
        }
    };
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    draw_lines(page.lines_behind);
    for (const PagePicture& picture : page.pictures)
        draw_picture(cairo, picture);
    for (const PageArea& area : page.areas) {
        set_color(cairo, area.color);
        cairo_rectangle(cairo, area.at.x, area.at.y, area.size.x, area.size.y);
        cairo_fill(cairo);
    }
    draw_lines(page.lines);
    for (const PageText& text : page.texts) {
        set_color(cairo, text.color);
        set_font(cairo, text.points, text.bold);
        const double size = text.points / kPointsOfMillimeter;
        cairo_move_to(cairo, text.at.x - text.anchor.x * advance_of(cairo, text.text),
                      text.at.y + (text.anchor.y * kLineOfText - kBelowBaseline) * size);
        cairo_show_text(cairo, text.text.c_str());
    }
    expect_good(cairo_status(cairo));
}

template <class Function>
void guarded_page(std::string& error, const Function& function) {
    try {
        function();
    } catch (const std::exception& caught) {
        error = caught.what();
    }
}

cairo_status_t append(void* to, const unsigned char* data, unsigned int size) {
    auto* const bytes = static_cast<std::vector<std::byte>*>(to);
    const auto* const from = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), from, from + size);
    return CAIRO_STATUS_SUCCESS;
}

} // namespace

extern "C" __attribute__((visibility("default"))) void
isochron_page_pdf(const Page& page, std::vector<std::byte>& bytes, std::string& error) {
    guarded_page(error, [&] {
        const Surface surface(cairo_pdf_surface_create_for_stream(
            append, &bytes, kPointsOfMillimeter * page.size.x, kPointsOfMillimeter * page.size.y));
        // So that its entries are no part of a packed stream.
        cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "isochron");
        // A figure has equal bytes at any time.
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_KEYWORDS,
                                       page.note.c_str());
        {
            const Cairo cairo(cairo_create(surface.get()));
            cairo_scale(cairo.get(), kPointsOfMillimeter, kPointsOfMillimeter);
            draw(cairo.get(), page);
            cairo_show_page(cairo.get());
        }
        cairo_surface_finish(surface.get());
        expect_good(cairo_surface_status(surface.get()));
    });
}

extern "C" __attribute__((visibility("default"))) void
isochron_page_pixels(const Page& page, double dpi, render::Image& image, std::string& error) {
    guarded_page(error, [&] {
        const double scale = dpi / 25.4;
        image.width = static_cast<int>(std::lround(scale * page.size.x));
        image.height = static_cast<int>(std::lround(scale * page.size.y));
        image.dpi = dpi;
        const Surface surface(
            cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
        expect_good(cairo_surface_status(surface.get()));
        {
            const Cairo cairo(cairo_create(surface.get()));
            set_color(cairo.get(), glm::dvec3(1.0));
            cairo_paint(cairo.get());
            cairo_scale(cairo.get(), scale, scale);
            draw(cairo.get(), page);
        }
        cairo_surface_flush(surface.get());
        const std::uint8_t* const from = cairo_image_surface_get_data(surface.get());
        const int stride = cairo_image_surface_get_stride(surface.get());
        image.rgba.reserve(std::size_t{4} * image.width * image.height);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const std::uint32_t pixel =
                    reinterpret_cast<const std::uint32_t*>(from + std::ptrdiff_t{y} * stride)[x];
                for (const int shift : {16, 8, 0})
                    image.rgba.push_back(static_cast<std::uint8_t>(pixel >> shift));
                image.rgba.push_back(255);
            }
    });
}

extern "C" __attribute__((visibility("default"))) double
isochron_page_width(const std::string& text, double points, bool bold, std::string& error) {
    double width = 0;
    guarded_page(error, [&] {
        const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
        const Cairo cairo(cairo_create(surface.get()));
        cairo_scale(cairo.get(), kPointsOfMillimeter, kPointsOfMillimeter);
        set_font(cairo.get(), points, bold);
        width = advance_of(cairo.get(), text);
        expect_good(cairo_status(cairo.get()));
    });
    return width;
}

} // namespace isochron::app
