// Readers and modules are found in the folder that is said to be the program's.
#include "index/readers/formats/foreign_file.h"
#include "index/system/module.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"

#include <gmock/gmock.h>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const char* const kReader = "isochron-reader-vti";

/// Another program's folder, until the test ends.
class ProgramFolder : public testing::Test {
  protected:
    ~ProgramFolder() override { set_program_folder({}); }

    /// Opens a file in a reader that is started for it.
    std::string why_not_opened() const {
        ReaderPool pool;
        try {
            open_foreign(pool, format_named("vti"),
                         fs::path(test_support::test_data()) / "vti/ascii.vti", {});
            return {};
        } catch (const Error& error) {
            return error.what();
        }
    }

    TestFolder folder_;
};

TEST_F(ProgramFolder, IsTheOneOfTheRunningProgramUnlessAnotherIsSet) {
    const fs::path own = fs::read_symlink("/proc/self/exe").parent_path();
    EXPECT_EQ(program_folder(), own);
    set_program_folder(folder_.path());
    EXPECT_EQ(program_folder(), folder_.path());
    set_program_folder({});
    EXPECT_EQ(program_folder(), own);
}

TEST_F(ProgramFolder, IsWhereReadersAreFoundAndStarted) {
    const fs::path reader = fs::canonical(file_of_program(kReader));
    set_program_folder(folder_.path() / "bin");
    EXPECT_THAT(why_not_opened(),
                HasSubstr("not found beside the program in " + (folder_.path() / "bin").string()));
    fs::create_directories(folder_.path() / "libexec/isochron");
    fs::create_symlink(reader, folder_.path() / "libexec/isochron" / kReader);
    EXPECT_EQ(why_not_opened(), "");
    fs::create_directories(folder_.path() / "bin");
    fs::create_symlink("/bin/false", folder_.path() / "bin" / kReader);
    EXPECT_EQ(file_of_program(kReader), folder_.path() / "bin" / kReader);
    EXPECT_THAT(why_not_opened(), HasSubstr("its reader ended with status 1"));
}

TEST_F(ProgramFolder, IsWhereModulesAreFound) {
    set_program_folder(folder_.path());
    folder_.write("libisochron_toy.so", "no library");
    EXPECT_THAT(error_of([] { module_symbol("isochron_toy", "play"); }),
                HasSubstr((folder_.path() / "libisochron_toy.so: cannot be loaded").string()));
}

TEST_F(ProgramFolder, MayBeGivenRelativeToWhereTheProgramRuns) {
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path());
    set_program_folder("lib");
    fs::current_path(before);
    EXPECT_EQ(program_folder(), folder_.path() / "lib");
}

} // namespace
} // namespace isochron::index
