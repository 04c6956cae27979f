// The variants of the THI tree find what the published tree finds, in as many entries.
#include "tests/bench/rivals/thi_variants.h"

#include "index/paper/thi_tree.h"
#include "index/scan/scan.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace isochron::bench {
namespace {

using index::CellId;
using index::StepValues;
using index::TestField;
using index::ThiOptions;
using index::ValueType;

constexpr std::array kVariants{ThiVariant::node_lattices, ThiVariant::interval_trees,
                               ThiVariant::compact_lists};

/// Expects the published tree's candidates, none twice; all active cells among them, and these
/// alone after the exact test.
void expect_published_candidates(const StepValues& values, const ThiOptions& options,
                                 int isovalues) {
    const auto bytes = index::build_thi_tree(values, options);
    const index::ThiTree published(bytes);
    const index::KeyMap keys(values.type, values.scaling);
    std::vector<double> queries{-1e300, 1e300};
    for (const double value : index::quantiles(index::sorted_values(values), isovalues))
        if (std::isfinite(value))
            queries.insert(queries.end(), {value, std::nextafter(value, 1e300)});
    for (const ThiVariant variant : kVariants) {
        SCOPED_TRACE(testing::Message()
                     << "variant " << static_cast<int>(variant) << ", L " << options.lattice
                     << ", MaxVariation " << options.max_variation);
        const auto tree = build_thi_variant(variant, {values, options, {}, 1});
        EXPECT_EQ(tree->entries(), published.entries());
        for (std::uint32_t step = 0; step < values.steps; ++step) {
            const index::BruteForce oracle(values, step);
            for (const double isovalue : queries) {
                std::vector<CellId> expected, found;
                published.search(step, keys.threshold(isovalue), expected);
                tree->search(step, keys.threshold(isovalue), found);
                std::sort(expected.begin(), expected.end());
                std::sort(found.begin(), found.end());
                ASSERT_EQ(found, expected) << "step " << step << ", isovalue " << isovalue;
                index::keep_active(values, {index::Instant(step), isovalue}, found);
                ASSERT_EQ(found, oracle.active(isovalue));
            }
        }
    }
}

TEST(ThiVariants, HaveTheCandidatesOfThePublishedTreeForEveryLatticeAndMaxVariation) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({12, 11, 10}, 9, type,
                              index::scaled(index::turbulence(random), 100, 120));
        for (const ThiOptions options :
             {ThiOptions{1, 1}, {2, 3}, {32, 1}, {32, 2}, {64, 3}, {128, 2}, {4096, 1}, {4096, 64}})
            expect_published_candidates(field.view(), options, 8);
    }
}

TEST(ThiVariants, HoldForListsTooLongForNarrowPlaces) {
    // One element, thus one interval tree, whose root holds more than 2^16 cells.
    const TestField field({51, 50, 48}, 1, ValueType::u8, [](double x, double y, double z, double) {
        return 40 * (static_cast<int>(x + y + z) % 2) + x;
    });
    expect_published_candidates(field.view(), {1, 1}, 6);
}

} // namespace
} // namespace isochron::bench
