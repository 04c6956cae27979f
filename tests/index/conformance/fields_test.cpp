// Nothing that a file states is ignored: the guide says of every field of the standards whether it is read
// or noted, and a file with the field set to something unusual shows it.
#include "index/readers/formats/open_series.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <iterator>
#include <map>
#include <sstream>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// By format and field, `read`, `noted` or `skipped`.
using FieldTable = std::map<std::pair<std::string, std::string>, std::string>;

FieldTable fields_of_the_guide() {
    std::istringstream page(read_file(fs::path(test_support::source_root()) / "docs/FIELDS.md"));
    FieldTable fields;
    std::string format;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## "))
            format = line.substr(3);
        if (!line.starts_with("| `"))
            continue;
        const std::size_t end = line.find("` | ");
        const std::string field = line.substr(3, end - 3), rest = line.substr(end + 4);
        EXPECT_TRUE(fields.emplace(std::pair(format, field), rest.substr(0, rest.find(' '))).second)
            << format << ": " << field << " twice";
    }
    return fields;
}

/// All that a user gets of a file.
struct Got {
    std::string refusal; ///< why it cannot be read
    std::vector<std::byte> values;
    SeriesInfo info;
};

Got got_of(const fs::path& file, const json& options) {
    Got got;
    ReadOptions read;
    if (options.contains("component"))
        read.component = options["component"];
    if (options.contains("array"))
        read.array = options["array"];
    if (options.contains("resample"))
        read.resample = options["resample"].get<std::array<std::uint32_t, 3>>();
    try {
        const auto series = open_series({file}, read);
        got.info = series->info();
        std::vector<std::byte> step(got.info.step_bytes());
        for (std::size_t i = 0; i < got.info.steps(); ++i) {
            series->read(i, step);
            got.values.insert(got.values.end(), step.begin(), step.end());
        }
    } catch (const Error& error) {
        got.refusal = error.what();
    }
    return got;
}

/// But for notes.
bool same(const Got& a, const Got& b) {
    const SeriesInfo &x = a.info, &y = b.info;
    return a.refusal == b.refusal && a.values == b.values && x.grid == y.grid &&
           x.times == y.times && x.time_unit == y.time_unit && x.length_unit == y.length_unit &&
           x.value_unit == y.value_unit && x.scaling == y.scaling && x.type == y.type &&
           x.anatomy == y.anatomy && x.axis_names == y.axis_names && x.array == y.array;
}

/// Checks that the second of two files gives something else, or has a note more.
void expect_said(const std::string& said, const json& pair, const fs::path& folder) {
    const Got plain = got_of(folder / std::string(pair["plain"]), pair["options"]);
    const Got changed = got_of(folder / std::string(pair["changed"]), pair["options"]);
    EXPECT_EQ(plain.refusal, "");
    EXPECT_EQ(changed.refusal.find('\n'), std::string::npos) << changed.refusal;
    if (said == "read") {
        EXPECT_EQ(!changed.refusal.empty(), pair["refused"].get<bool>()) << changed.refusal;
        EXPECT_EQ(same(plain, changed), pair["same"].get<bool>()) << changed.refusal;
        return;
    }
    EXPECT_EQ(changed.refusal, "");
    if (said == "skipped") {
        EXPECT_TRUE(same(plain, changed));
        EXPECT_EQ(plain.info.notes, changed.info.notes);
        return;
    }
    ASSERT_EQ(said, "noted");
    std::vector<std::string> more = changed.info.notes;
    std::erase_if(more, [&](const std::string& note) {
        return std::ranges::find(plain.info.notes, note) != plain.info.notes.end();
    });
    EXPECT_THAT(more, testing::Contains(testing::AnyOf(testing::HasSubstr("stated and not used"),
                                                       testing::HasSubstr("counts as data"))));
}

class StandardFields : public testing::Test {
  protected:
    /// What a script of this folder has written, each pair of files by format and field.
    json made(const std::string& script) const {
        const fs::path source = fs::path(test_support::source_root()) / "tests/index/conformance";
        const fs::path folder = folder_.path() / script;
        fs::create_directory(folder);
        const std::string command =
            fmt::format("PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -W ignore {} {}",
                        (source / (script + ".py")).string(), folder.string());
        EXPECT_EQ(std::system(command.c_str()), 0);
        return json::parse(read_file(folder / "fields.json"));
    }

    TestFolder folder_;
};

TEST_F(StandardFields, AreReadOrNotedAsTheGuideSays) {
    const FieldTable guide = fields_of_the_guide();
    std::size_t seen = 0;
    for (const std::string script : {"fields", "fields_grids"}) {
        const json files = made(script);
        for (const auto& [format, fields] : files.items())
            for (const auto& [field, pair] : fields.items()) {
                SCOPED_TRACE(fmt::format("{}: {}", format, field));
                const auto said = guide.find({format, field});
                ASSERT_NE(said, guide.end()) << "the guide does not have it";
                ++seen;
                expect_said(said->second, pair, folder_.path() / script);
            }
    }
    EXPECT_EQ(seen, guide.size()) << "fields of the guide without a file";
}

TEST(PublicFiles, OfTheTableAreAHundredWithTheirSourcesAndWhatIsInThem) {
    const fs::path folder = fs::path(test_support::source_root()) / "tests/index/conformance";
    std::istringstream table(read_file(folder / "PUBLIC.tsv"));
    std::size_t files = 0;
    for (std::string line; std::getline(table, line);) {
        if (line.starts_with('#'))
            continue;
        ++files;
        SCOPED_TRACE(line);
        std::istringstream row(line);
        std::vector<std::string> columns;
        for (std::string column; std::getline(row, column, '\t');)
            columns.push_back(column);
        ASSERT_EQ(columns.size(), 10u);
        EXPECT_EQ(columns[1].size(), 40u) << "a commit";
        const auto words = [&](std::size_t column) {
            std::istringstream text(columns[column]);
            return std::distance(std::istream_iterator<std::string>(text), {});
        };
        if (columns[5] == "refused")
            EXPECT_NE(columns[6], "-");
        else
            EXPECT_EQ(words(5) * 100 + words(8) * 10 + words(9), 333)
                << "vertices, isovalues, cells";
    }
    EXPECT_GE(files, 100u);
}

} // namespace
} // namespace isochron::index
