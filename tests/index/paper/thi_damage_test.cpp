// Damaged bytes of a THI tree are refused, or searched without reading outside them.
#include "index/error.h"
#include "index/paper/thi_layout.h"
#include "index/paper/thi_tree.h"

#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <cstring>

namespace isochron::index {
namespace {

std::vector<std::byte> sound_bytes(std::mt19937& random) {
    const TestField field({8, 7, 6}, 7, ValueType::f32, turbulence(random));
    return build_thi_tree(field.view(), {16, 2});
}

/// Opens and searches a copy in a block of its own, whose borders the address sanitizer guards.
/// @return whether it was taken for a tree
bool survives(const std::vector<std::byte>& bytes, std::mt19937& random) {
    const std::vector<std::byte> copy(bytes); // NOLINT: a block of its own
    try {
        const ThiTree tree(copy);
        ThiTree::Cursor cursor;
        if (tree.steps() > 1000)
            return true; // nodes() would only take long
        (void)tree.nodes();
        for (int search = 0; search < 20; ++search) {
            const std::uint32_t step = static_cast<std::uint32_t>(random()) % tree.steps();
            const std::uint64_t threshold = 0x7f000000 + random() % 0x2000000;
            std::vector<CellId> found;
            tree.search(step, threshold, found);
            tree.search_incremental(cursor, step, threshold);
        }
        return true;
    } catch (const Error&) {
        return false;
    }
}

TEST(ThiTree, RefusesEveryTruncation) {
    std::mt19937 random(test_seed());
    const std::vector<std::byte> bytes = sound_bytes(random);
    ASSERT_TRUE(survives(bytes, random));
    for (std::size_t size = 0; size < bytes.size(); size += size < 400 ? 1 : 97)
        EXPECT_FALSE(survives({bytes.begin(), bytes.begin() + size}, random)) << size;
    std::vector<std::byte> longer = bytes;
    longer.resize(bytes.size() + 8);
    EXPECT_FALSE(survives(longer, random));
}

TEST(ThiTree, NeverLeavesDamagedBytes) {
    std::mt19937 random(test_seed());
    const std::vector<std::byte> bytes = sound_bytes(random);
    int refused = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        std::vector<std::byte> damaged = bytes;
        // Half of the damage to the numbers that a search goes by, at the beginning and the end.
        const std::size_t range = trial % 4 == 0 ? damaged.size() : 2000;
        for (std::uint32_t flips = 1 + random() % 4; flips-- > 0;) {
            const std::size_t at = random() % std::min(range, damaged.size());
            damaged[trial % 4 == 1 ? damaged.size() - 1 - at : at] ^=
                static_cast<std::byte>(1 << random() % 8);
        }
        refused += !survives(damaged, random);
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, 3000);
}

TEST(ThiTree, RefusesHeadersWhoseSizesOverflow) {
    std::mt19937 random(test_seed());
    const std::vector<std::byte> bytes = sound_bytes(random);
    for (const std::size_t offset :
         {offsetof(ThiHeader, steps), offsetof(ThiHeader, lattice),
          offsetof(ThiHeader, max_variation), offsetof(ThiHeader, elements)})
        for (const std::uint32_t value : {0u, 5000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
            std::vector<std::byte> damaged = bytes;
            std::memcpy(damaged.data() + offset, &value, sizeof value);
            EXPECT_FALSE(survives(damaged, random)) << offset << ' ' << value;
        }
    for (const std::size_t offset :
         {offsetof(ThiHeader, entries), offsetof(ThiHeader, interval_nodes)})
        for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{1} << 60,
                                          (std::uint64_t{1} << 62) + 1, ~std::uint64_t{0}}) {
            std::vector<std::byte> damaged = bytes;
            std::memcpy(damaged.data() + offset, &value, sizeof value);
            // A tree may well have no interval nodes: then 0 is no damage.
            EXPECT_EQ(survives(damaged, random), damaged == bytes) << offset << ' ' << value;
        }
}

TEST(ThiTree, SaysWhatIsWrong) {
    const auto message = [](std::span<const std::byte> bytes) -> std::string {
        try {
            ThiTree{bytes};
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message({}), "THI tree: shorter than its header");
    const std::vector<std::byte> zeros(64);
    EXPECT_EQ(message(zeros), "THI tree: not a tree of this version");
    EXPECT_EQ(message(std::span(zeros).subspan(1)), "THI tree: not aligned to 8 bytes");
}

TEST(ThiTree, RefusesOptionsOutOfRange) {
    const TestField field({3, 3, 3}, 2, ValueType::u8, moving_sphere);
    for (const ThiOptions& options :
         {ThiOptions{0, 2}, ThiOptions{4097, 2}, ThiOptions{64, 0}, ThiOptions{64, 65}})
        EXPECT_THROW(build_thi_tree(field.view(), options), Error);
    StepValues none = field.view();
    none.steps = 0;
    EXPECT_THROW(build_thi_tree(none, {}), Error);
}

} // namespace
} // namespace isochron::index
