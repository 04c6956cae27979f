// The guard against overwriting data knows every format that the program reads.
#include "app/output/guarded_outputs.h"
#include "index/error.h"
#include "index/readers/formats/format.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using test_support::TestFolder;
using testing::HasSubstr;

/// What is said against a report under a name while these files are read; empty: nothing.
std::string refusal(const fs::path& output, const std::vector<fs::path>& read, bool force) {
    try {
        guard_outputs({{output, OutputKind::report}}, {read}, force);
    } catch (const index::Error& error) {
        return error.what();
    }
    return {};
}

TEST(GuardedOutputs, ReplaceAFileOfNoFormatThatIsReadAndOthersByForceAlone) {
    for (const index::Format& format : index::all_formats())
        for (const index::NameEnd& end : format.ends) {
            const TestFolder folder;
            const fs::path file = folder.write("values" + std::string(end.end), "of a user");
            for (const bool force : {false, true})
                EXPECT_THAT(refusal(file, {file}, force), HasSubstr("is an input")) << file;
            EXPECT_THAT(refusal(file, {}, false), HasSubstr("exists and is not")) << file;
            EXPECT_EQ(refusal(file, {}, true), "") << file;
        }
}

TEST(GuardedOutputs, ReplaceNothingThatAFileOfAnyFormatNames) {
    int naming = 0;
    for (const index::Format& format : index::all_formats()) {
        EXPECT_LE(format.list != nullptr, format.names_files) << format.name;
        for (const index::NameEnd& end : format.ends) {
            if (!format.names_files || end.with_folder)
                continue;
            const TestFolder folder;
            const fs::path named = folder.write("part_7", "of a user");
            // Where the end alone does not tell the format, HDF5 does.
            const fs::path file = folder.write("all" + std::string(end.end), "\x89HDF\r\n\x1a\n"
                                                                             "values: part_7\n");
            EXPECT_THAT(refusal(named, {file}, true), HasSubstr("names it")) << file;
            EXPECT_EQ(refusal(folder.write("part_8", "of a user"), {file}, true), "") << file;
            ++naming;
        }
    }
    EXPECT_GE(naming, 27);
}

TEST(GuardedOutputs, ReplaceNothingInAFolderThatAnyFormatReadsAsAWhole) {
    const auto expect_whole = [](const TestFolder& folder, const char* description) {
        const fs::path part = folder.write("run/deep/part", "of a user");
        EXPECT_THAT(refusal(part, {folder.path() / "run" / description}, true),
                    HasSubstr("is read"))
            << description;
        EXPECT_EQ(refusal(folder.write("beside", "of a user"),
                          {folder.path() / "run" / description}, true),
                  "")
            << description;
    };
    for (const index::Format& format : index::all_formats()) {
        for (const std::string_view file : format.describe_folder) {
            const TestFolder folder;
            fs::create_directories(folder.path() / "run" / "deep");
            fs::create_directories((folder.path() / "run" / file).parent_path());
            folder.write("run/" + std::string(file), "HyperCLaw-V1.1\n"); // an AMReX header
            expect_whole(folder, std::string(file).c_str());
        }
        for (const index::NameEnd& end : format.ends)
            if (end.with_folder) {
                const TestFolder folder;
                fs::create_directories(folder.path() / "run" / "deep");
                folder.write("run/case" + std::string(end.end), "");
                expect_whole(folder, ("case" + std::string(end.end)).c_str());
            }
    }
}

} // namespace
} // namespace isochron::app
