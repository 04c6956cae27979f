// Pages for print, through the module that cairo is in.
#include "app/output/page.h"

#include "index/error.h"
#include "index/system/input_file.h"
#include "index/system/module.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

namespace isochron::app {
namespace {

template <class Function>
Function* page_function(const char* name, const std::string& about) {
    try {
        index::file_of_program("libisochron_pages.so");
    } catch (const index::Error&) {
        throw index::Error(fmt::format("{}: figures are drawn by cairo, which this program was "
                                       "built without (Debian: apt install libcairo2-dev, and "
                                       "build it again)",
                                       about));
    }
    try {
        return reinterpret_cast<Function*>(index::module_symbol("isochron_pages", name));
    } catch (const index::Error& error) {
        throw index::Error(fmt::format("{}: figures are drawn by cairo (Debian: apt install "
                                       "libcairo2): {}",
                                       about, error.what()));
    }
}

void expect_done(const std::string& error, const std::string& about) {
    if (!error.empty())
        throw index::Error(fmt::format("{}: {}", about, error));
}

/// The keywords of a PDF of cairo; empty: it has none.
std::string note_in_pdf(const std::string& bytes) {
    constexpr std::string_view kKey = "/Keywords (";
    std::size_t at = bytes.rfind(kKey);
    if (!bytes.starts_with("%PDF-") || at == std::string::npos)
        return {};
    std::string note;
    for (at += kKey.size(); at < bytes.size() && bytes[at] != ')'; ++at) {
        if (bytes[at] == '\\' && at + 1 < bytes.size())
            ++at;
        note += bytes[at];
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
