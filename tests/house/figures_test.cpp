// Figures on the pages for users have a source: a measurement in docs/results, or a constant of the program.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

namespace fs = std::filesystem;

std::string text_of_path(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A figure that is no measurement: a limit or a setting, which a source file holds.
struct KnownConstant {
    std::string page, figure, file, text;
};

const std::vector<KnownConstant>& known_constants() {
    static const std::vector<KnownConstant> constants{
        {"docs/guide/exploring.md", "10 s", "interaction/step_track.h", "kRoundSeconds = 10.0"},
        {"docs/guide/exploring.md", "1 %", "interaction/controls/controls.cpp", "kCoarse = 0.01"},
        {"docs/guide/export.md", "16 MiB", "index/export/exported_mesh.cpp",
         "kMostHeld = std::uint64_t{16} << 20"},
        {"docs/guide/export.md", "128 MiB", "app/commands/command_export.cpp",
         "kMostKept = std::uint64_t{128} << 20"},
        {"docs/guide/headsets.md", "100 ms", "app/quality/frame_quality.h", "kStillAfter{0.1}"},
        {"docs/guide/limits.md", "90 Hz", "tests/bench/pages/results_page.cpp",
         "a display of 90 Hz"},
        {"docs/guide/tracking.md", "2 %", "interaction/trackers/calibration.cpp",
         "kNearlyOrthogonal = 0.02"},
        {"docs/guide/walls.md", "2 %", "app/config/check_config.cpp", "kSquare = 0.02f"}};
    return constants;
}

/// The words of a page: without blocks of commands, code, targets of links, and dois.
std::string words_of_page(const std::string& page) {
    std::string text = std::regex_replace(page, std::regex("```[^`]*```"), "");
    text = std::regex_replace(text, std::regex("`[^`\n]*`"), "");
    text = std::regex_replace(text, std::regex(R"(\]\([^)]*\))"), "]");
    return std::regex_replace(text, std::regex(R"(doi 10\.[^\s\]]*)"), "");
}

/// The figures in a text, one for each number: of `6 / 21 ms` `6 ms` and `21 ms`. Numbers without a
/// unit count if they have three decimals or more.
std::vector<std::string> figures_in(const std::string& text) {
    static const std::regex kFigure(
        R"(((?:\d[\d,.]*(?: %)?(?: / | to ))*\d[\d,.]*) ?(ms|us|s|fps|MiB|GiB|Hz|%)(?![\w])|\d+\.\d{3,})");
    static const std::regex kNumber(R"(\d[\d,]*(?:\.\d+)?)");
    std::vector<std::string> figures;
    for (std::sregex_iterator at(text.begin(), text.end(), kFigure), end; at != end; ++at) {
        const std::string numbers = (*at)[1].matched ? (*at)[1].str() : (*at)[0].str();
        const std::string unit = (*at)[2].matched ? " " + (*at)[2].str() : std::string();
        for (std::sregex_iterator one(numbers.begin(), numbers.end(), kNumber); one != end; ++one)
            figures.push_back(one->str() + unit);
    }
    return figures;
}

/// Whether a text of results holds a figure: `56.3 MiB` also as `56.3 of 1024 MiB`.
bool holds(const std::string& results, const std::string& figure) {
    const std::size_t blank = figure.find(' ');
    std::string number = figure.substr(0, blank), pattern = R"((^|[^\d.]))";
    std::erase(number, ',');
    for (const char digit : number)
        pattern += digit == '.' ? std::string("\\.") : std::string(1, digit);
    pattern += number.find('.') == std::string::npos ? R"((\.0)?)" : "";
    pattern += blank == std::string::npos ? R"((?!\d))" : R"(( of \d+)?)" + figure.substr(blank);
    return std::regex_search(results, std::regex(pattern));
}

/// Figures of pages without a source, as `page: figure`, and constants that are not where they were.
std::vector<std::string> without_source(const fs::path& root, const std::vector<std::string>& pages,
                                        const std::vector<KnownConstant>& constants) {
    std::string results;
    for (const auto& entry : fs::directory_iterator(root / "docs/results"))
        results += text_of_path(entry.path()) + '\n';
    std::vector<std::string> found;
    for (const std::string& page : pages)
        for (const std::string& figure : figures_in(words_of_page(text_of_path(root / page)))) {
            const auto constant = std::ranges::find_if(constants, [&](const KnownConstant& known) {
                return known.page == page && known.figure == figure;
            });
            const bool has_source =
                constant != constants.end()
                    ? text_of_path(root / constant->file).find(constant->text) != std::string::npos
                    : holds(results, figure);
            if (!has_source)
                found.push_back(page + ": " + figure);
        }
    return found;
}

TEST(Figures, OfTheReadmeAndTheGuideHaveASource) {
    std::vector<std::string> pages{"README.md", "docs/README.md"};
    for (const auto& entry : fs::directory_iterator(checkout() / "docs/guide"))
        pages.push_back("docs/guide/" + entry.path().filename().string());
    std::ranges::sort(pages);
    EXPECT_GT(pages.size(), 12u);
    EXPECT_EQ(without_source(checkout(), pages, known_constants()), std::vector<std::string>{});
}

TEST(Figures, WithoutASourceAreFound) {
    const PlantedTree tree;
    tree.plant("docs/results/a.txt", "56.3 of 1024 MiB read, 160 ms; index / data 0.387, 896.0 of "
                                     "1024 MiB\n");
    tree.plant("a.cpp", "constexpr double kSlack = 0.02;\n");
    tree.plant("page.md", "It read 56.3 / 896 MiB in 160 ms, or 161 ms: 0.387, not 0.388. At most "
                          "2 % off, or 3 %.\n`5 ms`, [a page](7 ms), doi 10.1145/1037210\n");
    EXPECT_EQ(
        without_source(tree.root(), {"page.md"},
                       {{"page.md", "2 %", "a.cpp", "0.02"}, {"page.md", "3 %", "a.cpp", "0.03"}}),
        (std::vector<std::string>{"page.md: 161 ms", "page.md: 0.388", "page.md: 3 %"}));
}

} // namespace
} // namespace isochron::house
