// Inputs are regular files: others are not opened, waited for, or read without end.
#include "index/system/input_file.h"

#include "index/error.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

namespace isochron::index {
namespace {

using testing::HasSubstr;

class InputFiles : public testing::Test {
  protected:
    /// What each way to open a file says about this one.
    std::vector<std::string> complaints(const std::filesystem::path& path) const {
        std::vector<std::string> all;
        const auto note = [&](auto open) {
            try {
                open();
                all.emplace_back("opened");
            } catch (const Error& error) {
                all.emplace_back(error.what());
            }
        };
        note([&] { InputFile{path}; });
        note([&] { InputStream{path}; });
        note([&] { read_text(path, 100); });
        note([&] { state_of(path); });
        return all;
    }
    test_support::TestFolder folder_;
};

TEST_F(InputFiles, APipeNobodyWritesToIsRefusedAtOnce) {
    const auto pipe = folder_.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(complaints(pipe), testing::Each(HasSubstr("pipe: not a regular file")));
}

TEST_F(InputFiles, AreClosedAgain) {
    const auto open_now = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
    };
    const auto before = open_now();
    EXPECT_THAT(complaints(folder_.write("a", "text")), testing::Each("opened"));
    EXPECT_EQ(open_now(), before);
}

TEST_F(InputFiles, ADeviceThatNeverEndsIsRefused) {
    EXPECT_THAT(complaints("/dev/zero"), testing::Each("/dev/zero: not a regular file"));
}

TEST_F(InputFiles, ASocketIsRefused) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = (folder_.path() / "socket").string();
    ASSERT_LT(path.size(), sizeof address.sun_path);
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_THAT(complaints(path), testing::Each(HasSubstr("socket: not a regular file")));
    ::close(socket);
}

TEST_F(InputFiles, FoldersAndMissingFilesAreNamed) {
    EXPECT_THAT(complaints(folder_.path()), testing::Each(HasSubstr("a folder, expected a file")));
    EXPECT_THAT(complaints(folder_.path() / "none"),
                testing::Each(HasSubstr("none: there is no such file")));
    EXPECT_THAT(complaints(folder_.path() / std::string(300, 'x')),
                testing::Each(HasSubstr("File name too long")));
}

TEST_F(InputFiles, ReadsByPositionUpToTheEnd) {
    const InputFile file(folder_.write("a", "0123456789"));
    EXPECT_EQ(file.size(), 10u);
    std::array<char, 4> part{};
    EXPECT_EQ(file.read(3, std::as_writable_bytes(std::span(part))), 4u);
    EXPECT_EQ(std::string(part.data(), 4), "3456");
    EXPECT_EQ(file.read(8, std::as_writable_bytes(std::span(part))), 2u);
    EXPECT_EQ(file.read(99, std::as_writable_bytes(std::span(part))), 0u);
}

TEST_F(InputFiles, ATextThatIsTooLargeIsNotRead) {
    const auto path = folder_.write("a", "");
    std::filesystem::resize_file(path, std::uint64_t{1} << 40); // a hole: it takes no disk
    EXPECT_THAT(complaints(path),
                testing::Contains(HasSubstr("a: 1099511627776 bytes, expected at most 100")));
    EXPECT_EQ(read_text(folder_.write("b", "text"), 4), "text");
}

TEST_F(InputFiles, TheBeginningOfAFileStaysAsItWasSeen) {
    const std::string text = "first line\nsecond\n", many(3 * FilesSeen::kHead, 'x');
    const auto small = folder_.write("small", text), large = folder_.write("large", many);
    const auto start_of = [](const std::filesystem::path& path, std::uint64_t offset) {
        std::string start(10, '\0');
        start.resize(InputFile(path).read(offset, std::as_writable_bytes(std::span(start))));
        return start;
    };
    {
        const FilesSeen seen;
        const FileState was = state_of(small);
        EXPECT_EQ(start_of(small, 0), "first line");
        EXPECT_EQ(start_of(large, many.size() - 5), "xxxxx");
        std::filesystem::remove(small); // whoever opened it again would fail
        {
            const FilesSeen within; // changes nothing
        }
        EXPECT_EQ(start_of(small, 6), "line\nsecon");
        EXPECT_EQ(start_of(small, 15), "nd\n");
        EXPECT_EQ(start_of(small, 99), "");
        EXPECT_EQ(read_text(small, 100), text);
        EXPECT_EQ(state_of(small), was);
        InputStream stream(small);
        std::string line;
        std::getline(stream, line);
        EXPECT_EQ(line, "first line");
        std::getline(stream, line);
        EXPECT_EQ(line, "second");
        EXPECT_FALSE(std::getline(stream, line));
        folder_.write("large", many + "y");
        EXPECT_EQ(start_of(large, 0), "xxxxxxxxxx");
        EXPECT_THROW(start_of(large, FilesSeen::kHead), Error);
    }
    EXPECT_THROW(start_of(small, 0), Error);
    EXPECT_EQ(start_of(large, many.size()), "y");
}

TEST_F(InputFiles, AStateTellsWhatAFileBecame) {
    const auto path = folder_.write("a", "text");
    const FileState was = state_of(path);
    EXPECT_EQ(state_of(path), was);
    EXPECT_EQ(was.size, 4u);
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::min() +
                                               std::chrono::hours(1));
    EXPECT_NE(state_of(path), was);
}

} // namespace
} // namespace isochron::index
