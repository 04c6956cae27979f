// Extractions that take over what stays: the same, bit by bit, as extractions made anew.
#include "index/extraction/extraction.h"
#include "index/indexing/appended_series.h"
#include "index/indexing/index_build.h"
#include "index/system/growing_file.h"
#include "tests/support/indexed.h"
#include "tests/support/memory_series.h"
#include "tests/support/staying_field.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace isochron::index {
namespace {

using test_support::TestFolder;

bool same_points(const std::vector<CellPoint>& a, const std::vector<CellPoint>& b) {
    return std::ranges::equal(a, b, [](const CellPoint& x, const CellPoint& y) {
        return x.x == y.x && x.y == y.y && x.z == y.z && x.style == y.style && x.plane == y.plane;
    });
}
bool same_rows(const std::vector<CellRow>& a, const std::vector<CellRow>& b) {
    return std::ranges::equal(a, b, [](const CellRow& x, const CellRow& y) {
        return x.y == y.y && x.z == y.z && x.begin == y.begin;
    });
}

void expect_same(const Extraction& found, const Extraction& anew) {
    ASSERT_EQ(found.surfaces.size(), anew.surfaces.size());
    for (std::size_t i = 0; i < found.surfaces.size(); ++i) {
        const CellSet &a = found.surfaces[i], &b = anew.surfaces[i];
        ASSERT_EQ(a.ids, b.ids) << "surface " << i;
        ASSERT_TRUE(same_points(a.points, b.points)) << "surface " << i;
        ASSERT_TRUE(same_rows(a.rows, b.rows)) << "surface " << i;
        ASSERT_EQ(a.mesh != nullptr, b.mesh != nullptr);
        ASSERT_TRUE(!a.mesh || *a.mesh == *b.mesh) << "surface " << i;
        ASSERT_EQ(a.query, b.query);
    }
    ASSERT_EQ(found.levels, anew.levels);
    ASSERT_EQ(found.colors, anew.colors);
    ASSERT_EQ(found.corner_colors, anew.corner_colors);
    ASSERT_EQ(found.blocks.ids, anew.blocks.ids);
    ASSERT_EQ(found.blocks.digests, anew.blocks.digests);
    ASSERT_EQ(found.blocks.joined(), anew.blocks.joined());
    ASSERT_EQ(found.surroundings.shares, anew.surroundings.shares);
    ASSERT_EQ(found.detail, anew.detail);
    ASSERT_EQ(found.volume_cells, anew.volume_cells);
}

/// What the change of a set says, applied to the ids before.
void expect_change(const Extraction& before, const Extraction& after) {
    ASSERT_EQ(after.change.from, before.number);
    for (std::size_t i = 0; i < after.surfaces.size(); ++i) {
        const SurfaceChange& change = after.change.surfaces[i];
        std::vector<CellId> left, stayed;
        const auto without = [](const std::vector<CellId>& ids,
                                const std::vector<std::uint32_t>& places,
                                std::vector<CellId>& out) {
            for (std::uint32_t at = 0; at < ids.size(); ++at)
                if (!std::ranges::binary_search(places, at))
                    out.push_back(ids[at]);
        };
        without(before.surfaces[i].ids, change.removed, left);
        without(after.surfaces[i].ids, change.added, stayed);
        ASSERT_EQ(left, stayed) << "surface " << i;
        // A cell that comes was not there before.
        for (const std::uint32_t at : change.added)
            ASSERT_FALSE(
                std::ranges::binary_search(before.surfaces[i].ids, after.surfaces[i].ids[at]));
    }
}

/// NaNs that come at some step and stay for some, where the type has them: cells beside them come and
/// go though all their own values stay.
void plant_nans(std::mt19937& random, TestField& field, ValueType type, std::size_t steps) {
    const std::size_t vertices = field.view().grid.vertex_count();
    for (int i = 0; i < 40 && (type == ValueType::f32 || type == ValueType::f64); ++i) {
        const std::size_t vertex = random() % vertices, first = random() % steps,
                          end = first + random() % (steps - first + 1);
        for (std::size_t step = first; step < end; ++step)
            if (type == ValueType::f32)
                field.at<float>(step, vertex) = std::numeric_limits<float>::quiet_NaN();
            else
                field.at<double>(step, vertex) = kNaN;
    }
}

/// A walk through steps and isovalues, with one to three surfaces.
class Walk {
  public:
    Walk(std::mt19937& random, const StepValues& values)
        : random_(random), isovalues_(quantiles(sorted_values(values), 9)),
          steps_(static_cast<std::uint32_t>(values.steps)), query_{{}, {isovalues_[4]}} {}

    const SurfacesQuery& next() {
        const std::uint32_t step = query_.instant.step;
        switch (chance(10)) {
        case 0: query_.instant = Instant(chance(steps_)); break; // a jump
        case 1:
        case 2: query_.instant = Instant((step + steps_ - 1) % steps_); break;
        case 3: query_.isovalues[chance(query_.isovalues.size())] = isovalues_[chance(9)]; break;
        case 4:
            if (query_.isovalues.size() < 3)
                query_.isovalues.push_back(isovalues_[chance(9)]);
            else
                query_.isovalues.pop_back();
            break;
        default: query_.instant = Instant((step + 1) % steps_);
        }
        return query_;
    }
    SurfacesQuery& query() { return query_; }
    std::uint32_t chance(std::size_t count) {
        return std::uniform_int_distribution<std::uint32_t>(
            0, static_cast<std::uint32_t>(count - 1))(random_);
    }

  private:
    std::mt19937& random_;
    std::vector<double> isovalues_;
    std::uint32_t steps_;
    SurfacesQuery query_;
};

TEST(KeptExtraction, IsTheSameAsOneMadeAnewOnRandomWalksOfAllTypes) {
    std::mt19937 random(test_seed());
    std::uint64_t reused = 0, changes = 0;
    for (const ValueType type : kAllTypes) {
        const TestFolder folder;
        const std::size_t steps = 12;
        TestField field({35, 21, 20}, steps, type,
                        scaled(staying_field(random, turbulence(random), 0.85, steps), 60, 3));
        plant_nans(random, field, type, steps);
        const StepValues values = field.view();
        const auto all = indexed(folder, values);
        // There is no room for a step as a whole in the second one's cache, but for its chunks.
        const auto some =
            IndexFile::open(folder.path() / "a.isochron", 3 * values.step_bytes(0).size());
        ASSERT_TRUE(all->better_whole(0));
        ASSERT_FALSE(some->better_whole(0));
        for (const auto& [file, shading] :
             {std::pair(all, Shading::none), std::pair(all, Shading::cells),
              std::pair(some, Shading::none), std::pair(some, Shading::cells)}) {
            Walk walk(random, values);
            const Extract kept = extract_from(file, std::nullopt, shading);
            ExtractionPtr before;
            for (int i = 0; i < tries(240); ++i) {
                walk.next();
                walk.query().mesh_room = shading == Shading::cells && walk.chance(2) ? 1 << 28 : 0;
                const ExtractionPtr found = kept(walk.query(), {});
                const ExtractionPtr anew =
                    extract_from(file, std::nullopt, shading)(walk.query(), {});
                ASSERT_NO_FATAL_FAILURE(expect_same(*found, *anew)) << name_of(type) << ' ' << i;
                EXPECT_EQ(anew->reused(), 0u);
                reused += found->reused();
                if (found->change.from != 0) {
                    ++changes;
                    ASSERT_NO_FATAL_FAILURE(expect_change(*before, *found));
                }
                before = found;
            }
        }
    }
    EXPECT_GT(reused, static_cast<std::uint64_t>(tries(200'000)));
    EXPECT_GT(changes, static_cast<std::uint64_t>(tries(660)));
}

/// An index with a second array and an array to color by, whose chunks change at other steps.
std::shared_ptr<const IndexFile> with_arrays(const TestFolder& folder, const StepValues& values,
                                             const StepValues& further, const StepValues& hue) {
    MemorySeries series(values), flow(further), colors(hue);
    flow.info().array = "flow";
    colors.info().array = "hue";
    BuildOptions options;
    options.color = &colors;
    options.further.push_back({.series = &flow});
    build_index(series, folder.path() / "a.isochron", options);
    return IndexFile::open(folder.path() / "a.isochron");
}

TEST(KeptExtraction, IsTheSameWithArraysColorsLevelsOfDetailAndASmallCache) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    constexpr std::size_t kSteps = 8;
    const auto field = [&](ValueType type, double share) {
        return TestField({66, 52, 49}, kSteps, type,
                         scaled(staying_field(random, turbulence(random), share, kSteps), 50, 1));
    };
    const TestField values = field(ValueType::f32, 0.9), flow = field(ValueType::u8, 0.9),
                    hue = field(ValueType::i16, 0.5);
    with_arrays(folder, values.view(), flow.view(), hue.view());
    std::uint64_t reused = 0, coarse = 0, colored = 0;
    constexpr int kWhole = 80;
    const int kSets = std::max(kWhole / 2, tries(kWhole));
    for (const auto& [shading, cache] :
         {std::pair(Shading::none, 1 << 20), std::pair(Shading::cells, 1 << 20),
          std::pair(Shading::cells, 1 << 30)}) {
        const auto file =
            IndexFile::open(folder.path() / "a.isochron", static_cast<std::uint64_t>(cache));
        ASSERT_EQ(file->better_whole(0), cache > 1 << 20);
        const Extract kept = extract_from_newest(std::make_shared<NewestIndex>(file), shading);
        Walk walk(random, values.view());
        for (int i = 0; i < kSets; ++i) {
            walk.next();
            SurfacesQuery& query = walk.query();
            query.mesh_room = shading == Shading::cells && walk.chance(3) > 0 ? 1 << 28 : 0;
            if (walk.chance(3) == 0)
                query.coloring = static_cast<CellColoring>(walk.chance(3));
            if (walk.chance(12) == 0)
                query.array = walk.chance(2);
            if (walk.chance(6) == 0)
                query.detail.most_cells = std::array{0u, 6'000u, 40'000u, 400'000u}[walk.chance(4)];
            const ExtractionPtr found = kept(query, {});
            const ExtractionPtr anew =
                extract_from(array_of(file, query.array), std::nullopt, shading)(query, {});
            ASSERT_NO_FATAL_FAILURE(expect_same(*found, *anew)) << i;
            reused += found->reused();
            coarse += found->coarse() ? 1 : 0;
            colored +=
                found->meshed() && query.coloring == CellColoring::value && found->reused() > 0;
        }
    }
    EXPECT_GT(kWhole * reused, kSets * 10'000u);
    EXPECT_GT(kWhole * coarse, kSets * 10u);
    EXPECT_GT(colored, 0u);
}

TEST(KeptExtraction, DecodesAStepAsAWholeWhereItsIsovalueIsDragged) {
    const TestFolder folder;
    std::mt19937 random(test_seed());
    // More than what is always decoded as a whole.
    const TestField field({120, 110, 100}, 1, ValueType::f32, turbulence(random, 3));
    const StepValues values = field.view();
    const auto file = indexed(folder, values, {.tiers = TierSet().with(Tier::bricks)});
    const auto other = IndexFile::open(folder.path() / "a.isochron");
    const Extract extract = extract_from(file), anew = extract_from(other, SearchMethod::bricks);
    const auto isovalues = quantiles(sorted_values(values), 41);
    int as_a_whole = 0;
    for (std::size_t i = 0; i < 24; ++i) {
        const SurfacesQuery query{Instant(0), {isovalues[8 + i]}};
        const ExtractionPtr found = extract(query, {});
        as_a_whole += file->chunks().holds_whole(0);
        ASSERT_NO_FATAL_FAILURE(expect_same(*found, *anew(query, {}))) << i;
        ASSERT_TRUE(as_a_whole > 0 || i < 20);
    }
    EXPECT_GT(as_a_whole, 3);
}

TEST(KeptExtraction, GoesOnWhereAnIndexGrows) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::f32, ValueType::f64}) {
        const TestFolder folder;
        const std::filesystem::path path = folder.path() / "a.isochron";
        constexpr std::size_t kSteps = 6;
        const TestField field(
            {40, 36, 35}, kSteps, type,
            scaled(staying_field(random, turbulence(random), 0.9, kSteps), 50, 1));
        StepValues values = field.view();
        values.steps = 2;
        const double isovalue = quantiles(sorted_values(values), 3)[1];
        indexed(folder, values);
        const auto newest = std::make_shared<NewestIndex>(IndexFile::open(path));
        const Extract extract = extract_from_newest(newest, Shading::cells);
        extract({Instant(1), {isovalue}}, {});
        std::uint64_t reused = 0;
        for (values.steps = 3; values.steps <= kSteps; ++values.steps) {
            const std::shared_ptr<const IndexFile> held = IndexFile::open(path);
            const auto all = append_to(held, "a", std::make_unique<MemorySeries>(values));
            GrowingFile file(path, true);
            append_index(*all, *held, file, path, {}, {}, *alone());
            newest->set(IndexFile::open(path));
            const SurfacesQuery query{Instant(static_cast<std::uint32_t>(values.steps - 1)),
                                      {isovalue}};
            const ExtractionPtr found = extract(query, {});
            ASSERT_NO_FATAL_FAILURE(expect_same(
                *found, *extract_from(newest->get(), std::nullopt, Shading::cells)(query, {})));
            reused += found->reused();
        }
        EXPECT_GT(reused, 0u) << name_of(type);
    }
}

} // namespace
} // namespace isochron::index
