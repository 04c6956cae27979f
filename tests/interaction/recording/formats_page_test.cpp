// docs/FORMATS.md describes every key of `commands` in a recording, and no other.
#include "interaction/command_fields.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace isochron::interaction {
namespace {

/// What the page says to each key: the rows `| `key` | meaning |` below a heading.
std::map<std::string, std::string> rows_below(std::istream& page, const std::string& heading) {
    std::map<std::string, std::string> rows;
    std::string line;
    while (std::getline(page, line) && line != heading) {
    }
    while (std::getline(page, line) && !line.starts_with("#")) {
        const auto end = line.find("` | ");
        if (!line.starts_with("| `") || end == std::string::npos)
            continue;
        EXPECT_TRUE(rows.emplace(line.substr(3, end - 3), line.substr(end + 4)).second)
            << "twice: " << line;
    }
    return rows;
}

template <class T>
struct Inner {
    using Type = T;
};
template <class T>
struct Inner<std::optional<T>> : Inner<T> {};
template <class T>
struct Inner<std::vector<T>> : Inner<T> {};
template <>
struct Inner<Mark> : Inner<MarkedPoint> {};

/// The keys of commands, and behind each those of the parts that it holds.
std::map<std::string, std::vector<std::string>> keys_of_commands() {
    std::map<std::string, std::vector<std::string>> keys;
    Commands commands;
    each_field(
        [&]<class T>(const Field& field, const T&) {
            auto& parts = keys[field.key];
            typename Inner<T>::Type part{};
            if constexpr (requires { each_field([](const Field&, auto&) {}, part); })
                each_field([&](const Field& inner, auto&) { parts.emplace_back(inner.key); }, part);
        },
        commands);
    return keys;
}

TEST(FormatsPage, TellsEveryKeyOfCommandsAndNoOther) {
    std::ifstream page(test_support::source_root() + "/docs/FORMATS.md");
    auto rows = rows_below(page, "### Commands");
    for (const auto& [key, parts] : keys_of_commands()) {
        ASSERT_TRUE(rows.contains(key)) << key << " has no row in docs/FORMATS.md";
        for (const std::string& part : parts)
            EXPECT_THAT(rows[key], testing::HasSubstr("`" + part + "`")) << "in the row of " << key;
        rows.erase(key);
    }
    for (const auto& [key, meaning] : rows)
        ADD_FAILURE() << "docs/FORMATS.md has a row for " << key << ", which commands do not hold";
}

TEST(FormatsPage, TheKeysOfPartsAreLookedFor) {
    const auto keys = keys_of_commands();
    EXPECT_EQ(keys.at("isosurfaces"),
              (std::vector<std::string>{"isovalue", "color", "opacity", "array"}));
    EXPECT_EQ(keys.at("mark"), (std::vector<std::string>{"position", "step", "value", "fraction",
                                                         "array", "unit",
                                        "shown"}));
    EXPECT_EQ(keys.at("stamps"), std::vector<std::string>{});
}

TEST(FormatsPage, AxesOfVersion01AreStillRead) {
    for (const bool shown : {false, true}) {
        Commands expected;
        expected.bounding_box = shown;
        EXPECT_EQ(commands_from({{"bounding_box", shown}}, "commands"), expected);
        EXPECT_EQ(commands_from({{"axes", shown}}, "commands"), expected);
        EXPECT_EQ(commands_json(expected).count("axes"), 0u);
    }
}

TEST(FormatsPage, AnInstantIsAStepAndItsFraction) {
    using nlohmann::json;
    const auto read = [](const json& text) {
        return commands_from(json::parse(text.dump()), "commands");
    };
    Commands expected;
    expected.instant = Instant(3, 77);
    EXPECT_EQ(read({{"step", 3}, {"fraction", 77}}), expected);
    EXPECT_EQ(commands_json(expected), json({{"step", 3}, {"fraction", 77}}));
    expected.instant = Instant(3);
    EXPECT_EQ(read({{"step", 3}}), expected);
    Commands alone;
    alone.fraction = 77;
    EXPECT_EQ(read({{"fraction", 77}}), alone);
    EXPECT_EQ(commands_json(alone), json({{"fraction", 77}}));
    EXPECT_THROW(read({{"step", 3}, {"fraction", 65536}}), interaction::Error);
}

TEST(FormatsPage, AMarkOfOlderRecordingsIsAtAStepItself) {
    const auto old = nlohmann::json::parse(R"({"position":[1,2.5,-3],"step":3,"value":9.25})");
    Commands expected;
    expected.mark = Mark{MarkedPoint{{1, 2.5, -3}, Instant(3), 9.25}};
    EXPECT_EQ(commands_from({{"mark", old}}, "commands"), expected);
    expected.mark->point->instant.fraction = 16384;
    EXPECT_EQ(commands_json(expected).at("mark").at("fraction"), 16384);
    EXPECT_EQ(commands_from(commands_json(expected), "commands"), expected);
    nlohmann::json wrong = old;
    wrong["fraction"] = 65536u;
    EXPECT_THROW(commands_from({{"mark", wrong}}, "commands"), interaction::Error);
}

TEST(FormatsPage, RowsAreThoseBelowTheHeading) {
    std::istringstream page("| `no` | before |\n### Commands\n| key | meaning |\n|---|---|\n"
                            "| `step` | the step |\n## Next\n| `no` | behind |\n");
    EXPECT_EQ(rows_below(page, "### Commands"),
              (std::map<std::string, std::string>{{"step", "the step |"}}));
}

} // namespace
} // namespace isochron::interaction
