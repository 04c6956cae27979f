// The entrances of libFuzzer: `fuzz_GROUP --target=NAME [libFuzzer's options] FOLDER...`.
// FUZZ_TARGETS are those of the group.
#include "tests/fuzz/packed_mutation.h"
#include "tests/fuzz/targets.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

const isochron::fuzz::Target* g_target = nullptr;

} // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

// libFuzzer leaves options with two dashes to the program.
extern "C" __attribute__((visibility("default"))) int LLVMFuzzerInitialize(int* count,
                                                                           char*** words) {
    constexpr std::string_view kOption = "--target=";
    for (int i = 1; i < *count; ++i)
        if (const std::string_view word = (*words)[i]; word.starts_with(kOption))
            for (const isochron::fuzz::Target& target : isochron::fuzz::FUZZ_TARGETS())
                if (target.name == word.substr(kOption.size()))
                    g_target = &target;
    if (g_target)
        return 0;
    std::fprintf(stderr, "expected --target= and one of");
    for (const isochron::fuzz::Target& target : isochron::fuzz::FUZZ_TARGETS())
        std::fprintf(stderr, " %.*s", static_cast<int>(target.name.size()), target.name.data());
    std::fprintf(stderr, "\n");
    std::exit(2);
}

extern "C" __attribute__((visibility("default"))) int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    g_target->run({data, size});
    return 0;
}

extern "C" __attribute__((visibility("default"))) std::size_t
LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    // Half of the time what is compressed is changed as it is inside: a flipped bit of it outside
    // only fails its check.
    if (seed % 2 == 0)
        if (const auto done =
                isochron::fuzz::mutate_packed({data, size}, most, seed, LLVMFuzzerMutate))
            return *done;
    return LLVMFuzzerMutate(data, size, most);
}
