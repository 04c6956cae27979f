// Files inside the fence: those of the named folders can be read, and no others.
#include "index/readers/process/file_fence.h"
#include "tests/fence/inside.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

// A sanitizer makes calls of its own that the fence refuses: there readers go without it.
#ifndef ISOCHRON_SANITIZED

namespace isochron {
namespace {

namespace fs = std::filesystem;
using test_support::surprises_inside;
using test_support::TestFolder;

/// A line where opening for reading does not end so; 0: it opens.
std::string unless(int expected, const fs::path& file) {
    const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const int error = opened < 0 ? errno : 0;
    if (opened >= 0)
        ::close(opened);
    return error == expected ? ""
                             : fmt::format("{}: {}, expected {}\n", file.string(),
                                           std::strerror(error), std::strerror(expected));
}

/// The system must have it, or the tests below would say nothing.
class FencedFiles : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_GE(index::file_fence_version(), 1) << "this kernel has no Landlock";
    }
    TestFolder named_, other_;
};

TEST_F(FencedFiles, OfNamedFoldersAreReadableAndOthersAreNot) {
    const fs::path inside = named_.write("in", "content");
    fs::create_directory(named_.path() / "below");
    named_.write("below/in", "content");
    const fs::path outside = other_.write("out", "secret");
    fs::create_symlink(outside, named_.path() / "link");
    const fs::path readable[]{named_.path()};
    const std::string parent = fmt::format("/proc/{}/", ::getpid());
    EXPECT_EQ(surprises_inside(
                  readable,
                  [&] {
                      std::string lines = unless(0, inside);
                      lines += unless(0, named_.path());
                      lines += unless(0, named_.path() / "below/in");
                      lines += unless(EACCES, outside);
                      lines += unless(EACCES, other_.path());
                      lines += unless(EACCES, named_.path() / "link");
                      lines +=
                          unless(EACCES, named_.path() / ".." / other_.path().filename() / "out");
                      for (const char* of_parent : {"mem", "environ", "maps", "cmdline", "status",
                                                    "fd/0", "root/etc/passwd", "cwd"})
                          lines += unless(EACCES, parent + of_parent);
                      for (const char* path : {"/etc/passwd", "/etc/shadow", "/root", "/home", "/",
                                               "/proc", "/proc/self/environ", "/dev/zero", "/run"})
                          if (::access(path, F_OK) == 0)
                              lines += unless(EACCES, path);
                      return lines;
                  }),
              "");
}

TEST_F(FencedFiles, AreHiddenAllWhereNothingIsNamedButStayReadableWhereOpen) {
    const fs::path file = named_.write("in", "content");
    const int open = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_GE(open, 0);
    EXPECT_EQ(surprises_inside({},
                               [&] {
                                   std::string lines = unless(EACCES, file);
                                   char first = 0;
                                   if (::pread(open, &first, 1, 0) != 1 || first != 'c')
                                       lines += "what was open cannot be read\n";
                                   return lines;
                               }),
              "");
    ::close(open);
}

TEST_F(FencedFiles, ThatAreNamedThemselvesAreReadableButNotWhatLiesBeside) {
    const fs::path file = named_.write("in", "content"), beside = named_.write("b", "secret");
    const fs::path readable[]{file};
    EXPECT_EQ(surprises_inside(readable, [&] { return unless(0, file) + unless(EACCES, beside); }),
              "");
}

} // namespace
} // namespace isochron

#endif
