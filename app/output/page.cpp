// Pages for print, through the module that cairo is in.
#include "app/output/page.h"

#include "index/error.h"
#include "index/system/input_file.h"
#include "index/system/module.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <string_view>

namespace isochron::app {
namespace {

template <class Function>
Function* page_function(const char* name, const std::string& about) {
    try {
        return reinterpret_cast<Function*>(index::module_symbol("isochron_pages", name));
    } catch (const index::Error& error) {
        throw index::Error("{}: figures are drawn by cairo (Debian: apt install libcairo2): {}",
                           about, error.what());
    }
}

void expect_done(const std::string& error, const std::string& about) {
    if (!error.empty())
        throw index::Error("{}: {}", about, error);
}

/// The keywords of a PDF of cairo; empty: it has none.
std::string note_in_pdf(const std::string& bytes) {
    constexpr std::string_view kKey = "/Keywords ";
    const std::size_t key = bytes.rfind(kKey);
    if (!bytes.starts_with("%PDF-") || key == std::string::npos)
        return {};
    // As cairo writes it: plain, or as UTF-16 in hexadecimal digits where a backslash is in it.
    const std::string_view rest = std::string_view(bytes).substr(key + kKey.size());
    constexpr std::string_view kWide = "<FEFF";
    constexpr std::size_t kDigits = 4; // digits of a character
    if (!rest.starts_with(kWide))
        return std::string(rest.substr(1, rest.find(')') - 1));
    std::string note;
    for (std::size_t at = kWide.size(); at + kDigits <= rest.size() && rest[at] != '>';
         at += kDigits) {
        unsigned character = 0;
        std::from_chars(rest.data() + at, rest.data() + at + kDigits, character, 16);
        note += static_cast<char>(character);
    }
    return note;
}

} // namespace

double width_of_text(const std::string& text, double points, bool bold) {
    static auto* const width = page_function<page_module::Width>(page_module::kWidth, "a figure");
    std::string error;
    const double millimeters = width(text, points, bold, error);
    expect_done(error, "a figure");
    return millimeters;
}

std::vector<std::byte> pdf_of(const Page& page, const std::filesystem::path& path) {
    std::vector<std::byte> bytes;
    std::string error;
    page_function<page_module::Pdf>(page_module::kPdf, path.string())(page, bytes, error);
    expect_done(error, path.string());
    return bytes;
}

render::Image pixels_of(const Page& page, double dpi, const std::filesystem::path& path) {
    render::Image image;
    std::string error;
    page_function<page_module::Pixels>(page_module::kPixels, path.string())(page, dpi, image,
                                                                            error);
    expect_done(error, path.string());
    return image;
}

std::string figure_note_in(const std::filesystem::path& file) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 34;
    const std::string note = stereo::is_picture_name(file)
                                 ? stereo::read_note(file)
                                 : note_in_pdf(index::read_text(file, kMost));
    const bool is_figure =
        note.find(fmt::format("\"format\":\"{}\"", kFigureFormat)) != std::string::npos;
    return is_figure ? note : "";
}

} // namespace isochron::app
