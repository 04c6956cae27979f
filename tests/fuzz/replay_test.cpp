// Every input that was once found to cause a fault, and every seed of the fuzzers, passes, and so does what a fixed
// number of changes makes of them: a minute for all targets under the sanitizers, the same in every run.
// FUZZ_TARGETS are those of one group, or all but those of VTK.
#include "tests/fuzz/changes.h"
#include "tests/fuzz/targets.h"
#include "tests/support/paths.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const char* kind, const Target& target) {
    return fs::path(test_support::source_root()) / "tests/fuzz" / kind / std::string(target.name);
}

#ifdef FUZZ_TARGETS
std::vector<Target> all_targets() {
    const auto group = FUZZ_TARGETS();
    return {group.begin(), group.end()};
}
#else
std::vector<Target> all_targets() {
    std::vector<Target> all;
    for (const auto& group : {volume_targets(), decoder_targets(), index_targets(),
                              interaction_targets(), app_targets()})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}
#endif

class FuzzInputs : public testing::TestWithParam<Target> {};

TEST_P(FuzzInputs, DoesNoHarm) {
    const Target& target = GetParam();
    int count = 0;
    for (const char* kind : {"corpus", "found"}) {
        const fs::path folder = folder_of(kind, target);
        if (!fs::exists(folder))
            continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            std::ifstream file(entry.path(), std::ios::binary);
            const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
            SCOPED_TRACE(entry.path());
            EXPECT_NO_THROW(
                target.run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
            ++count;
        }
    }
    EXPECT_GT(count, 0) << "tests/fuzz/corpus/" << target.name << " is empty";
}

/// Runs of a target, which take about three seconds under the sanitizers; ISOCHRON_FUZZ_RUNS times
/// as many where that is set.
int runs_of(std::string_view name) {
    static const std::map<std::string_view, int> slow{
        {"index_file", 300}, {"mesh", 300},      {"vtk_text", 900},   {"pvx", 600},
        {"nifti", 900},      {"nrrd", 1200},     {"metaimage", 1200}, {"metaimage_parts", 1200},
        {"toml", 2100},      {"recording", 1500}};
    const auto found = slow.find(name);
    const char* times = std::getenv("ISOCHRON_FUZZ_RUNS");
    return (found == slow.end() ? 4500 : found->second) * (times ? std::atoi(times) : 1);
}

/// The input at hand, in a file that outlives a program which ends at once.
class LastInput {
  public:
    explicit LastInput(std::string_view target)
        : path_(fs::temp_directory_path() / fmt::format("isochron_fuzz_{}_{}", target, ::getpid())),
          file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)) {}
    ~LastInput() {
        ::close(file_);
        fs::remove(path_);
    }
    LastInput(const LastInput&) = delete;
    LastInput& operator=(const LastInput&) = delete;
    bool keep(const Input& input) const {
        // Never shortened to nothing: some file systems flush a file that is written anew.
        const auto size = static_cast<ssize_t>(input.size());
        return ::pwrite(file_, input.data(), input.size(), 0) == size &&
               ::ftruncate(file_, size) == 0;
    }

  private:
    fs::path path_;
    int file_;
};

TEST_P(FuzzInputs, DoesNoHarmOnceChanged) {
    const Target& target = GetParam();
    const fs::path dictionary = fs::path(test_support::source_root()) / "tests/fuzz/dictionaries" /
                                (std::string(target.name) + ".dict");
    Changes changes(inputs_in({folder_of("corpus", target), folder_of("found", target)}),
                    words_in(dictionary), test_seed());
    const LastInput last(target.name);
    for (int i = 0, runs = runs_of(target.name); i < runs; ++i) {
        const Input input = changes.next();
        ASSERT_TRUE(last.keep(input));
        SCOPED_TRACE(i);
        ASSERT_NO_THROW(target.run(input));
    }
}

#ifndef FUZZ_TARGETS
TEST(FuzzFolders, EveryInputBelongsToATarget) {
    std::vector<std::string> names{"mesh", "vtk_text"}; // VTK's targets
    for (const Target& target : all_targets())
        names.emplace_back(target.name);
    for (const char* kind : {"corpus", "found"})
        for (const fs::directory_entry& entry :
             fs::directory_iterator(fs::path(test_support::source_root()) / "tests/fuzz" / kind))
            EXPECT_NE(std::ranges::find(names, entry.path().filename().string()), names.end())
                << entry.path();
}
#endif

std::string name_of(const testing::TestParamInfo<Target>& info) {
    return std::string(info.param.name);
}

INSTANTIATE_TEST_SUITE_P(All, FuzzInputs, testing::ValuesIn(all_targets()), name_of);

} // namespace
} // namespace isochron::fuzz
