// What the figures of the first page are made with: lines of text, sources, bars.
#pragma once

#include "tests/bench/pages/header.h"
#include "tests/bench/pages/page_figure.h"
#include "tests/bench/pages/short_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace isochron::bench {

/// All lines that match a pattern, each with its groups.
inline std::vector<std::smatch> lines_like(const std::vector<std::string>& lines,
                                           const char* pattern) {
    const std::regex wanted(pattern);
    std::vector<std::smatch> found;
    for (const std::string& line : lines)
        if (std::smatch match; std::regex_search(line, match, wanted))
            found.push_back(std::move(match));
    return found;
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

inline double number(const std::smatch& match, std::size_t group) {
    return std::stod(match[group].str());
}

inline std::string source_of(const std::string& file, const Header& header) {
    return fmt::format("`{}`, commit {}, {}, {} threads, {}", file, header.commit, header.processor,
                       header.threads, header.date);
}

/// The machine of what a benchmark printed: its first line that names a commit.
inline std::string source_of(const std::string& file, const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
        if (line.starts_with("commit "))
            return fmt::format("`{}`, {}", file, line);
    return fmt::format("`{}`", file);
}

inline Bar milliseconds(std::string label, double value, bool ours) {
    return {std::move(label), value, short_number(value) + " ms", ours};
}

/// The least and the largest value of some bars, as people read them.
inline std::string range_of(const std::vector<Bar>& bars) {
    const auto [low, high] = std::ranges::minmax_element(bars, {}, &Bar::value);
    return low->text == high->text ? low->text : low->text + " to " + high->text;
}

/// Adds the figures on pictures and frames whose results are there.
void add_frame_figures(const FirstPageInput& input, std::vector<PageFigure>& figures);

} // namespace isochron::bench
