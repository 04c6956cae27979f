// A figure as a file describes it: a page with one to four panels.
#pragma once

#include "interaction/commands.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// A picture with what stands around it.
struct FigurePanel {
    std::string index;                          ///< path of an index, from the figure's folder
    std::optional<interaction::Commands> state; ///< state of a session; empty: the first look
    interaction::KeyFrame key;                  ///< what is shown differently
    std::optional<std::string> title;           ///< none: array, isovalues and time
    double aspect = 0.8;                        ///< height of the picture, in widths
    double turn = 0, tilt = 0; ///< [rad] of the data, to the right and towards the viewer
    double zoom = 1;
    bool legend = true, scale_bar = true, axes = true;
    int line = 0; ///< line of its table in the file
};

struct FigureFile {
    double width = 180;   ///< [mm] of the page
    double dpi = 300;     ///< resolution of its pictures, and of a PNG or TIFF
    double font_size = 8; ///< [pt]
    double margin = 2;    ///< [mm] on each side
    double gap = 4;       ///< [mm] between panels
    int version = 1;
    unsigned columns = 0;      ///< panels beside each other; 0: two, of an only one one
    std::string letters = "a"; ///< `a`, `A`, `(a)` or `none`
    std::string caption;
    std::vector<FigurePanel> panels;
    std::string text;                         ///< the whole file
    std::map<std::string, std::string> texts; ///< sessions and files of keys, by their names in it
};

inline constexpr std::size_t kMostPanels = 4;

/// @param name of the file, for messages; relative names count from its folder
/// @param texts of sessions and files of keys, which are read from files where they are not here
/// @throws ConfigError, interaction::Error, index::Error naming file, line and key
FigureFile parse_figure(const std::string& text, const std::filesystem::path& name,
                        std::map<std::string, std::string> texts = {});
/// @throws as `parse_figure`
FigureFile read_figure(const std::filesystem::path& file);

} // namespace isochron::app
