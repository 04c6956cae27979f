// What messages advise is done, and works; a part of a file is read as a part.
#include "tests/app/commands/command_line.h"

namespace isochron::app {
namespace {

// The script makes a file for each message that names an option, does what it says and looks at what
// comes of it; it also looks for messages in the sources that it has no file for.
TEST_F(CommandLine, AdviceOfMessagesIsFollowedAndWorks) {
    const std::string script = test_support::source_root() + "/tests/app/commands/advice.py";
    const ChildResult result =
        run_child("/usr/bin/env",
                  {"PYTHONDONTWRITEBYTECODE=1", "/usr/bin/python3", "-W", "ignore", script,
                   test_support::binary_root() + "/isochron", test_support::source_root()},
                  folder.path());
    EXPECT_EQ(result.status, 0) << result.out << result.err;
}

// Bytes are counted by the kernel, of the program and of its readers.
TEST_F(CommandLine, ACropOfAnEighthReadsAnEighthOfTheBytes) {
    const ChildResult result =
        run_child("/usr/bin/env",
                  {"PYTHONDONTWRITEBYTECODE=1", "/usr/bin/python3", "-W", "ignore",
                   test_support::source_root() + "/tests/app/commands/part_bytes.py",
                   test_support::binary_root() + "/isochron"},
                  folder.path());
    EXPECT_EQ(result.status, 0) << result.out << result.err;
}

} // namespace
} // namespace isochron::app
