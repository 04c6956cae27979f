// The note in a picture is read as it was written, or refused in one line.
#include "app/output/picture_note.h"

#include "app/frame/explorer_state.h"
#include "interaction/error.h"
#include "tests/interaction/recording/random_commands.h"
#include "tests/support/session_fixture.h"
#include "tests/support/test_seed.h"

#include <gmock/gmock.h>

namespace isochron::app {
namespace {

PictureNote some_note() {
    PictureNote note;
    note.program = "isochron 0.1.0";
    note.drawn_with = "OpenGL 4.5, a driver";
    note.configuration = "# \xc3\xbc\n[[windows]]\nname = \"a\\\"b\"\n";
    note.data = "heart </isochron-picture>.isochron";
    note.data_hash = "00ff00ff00ff00ff";
    note.part = {"left", 3, 1};
    note.size = {640, 480};
    note.samples = 4;
    note.footprint = "surface";
    note.shape = "plane";
    note.state = ExplorerState{}.as_commands();
    note.input = head_at_rest(2.5);
    return note;
}

TEST(PictureNote, ComesBackAsItWas) {
    PictureNote note = some_note();
    note.data = "heart.isochron";
    EXPECT_EQ(note_from(text_of(note)), note);
    note.movie = MovieNote{29.97, "0123456789abcdef"};
    note.latched = head_at_rest(2.51);
    note.ray = note.caption = true;
    EXPECT_EQ(text_of(note).find("recorded_on"), std::string::npos);
    EXPECT_EQ(text_of(note).find("reading_number"), std::string::npos);
    note.recorded_on = "fedcba9876543210";
    note.reading = 3;
    const std::string text = text_of(note);
    EXPECT_EQ(note_from(text), note);
    for (const char c : text)
        EXPECT_TRUE(c >= ' ' && c <= '~') << "ASCII, one line";
}

TEST(PictureNote, ActionsOfOlderPicturesAreReadFromTheirBits) {
    PictureNote note = some_note();
    note.data = "heart.isochron";
    note.input.devices.push_back({.name = "keys", .pose = {}, .valuators = {}});
    PictureNote old = note;
    note.input.devices.back().actions = bit(interaction::Action::teleport);
    old.input.devices.back().buttons = std::uint64_t{1} << 36;
    old.input.devices.push_back({.name = "more_keys", .pose = {}, .valuators = {}});
    EXPECT_EQ(note_from(text_of(old)), note);
}

TEST(PictureNote, WhateverIsCutOffOrChangedIsRefusedInOneLine) {
    const std::string text = text_of(some_note());
    std::mt19937 random(test_seed());
    for (int i = 0; i < 300; ++i) {
        std::string bad = text;
        const std::size_t at = random() % bad.size();
        if (i % 2 == 0)
            bad.resize(at);
        else
            bad[at] = static_cast<char>(32 + random() % 95);
        try {
            note_from(bad);
        } catch (const interaction::Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}

TEST(PictureNote, StandsInAGifBehindItsPicturesAndOthersComments) {
    TestFolder folder;
    PictureNote note = some_note();
    note.data = "heart.isochron";
    note.configuration = std::string(2000, '#');
    const std::string other{"GIF89a....\x21\xfe\x03"
                            "abc\x00\x3b",
                            18};
    folder.write("a.gif", other);
    const auto path = folder.path() / "a.gif";
    EXPECT_EQ(note_text_in(path), "");
    add_note_to_gif(path, text_of(note));
    EXPECT_EQ(note_from(note_text_in(path)), note);
    EXPECT_TRUE(folder.read("a.gif").starts_with(other.substr(0, 17)));
    EXPECT_EQ(folder.read("a.gif").back(), '\x3b');
}

} // namespace
} // namespace isochron::app
