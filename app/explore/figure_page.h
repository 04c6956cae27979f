// Draws the panels of a figure, and lays out its page.
#pragma once

#include "app/explore/figure_file.h"
#include "app/output/page.h"
#include "stereo/context/gl_context.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace isochron::app {

/// What a figure was made of, for `reproduce`.
struct FigureRecord {
    std::string program, drawn_with;
    std::string text;                         ///< the file that describes it
    std::map<std::string, std::string> texts; ///< as `FigureFile::texts`
    /// For each panel: file name of its index without its folder, and the hash of its data.
    std::vector<std::string> data, hashes;
};

/// One line of ASCII, and back. @throws interaction::Error: it is none
std::string text_of(const FigureRecord& record);
FigureRecord figure_record_from(const std::string& text);
struct MadeFigure {
    Page page; ///< with its record as the note
    FigureRecord record;
    std::vector<std::filesystem::path> data; ///< for each panel
};

/// @param name of the file that describes the figure, for messages
/// @param data the index of each panel
/// @throws index::Error, interaction::Error naming file, line and what does not fit the data
MadeFigure make_figure(const FigureFile& figure, const std::filesystem::path& name,
                       const std::vector<std::filesystem::path>& data, stereo::ContextKind context);

/// The bytes of the figure's file, whose extension says the format: .pdf, .png, .tif or .tiff.
std::vector<std::byte> figure_bytes(const MadeFigure& made, double dpi,
                                    const std::filesystem::path& file);

} // namespace isochron::app
