// A mapped file counts as the process's memory only while it is needed.
#include "index/system/mapped_file.h"

#include "tests/support/test_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numeric>
#include <span>
#include <string>

namespace isochron::index {
namespace {

/// Pages of files that are in this process's memory now.
std::size_t resident_file_pages() {
    std::ifstream file("/proc/self/statm");
    std::size_t size = 0, resident = 0, shared = 0;
    file >> size >> resident >> shared;
    return shared;
}

unsigned sum(std::span<const std::byte> bytes) {
    return std::accumulate(bytes.begin(), bytes.end(), 0u,
                           [](unsigned all, std::byte one) { return all + unsigned(one); });
}

TEST(MappedFile, WhatIsLetGoTakesNoMemoryAndCanBeReadAgain) {
    const test_support::TestFolder folder;
    const std::filesystem::path path = folder.path() / "data";
    constexpr std::size_t kBytes = 64 << 20;
    std::ofstream(path, std::ios::binary) << std::string(kBytes, '\3');
    const MappedFile file(path);
    const std::size_t pages = kBytes / static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t before = resident_file_pages();
    ASSERT_EQ(sum(file.bytes()), 3 * kBytes);
    ASSERT_GT(resident_file_pages(), before + pages * 9 / 10);
    file.let_go(file.bytes());
    EXPECT_LT(resident_file_pages(), before + pages / 10);
    EXPECT_EQ(sum(file.bytes()), 3 * kBytes);
}

} // namespace
} // namespace isochron::index
