// docs/LIMITS.md names the test of each promise and the code of each number: all of them are there, and
// each bound that export, info and build print is among the numbers.
#include "tests/house/source_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace isochron::house {
namespace {

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> tests_in(const std::filesystem::path& root) {
    static const std::regex kTest(R"(\nTEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
    std::set<std::string> names;
    for (const std::string& source : sources(root, "tests")) {
        const std::string text = read_text(root / source);
        for (std::sregex_iterator found(text.begin(), text.end(), kTest), end; found != end;
             ++found)
            names.insert((*found)[1].str() + "." + (*found)[2].str());
    }
    return names;
}

/// `Suite.Name` between backquotes in the page of limits; fuzzers and files look different.
std::set<std::string> tests_named(const std::string& page) {
    static const std::regex kName(R"(`([A-Z]\w+\.[A-Z]\w+)`)");
    std::set<std::string> names;
    for (std::sregex_iterator found(page.begin(), page.end(), kName), end; found != end; ++found)
        names.insert((*found)[1].str());
    return names;
}

TEST(Limits, EveryTestThatTheyNameIsThere) {
    const std::set<std::string> there = tests_in(checkout());
    const std::set<std::string> named = tests_named(read_text(checkout() / "docs/LIMITS.md"));
    EXPECT_GT(named.size(), 40u);
    for (const std::string& name : named)
        EXPECT_TRUE(there.contains(name)) << name;
    EXPECT_FALSE(there.contains("Limits.ATestThatIsNotThere"));
}

/// A row of the table of numbers: what is stated, by whom, the code's file, the test.
using Row = std::array<std::string, 4>;

std::vector<Row> numbers_stated(const std::string& page) {
    std::vector<Row> rows;
    std::istringstream lines(page.substr(page.find("\n## Numbers that are stated\n") + 1));
    std::string line;
    std::getline(lines, line); // the heading itself
    while (std::getline(lines, line) && !line.starts_with("## ")) {
        static const std::regex kRow(R"(\| (.*) \| (.*) \| `([^`]*)` \| `([^`]*)` \|)");
        if (std::smatch found; std::regex_match(line, found, kRow))
            rows.push_back({found[1], found[2], found[3], found[4]});
    }
    return rows;
}

/// Literals that stand behind each other in a source, as one text, with N for each value.
std::vector<std::string> texts_in(const std::string& source) {
    static const std::regex kLiterals(R"("(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*)");
    static const std::regex kSeam(R"("\s*")"), kValue(R"(\{[^}]*\})");
    std::vector<std::string> texts;
    for (std::sregex_iterator found(source.begin(), source.end(), kLiterals), end; found != end;
         ++found)
        texts.push_back(
            std::regex_replace(std::regex_replace(found->str(), kSeam, ""), kValue, "N"));
    return texts;
}

/// Bounds in texts of a source that no phrase covers, each as its text.
std::vector<std::string> bounds_beside(const std::string& source,
                                       const std::vector<std::string>& phrases) {
    static const std::regex kBound(
        R"(\b(?:at most|within|up to|no more than|less than|by at most) (?:N\b|[0-9])|[0-9N] at most|at most[,"])");
    std::vector<std::string> left;
    for (const std::string& text : texts_in(source))
        for (std::sregex_iterator found(text.begin(), text.end(), kBound), end; found != end;
             ++found) {
            const auto at = static_cast<std::size_t>(found->position());
            const bool covered = std::ranges::any_of(phrases, [&](const std::string& phrase) {
                for (std::size_t from = text.find(phrase); from != text.npos;
                     from = text.find(phrase, from + 1))
                    if (from <= at && at < from + phrase.size())
                        return true;
                return false;
            });
            if (!covered)
                left.push_back(text);
        }
    return left;
}

std::vector<std::string> phrases_of(const std::vector<Row>& rows) {
    static const std::regex kPhrase("`([^`]*)`");
    std::vector<std::string> phrases;
    for (const Row& row : rows)
        for (std::sregex_iterator found(row[0].begin(), row[0].end(), kPhrase), end; found != end;
             ++found)
            phrases.push_back((*found)[1]);
    return phrases;
}

TEST(Limits, EachNumberThatIsStatedHasItsCodeAndItsTest) {
    const std::set<std::string> there = tests_in(checkout());
    const std::vector<Row> rows = numbers_stated(read_text(checkout() / "docs/LIMITS.md"));
    EXPECT_GT(rows.size(), 15u);
    for (const Row& row : rows) {
        EXPECT_TRUE(std::filesystem::is_regular_file(checkout() / row[2])) << row[2];
        EXPECT_TRUE(there.contains(row[3])) << row[3];
    }
}

/// Numbers with their units, as `65,537`, `2^35` or `8 million`, in cells of a table below a heading.
std::set<std::string> limits_of_table(const std::string& page, const std::string& heading) {
    static const std::regex kNumber(R"([ (](2\^[0-9]+|[0-9][0-9,]*(?: million)?)(?![0-9^]|,[0-9]))");
    const std::size_t begin = page.find("\n" + heading + "\n"), end = page.find("\n## ", begin + 1);
    std::set<std::string> limits;
    std::istringstream lines(page.substr(begin, end - begin));
    for (std::string line; std::getline(lines, line);) {
        const bool is_tried = line.find(" were tried") != line.npos;
        for (std::sregex_iterator found(line.begin(), line.end(), kNumber), last;
             line.starts_with("| ") && !is_tried && found != last; ++found)
            limits.insert((*found)[1]);
    }
    return limits;
}

TEST(Limits, EachLimitOfSizeInTheGuideIsANumberThatIsStated) {
    std::string stated;
    for (const Row& row : numbers_stated(read_text(checkout() / "docs/LIMITS.md")))
        stated += row[0] + "\n";
    const auto limits =
        limits_of_table(read_text(checkout() / "docs/guide/limits.md"), "## How large");
    EXPECT_GT(limits.size(), 5u);
    for (const std::string& limit : limits)
        EXPECT_NE(stated.find(limit), stated.npos) << limit;
    EXPECT_THAT(
        limits_of_table("\n## A\n| x | 2^35, 17 of 2048^3 was tried |\n## B\n| 3 |", "## A"),
        testing::ElementsAre("17", "2^35"));
}

TEST(Limits, EachBoundThatIsPrintedIsANumberThatIsStated) {
    const std::vector<std::string> phrases =
        phrases_of(numbers_stated(read_text(checkout() / "docs/LIMITS.md")));
    for (const char* source : {"app/commands/command_export.cpp", "app/commands/mesh_cuts.cpp",
                               "app/commands/command_info.cpp", "app/commands/command_build.cpp",
                               "app/indexing/index_report.cpp", "app/indexing/series_report.cpp",
                               "app/indexing/open_index.cpp", "app/output/export_request.cpp"}) {
        ASSERT_TRUE(std::filesystem::is_regular_file(checkout() / source)) << source;
        EXPECT_THAT(bounds_beside(read_text(checkout() / source), phrases), testing::IsEmpty())
            << source;
    }
    EXPECT_THAT(
        bounds_beside("f(\"off by \"\n  \"at most {:.2g} m\"); // at most 3", {"at most 2"}),
        testing::ElementsAre("\"off by at most N m\""));
    EXPECT_THAT(bounds_beside("f(\"off by at most {} m\")", {"off by at most N"}),
                testing::IsEmpty());
}

} // namespace
} // namespace isochron::house
