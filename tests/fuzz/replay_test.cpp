// Every input that was once found to cause a fault, and every seed of the fuzzers, passes.
// FUZZ_TARGETS are those of one group, or all but those of VTK.
#include "tests/fuzz/targets.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
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

#ifndef FUZZ_TARGETS
TEST(FuzzFolders, EveryInputBelongsToATarget) {
    std::vector<std::string> names{"mesh", "vtk_text"}; // of VTK's
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
