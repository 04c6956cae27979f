// The developers' table of words: few of them, each said once, and each used in the file that its row names.
#include "tests/house/source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
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

/// What is wrong with the table: too many words, words said twice, words that their files do not use.
std::vector<std::string> findings_in_words(const std::filesystem::path& root,
                                           const std::string& page, std::size_t most) {
    static const std::regex kFile(R"(`([\w/]+\.h)`)");
    const std::vector<WordRow> rows = words_of(page);
    std::vector<std::string> findings;
    if (rows.size() > most)
        findings.push_back(std::to_string(rows.size()) + " words");
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

TEST(Words, OfTheArchitectureAreAtMostFortyAndUsedWhereTheyAreNamed) {
    const std::string page = text_in(checkout() / "docs/ARCHITECTURE.md");
    EXPECT_GT(words_of(page).size(), 30u);
    EXPECT_EQ(findings_in_words(checkout(), page, 40), std::vector<std::string>{});
}

TEST(Words, SaidTwiceTooOftenOrNowhereUsedAreFound) {
    const PlantedTree tree;
    tree.plant("index/grid.h", "/// A cell, and the index space.\n");
    const std::string page = "# Page\n\n## Words\n\n| word | meaning | where |\n|---|---|---|\n"
                             "| cell | a box | `index/grid.h` |\n"
                             "| index space | counts | `index/grid.h` |\n"
                             "| cell | a battery | `index/grid.h` |\n"
                             "| brick | a block | `index/grid.h` |\n"
                             "| tile, cell | two | `index/grid.h` |\n\n## Next\n\n"
                             "| other | table | `index/none.h` |\n";
    EXPECT_EQ(findings_in_words(tree.root(), page, 4),
              (std::vector<std::string>{"5 words", "cell: said twice",
                                        "brick: not used in the file that is named",
                                        "tile, cell: several words in one row",
                                        "tile, cell: not used in the file that is named"}));
}

} // namespace
} // namespace isochron::house
