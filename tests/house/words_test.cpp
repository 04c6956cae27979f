// Words: those of the developers' table are each said once and used in the file that their row names,
// and comments name what they speak of.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

std::string text_in(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string in_lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// A row of the table: `| word | meaning | file |`.
struct WordRow {
    std::string word, meaning, files;
};

/// The rows of the page's table of words, without its heading.
std::vector<WordRow> words_of(const std::string& page) {
    static const std::regex kRow(R"(^\| ([^|]+) \| ([^|]+) \| ([^|]+) \|$)");
    std::istringstream lines(page.substr(std::min(page.find("\n## Words\n"), page.size())));
    std::vector<WordRow> rows;
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    for (; std::getline(lines, line) && !line.starts_with("## ");)
        if (std::smatch match; std::regex_match(line, match, kRow) && match[1] != "word")
            rows.push_back({match[1], match[2], match[3]});
    return rows;
}

/// What is wrong with the table: words said twice, words that their files do not use.
std::vector<std::string> findings_in_words(const std::filesystem::path& root,
                                           const std::string& page) {
    static const std::regex kFile(R"(`([\w/]+\.h)`)");
    const std::vector<WordRow> rows = words_of(page);
    std::vector<std::string> findings;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].word.find(',') != std::string::npos)
            findings.push_back(rows[i].word + ": several words in one row");
        for (std::size_t other = 0; other < i; ++other)
            if (rows[other].word == rows[i].word)
                findings.push_back(rows[i].word + ": said twice");
        std::smatch match;
        const bool named = std::regex_search(rows[i].files, match, kFile);
        const std::string text =
            named ? in_lower_case(match[1].str() + text_in(root / match[1].str())) : std::string();
        std::istringstream parts(in_lower_case(rows[i].word));
        for (std::string part; parts >> part;)
            if (text.find(part) == std::string::npos) {
                findings.push_back(rows[i].word + ": not used in the file that is named");
                break;
            }
    }
    return findings;
}

TEST(Words, OfTheArchitectureAreUsedWhereTheyAreNamed) {
    const std::string page = text_in(checkout() / "docs/ARCHITECTURE.md");
    EXPECT_GT(words_of(page).size(), 30u);
    EXPECT_EQ(findings_in_words(checkout(), page), std::vector<std::string>{});
}

TEST(Words, SaidTwiceOrNowhereUsedAreFound) {
    const PlantedTree tree;
    tree.plant("index/grid.h", "/// A cell, and the index space.\n");
    const std::string page = "# Page\n\n## Words\n\n| word | meaning | where |\n|---|---|---|\n"
                             "| cell | a box | `index/grid.h` |\n"
                             "| index space | counts | `index/grid.h` |\n"
                             "| cell | a battery | `index/grid.h` |\n"
                             "| brick | a block | `index/grid.h` |\n"
                             "| tile, cell | two | `index/grid.h` |\n\n## Next\n\n"
                             "| other | table | `index/none.h` |\n";
    EXPECT_EQ(
        findings_in_words(tree.root(), page),
        (std::vector<std::string>{"cell: said twice", "brick: not used in the file that is named",
                                  "tile, cell: several words in one row",
                                  "tile, cell: not used in the file that is named"}));
}

/// Comments that leave out their noun: what they speak of would have to be found in the line before.
/// A comment that goes on below has the marker in its column.
std::vector<std::string> comments_without_noun(const std::filesystem::path& root) {
    std::vector<std::string> found;
    for (const char* folder : {"index", "interaction", "render", "stereo", "app", "tests"})
        for (const std::string& source : sources(root, folder)) {
            std::ifstream file(root / source);
            std::string line;
            std::size_t before = line.npos; // column of the comment in the line before
            for (int number = 1; std::getline(file, line); ++number) {
                const std::size_t at = line.find("//");
                const bool in_text = std::ranges::count(line.substr(0, at), '"') % 2 != 0;
                const std::size_t column = in_text ? line.npos : at;
                const bool goes_on = column != line.npos && column == before &&
                                     line.find_first_not_of(' ') == column;
                before = column;
                if (column == line.npos || goes_on)
                    continue;
                const std::size_t words = line.find_first_not_of("/<! ", column);
                for (const char* none : {"Of ", "of ", "The same ", "the same ", "Likewise"})
                    if (words != line.npos && line.compare(words, std::strlen(none), none) == 0)
                        found.push_back(source + ":" + std::to_string(number));
            }
        }
    return found;
}

/// Sources with words by which axes are recognized, besides the one that makes axes of them.
std::vector<std::string> other_sources_of_axes(const std::filesystem::path& root) {
    static const std::regex kWord(
        R"_("(latitude|longitude|n?l(at|on)|degrees?_?(north|east|[ne])|south_north|west_east|)_"
        R"_(bottom_top|p?lev|projection_[xy]_coordinate|realization|n[xyz])")_");
    std::vector<std::string> found;
    for (const std::string& source : sources(root, "index"))
        if (source != "index/readers/formats/stated/axis_roles.cpp" &&
            std::regex_search(in_lower_case(text_in(root / source)), kWord))
            found.push_back(source);
    return found;
}

TEST(Words, OfAxesAndTheirUnitsStandInOneFile) {
    EXPECT_EQ(other_sources_of_axes(checkout()), std::vector<std::string>{})
        << "a format fills the record of what is stated; stated/axis_roles.cpp knows the words";
    const PlantedTree tree;
    tree.plant("index/readers/format.cpp", "if (unit == \"degrees_North\")\n");
    tree.plant("index/readers/formats/stated/axis_roles.cpp", "\"degrees_north\", \"lat\"\n");
    tree.plant("index/other.cpp", "// degrees_north is no string\n");
    EXPECT_EQ(other_sources_of_axes(tree.root()),
              std::vector<std::string>{"index/readers/format.cpp"});
}

TEST(Words, NoCommentLeavesOutItsNoun) {
    EXPECT_EQ(comments_without_noun(checkout()), std::vector<std::string>{})
        << "say `size of the picture` instead of `of the picture`, and what it is instead of `the "
           "same`";
}

TEST(Words, ACommentWithoutItsNounIsFound) {
    const PlantedTree tree;
    tree.plant("index/bad.h", "/// Of a file: its bytes.\nint size; ///< of the file\n"
                              "/// The same for two.\nint two;\n");
    tree.plant("index/good.h", "/// The bytes\n/// of a file.\nint size; ///< size of the file\n");
    EXPECT_EQ(comments_without_noun(tree.root()),
              (std::vector<std::string>{"index/bad.h:1", "index/bad.h:2", "index/bad.h:3"}));
}

} // namespace
} // namespace isochron::house
