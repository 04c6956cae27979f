// Files of stories: what is hostile in them is refused in one line, and what is made of keys is read
// as it was: figures, titles, lines of text.
#include "app/explore/story_file.h"

#include "app/explore/figure_file.h"
#include "app/loop/film_titles.h"
#include "app/loop/seen_figure.h"
#include "app/text.h"
#include "index/error.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/key_film.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/support/indexed.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace isochron::app {
namespace {

using interaction::KeyFrame;

std::string story_about(const std::string& data, const std::string& key = R"("text": "a")") {
    return fmt::format(R"({{"format": "isochron keys", "version": 1, "data": {}, "keys": )"
                       R"([{{"time": 0, {}}}]}})",
                       data, key);
}

class StoryFileTest : public testing::Test {
  protected:
    index::TestField field_{
        {9, 9, 9}, 2, index::ValueType::f32, [](double x, double, double, double) { return x; }};
    test_support::TestFolder folder_;
    std::filesystem::path story_ = folder_.path() / "a b.isochron-story";

    std::string refused(const std::string& text) {
        folder_.write("a b.isochron-story", text);
        try {
            return "opens " + data_of_story(story_);
        } catch (const interaction::Error& error) {
            return error.what();
        } catch (const index::Error& error) {
            return error.what();
        }
    }
};

TEST_F(StoryFileTest, OpensTheIndexBesideItAndNothingElse) {
    const auto index = index::indexed(folder_, field_.view());
    const std::filesystem::path name = std::filesystem::path(index->name()).filename();
    std::filesystem::create_directory(folder_.path() / "in");
    std::filesystem::copy(index->name(), folder_.path() / "in" / name);
    folder_.write("no.isochron", "nothing");
    EXPECT_EQ(refused(story_about(fmt::format("\"{}\"", name.string()))),
              "opens " + (folder_.path() / name).string());
    const std::string in_folder = "expected the name of an index in the same folder";
    struct Row {
        std::string text, words;
    };
    const std::string deep(100, '['), whole = (folder_.path() / name).string();
    for (const auto& [text, words] : std::vector<Row>{
             {story_about("\"in/" + name.string() + "\""), in_folder},
             {story_about("\"./" + name.string() + "\""), in_folder},
             {story_about("\"../" + name.string() + "\""), in_folder},
             {story_about("\"" + whole + "\""), in_folder},
             {story_about(R"("..\\a.isochron")"), in_folder},
             {story_about(R"("..")"), in_folder},
             {story_about(R"("a\u0000.isochron")"), in_folder},
             {story_about(R"("no.isochron")"), "which is none"},
             {story_about(R"("gone.isochron")"), "which is not there"},
             {story_about(R"("in")"), "which is none"},
             {story_about(R"("")"), "it names no data"},
             {story_about("7"), "data: expected a text"},
             {story_about(R"("http://127.0.0.1:9/a.isochron")"), "which nobody has agreed to"},
             {story_about(R"("https://a.example/a.isochron?token=1")"),
              "which nobody has agreed to"},
             {story_about(R"("file:///etc/passwd")"), in_folder},
             {story_about("\"" + name.string() + "\"", R"("step": 1)"), "no story"},
             {story_about("\"" + name.string() + "\"", R"("text": "a", "run": "rm -rf /")"),
              "unknown key \"run\""},
             {story_about("\"" + name.string() + "\"", R"("text": 1)"), "text: expected a text"},
             {story_about("\"" + name.string() + "\"",
                          "\"text\": \"" + std::string(2001, 'a') + "\""),
              "text: expected a text of sensible length"},
             {story_about("\"" + name.string() + "\"", R"("text": "a", "place": [0, 1e999, 0])"),
              "story"},
             {story_about("\"" + name.string() + "\"", R"("text": "a", "place": [0, 1])"), "place"},
             {story_about("\"" + name.string() + "\"",
                          R"("text": "a", "models": [{"path": "/etc/passwd", "shown": true,)"
                          R"("color": [1, 1, 1], "opacity": 1, "lines": false}])"),
              "key 1: models: a story opens no other files"},
             {R"({"format": "isochron keys", "version": 2, "keys": []})", "version"},
             {R"({"format": "isochron keys", "version": 1, "keys": []})", "keys: expected a list"},
             {R"({"format": "isochron keys", "version": 1, "exec": "a", "keys": [{"time": 0}]})",
              "unknown key"},
             {"{}", "not a file of keys"},
             {"", "not a file of keys"},
             {"#!/bin/sh\nrm -rf /\n", "not a file of keys"},
             {deep, "nested deeper"},
             {"\xff\xfe", "not a file of keys"}}) {
        const std::string said = refused(text);
        EXPECT_THAT(said, testing::HasSubstr(words)) << text.substr(0, 200);
        EXPECT_THAT(said, testing::HasSubstr("a b.isochron-story")) << "names the file";
        EXPECT_EQ(std::ranges::count(said, '\n'), 0) << said;
    }
    EXPECT_THAT(refused(story_about(R"("..")")),
                testing::HasSubstr("isochron explore INDEX --story '"));
    EXPECT_THROW(read_story(folder_.path()), index::Error) << "a folder";
    EXPECT_THROW(read_story(folder_.path() / "none"), index::Error);
}

TEST(StoryFile, OfASessionIsThatOfItsKeys) {
    EXPECT_THROW(story_in(R"({"format": "isochron session", "version": 1})", "a"),
                 interaction::Error);
    KeyFrame key;
    key.text = "here";
    interaction::Commands state;
    state.keys = {key};
    const nlohmann::json session{{"format", "isochron session"},
                                 {"version", 1},
                                 {"program", ""},
                                 {"data", "/other/place.isochron"},
                                 {"data_hash", ""},
                                 {"state", interaction::commands_json(state)},
                                 {"head", {{"position", {0, 0, 0}}, {"yaw", 0}, {"pitch", 0}}}};
    const StoryFile story = story_in(session.dump(), "a");
    EXPECT_EQ(story.keys, std::vector{key});
    EXPECT_EQ(story.data, "") << "where a session's data lie is not what it shows";
}

TEST(FigureOfView, IsReadAsWhatWasSeen) {
    interaction::Random random(test_seed());
    int tried = 0;
    for (int round = 0; round < tries(600); ++round) {
        const interaction::Commands commands = interaction::random_commands(random);
        for (const KeyFrame& made : commands.keys.value_or(std::vector<KeyFrame>())) {
            KeyFrame key = made;
            key.time = key.hold = 0;
            key.pace = {};
            key.name.clear();
            key.text.clear();
            key.place.reset();
            if (key.mark && !key.mark->point)
                key.mark.reset(); // as `null`, which TOML lacks
            if (!key.step)
                key.fraction = 0;
            if (key.isovalue && !key.isosurfaces)
                key.isovalue.reset();
            const std::string text = figure_text("a \"b\".isochron", key, 0.75);
            const FigureFile figure = parse_figure(text, "figure.toml");
            ASSERT_EQ(figure.panels.size(), 1u);
            EXPECT_EQ(figure.panels[0].index, "a \"b\".isochron");
            EXPECT_EQ(figure.panels[0].aspect, 0.75);
            interaction::Commands read, wanted;
            read.keys = {figure.panels[0].key};
            wanted.keys = {key};
            EXPECT_EQ(interaction::commands_json(read).dump(),
                      interaction::commands_json(wanted).dump())
                << text;
            ++tried;
        }
    }
    EXPECT_GT(tried, 20);
}

TEST(FilmTitles, FadeInAndOutWhileTheirKeyIsTold) {
    interaction::Recording film;
    KeyFrame first, second;
    first.name = "one";
    first.text = "two";
    second.name = "short";
    film.header.start.keys = {first, second};
    for (int i = 0; i <= 20; ++i) {
        interaction::RecordedFrame& frame = film.frames.emplace_back();
        frame.input.time = interaction::Seconds(5 + 0.1 * i);
        if (i == 5 || i == 15 || i == 17)
            frame.commands.story = i == 5 ? 1 : i == 15 ? 2 : 0;
    }
    const std::vector<Title> titles = titles_of(film);
    ASSERT_EQ(titles.size(), 21u);
    for (int i = 0; i <= 20; ++i) {
        const bool one = i >= 5 && i < 15, two = i >= 15 && i < 17;
        EXPECT_EQ(titles[static_cast<std::size_t>(i)].words, one ? "one\ntwo" : two ? "short" : "");
        const double wanted = one   ? std::min({1.0, (i - 5) / 5.0, (15 - i) / 5.0})
                              : two ? std::min(i - 15, 17 - i)
                                    : 0;
        EXPECT_NEAR(titles[static_cast<std::size_t>(i)].opacity, wanted, 1e-5) << i;
    }
}

TEST(Wrapped, LinesFitAndLoseNothingUntilTheyAreTooMany) {
    const auto five = [](const std::string& line) { return characters_of(line) <= 5; };
    using Lines = std::vector<std::string>;
    EXPECT_EQ(wrapped("ab cd efgh", five, 9), (Lines{"ab cd", "efgh"}));
    EXPECT_EQ(wrapped("abcdefghijklm n", five, 9), (Lines{"abcde", "fghij", "klm n"}));
    EXPECT_EQ(wrapped("a\n\nb \n", five, 9), (Lines{"a", "", "b"}));
    EXPECT_EQ(wrapped("\u00e4\u00f6\u00fc\u00df\u00e4\u00f6 x", five, 9),
              (Lines{"\u00e4\u00f6\u00fc\u00df\u00e4", "\u00f6 x"}));
    EXPECT_EQ(wrapped("one two three", five, 2), (Lines{"one", "two\u2026"}));
    EXPECT_EQ(wrapped("abcde fghij k", five, 2), (Lines{"abcde", "fghi\u2026"}));
    EXPECT_EQ(wrapped(" \n ", five, 2), Lines{});
    interaction::Random random(test_seed());
    for (int round = 0; round < tries(300); ++round) {
        std::string text, letters;
        for (std::size_t i = random() % 60; i > 0; --i)
            text += "ab \n"[random() % 4];
        std::ranges::copy_if(text, std::back_inserter(letters), [](char c) { return c > ' '; });
        std::string kept;
        for (const std::string& line : wrapped(text, five, 99)) {
            EXPECT_TRUE(five(line));
            std::ranges::copy_if(line, std::back_inserter(kept), [](char c) { return c > ' '; });
        }
        EXPECT_EQ(kept, letters) << text;
        EXPECT_LE(wrapped(text, five, 3).size(), 3u);
    }
}

} // namespace
} // namespace isochron::app
