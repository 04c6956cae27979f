// Frames of an unfinished movie: taken again only as they were written, and never anybody else's.
#include "app/output/kept_frames.h"

#include "index/error.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using test_support::TestFolder;

std::vector<FramePart> frame_of(std::uint8_t shade) {
    FramePart left{"_left", "note \n of a picture", {3, 2, std::vector<std::uint8_t>(24, shade)}};
    FramePart right{"_right", "", {1, 1, {1, 2, 3, shade}, false, 300}};
    return {left, right};
}

bool same(const std::vector<FramePart>& a, const std::vector<FramePart>& b) {
    return std::ranges::equal(a, b, [](const FramePart& one, const FramePart& other) {
        return one.suffix == other.suffix && one.note == other.note &&
               one.image.rgba == other.image.rgba && one.image.width == other.image.width &&
               one.image.height == other.image.height && one.image.opaque == other.image.opaque &&
               one.image.dpi == other.image.dpi;
    });
}

TEST(KeptFrames, AreTakenByTheNextProcessThatAsksTheSameAndGoWhenTheMovieIsFinished) {
    const TestFolder folder;
    const fs::path movie = folder.path() / "a.mp4";
    fs::path kept_in;
    {
        KeptFrames kept(movie, "question");
        kept_in = kept.folder();
        EXPECT_THROW(KeptFrames(movie, "question"), index::Error) << "two at once";
        EXPECT_NO_THROW(KeptFrames(movie, "another question").remove());
        kept.keep(7, frame_of(7));
    } // as if the process were killed here
    KeptFrames again(movie, "question");
    EXPECT_FALSE(again.holds(6));
    ASSERT_TRUE(again.read(7));
    EXPECT_TRUE(same(*again.read(7), frame_of(7)));
    {
        KeptFrames other(movie, "another question");
        EXPECT_FALSE(other.read(7));
        EXPECT_THAT(other.others(), testing::ElementsAre(kept_in));
        other.remove();
    }
    again.remove();
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

/// Every byte counts: the frame is drawn again, whichever of them differs or is missing.
TEST(KeptFrames, ThatAreNotWholeAreDrawnAgain) {
    TestFolder folder;
    const fs::path movie = folder.path() / "a.mp4";
    KeptFrames kept(movie, "q");
    kept.keep(0, frame_of(9));
    const fs::path file = kept.folder() / "frame_000000";
    std::string whole;
    {
        std::ifstream in(file, std::ios::binary);
        whole.assign(std::istreambuf_iterator<char>(in), {});
    }
    ASSERT_GT(whole.size(), 40u);
    const auto write = [&](const std::string& bytes) {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    };
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        write(damaged);
        EXPECT_FALSE(kept.read(0)) << at;
        EXPECT_FALSE(fs::exists(file)) << "so that nobody counts it";
        write(whole.substr(0, at));
        EXPECT_FALSE(kept.read(0)) << at;
    }
    write(whole);
    EXPECT_TRUE(kept.read(0));
    kept.remove();
}

TEST(KeptFrames, LeaveFilesAndFoldersOfOthersAlone) {
    TestFolder folder;
    const fs::path movie = folder.path() / "a.mp4";
    fs::path name;
    {
        KeptFrames kept(movie, "q");
        name = kept.folder();
        kept.keep(0, frame_of(1));
        std::ofstream(name / "thesis.txt") << "mine";
        kept.remove();
        EXPECT_FALSE(fs::exists(name / "frame_000000"));
        EXPECT_TRUE(fs::exists(name / "thesis.txt"));
        fs::remove_all(name);
    }
    // A link with that name, or a folder that others may write in, is not used.
    const fs::path elsewhere = folder.path() / "elsewhere";
    fs::create_directory(elsewhere);
    std::ofstream(elsewhere / "frame_000000") << "mine";
    fs::permissions(elsewhere, fs::perms::owner_all);
    fs::create_directory_symlink(elsewhere, name);
    const auto try_it = [&] {
        KeptFrames kept(movie, "q");
        kept.keep(1, frame_of(1));
        EXPECT_FALSE(kept.read(0));
        kept.remove();
    };
    try_it();
    EXPECT_TRUE(fs::exists(elsewhere / "frame_000000"));
    EXPECT_FALSE(fs::exists(elsewhere / "frame_000001"));
    fs::remove(name);
    fs::rename(elsewhere, name);
    fs::permissions(name, fs::perms::all);
    try_it();
    EXPECT_TRUE(fs::exists(name / "frame_000000"));
    EXPECT_FALSE(fs::exists(name / "frame_000001"));
}

TEST(KeptFrames, AreNoneWhereTheFolderCannotBeMade) {
    const TestFolder folder;
    KeptFrames kept(folder.path() / "missing" / "a.mp4", "q");
    kept.keep(0, frame_of(1));
    EXPECT_FALSE(kept.holds(0));
    kept.remove();
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

} // namespace
} // namespace isochron::app
