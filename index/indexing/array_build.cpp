// Builds one array of an index: plans the pass over its values, then makes the tiers from the
// values that the pass has kept.
#include "index/indexing/array_build.h"

#include "index/file/detail_levels.h"
#include "index/file/sections/step_levels.h"
#include "index/indexing/chunk_history.h"
#include "index/indexing/color_pass.h"
#include "index/indexing/tier_plan.h"
#include "index/indexing/unit_pass.h"
#include "index/system/mapped_file.h"
#include "index/system/parallel.h"
#include "index/thi/thi_tree.h"
#include "index/volume/stretches.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// The number of first steps that have cells after new steps have come. The steps of an epoch are in
/// one tree: new cells for an epoch that has some already mean that those are written again. They wait
/// until twice as many steps can be added, so that all appending together writes cells 1.5 times.
std::uint32_t covered_steps(std::uint32_t steps, std::uint32_t covered) {
    const std::uint32_t written_again = covered % TimePath::kMaxSteps;
    return steps - covered >= 2 * written_again ? steps : covered;
}

} // namespace

class ArrayBuild::Work {
  public:
    Work(VolumeSeries& series, const std::filesystem::path& out, const BuildOptions& options,
         std::size_t number, Team& team, BuildTarget& target, const IndexFile* held)
        : series_(series), out_(out), options_(options), number_(number), team_(team),
          threads_(thread_count(options.threads)), target_(target), held_(held),
          metadata_{.info = series.info(),
                    .codec = options.codec,
                    .tree = options.tree,
                    .referral = options.referral,
                    .chosen_array = options.array,
                    .chosen_component = options.component,
                    .reading = options.reading},
          steps_{.all = static_cast<std::uint32_t>(series.info().steps())},
          levels_(detail_grids(series.info().grid).size()) {
        if (held)
            take(*held);
        plan_cells();
        plan_tiers_ahead();
        work_ = estimated_work(kept_.file != nullptr);
    }

    const ArrayWork& work() const { return work_; }

    ArrayPass pass() {
        if (options_.color)
            team_.together([&] {
                ChunkContents values_alone = contents();
                values_alone.bricks = false;
                colors_.emplace(*options_.color, steps_.fresh, held_ ? held_->color() : nullptr,
                                values_alone, means(".colors"), team_);
                if (held_ && held_->has_since())
                    colors_->hold_since(held_since(*held_, true));
            });
        std::vector<std::uint32_t> since;
        team_.together([&] {
            if (held_ && held_->has_since())
                since = held_since(*held_, false);
        });
        return {series_,         steps_.window,    kept_,
                contents(),      means(".chunks"), colors_ ? &*colors_ : nullptr,
                std::move(since)};
    }

    bool take(VolumeFindings found) {
        counts_.merge(metadata_.info.type, found.counts);
        set_counts(metadata_, counts_);
        metadata_.stats.staying = held_stay_ + found.stayed;
        append_to(tables_.checksums, found.checksums);
        append_to(tables_.states, found.states);
        append_steps(tables_.volume_steps, found.steps);
        if (found.colors)
            take_colors(std::move(*found.colors));
        found_levels_ = std::move(found.levels);
        content_hash_ = content_hash_of(metadata_.info, tables_.checksums);
        if (held_ && !fits_held_levels())
            return false;
        take_kept_values();
        if (!held_)
            plan();
        work_ = estimated_work(has(Tier::cells));
        return true;
    }

    std::uint64_t write_tiers(std::uint64_t end, const Progress& progress) {
        end_ = end;
        write_cells(progress);
        team_.together([&] {
            if (team_.rank() == 0)
                write_tree(progress);
        });
        end_ = team_.gather_items(std::vector{end_}).front();
        written_.reset();
        scratch_.reset();
        return end_;
    }

    ArraySections take_sections() {
        ArraySections sections{.content_hash = content_hash_,
                               .tree = tree_,
                               .steps = {},
                               .directory = std::move(tables_.directory),
                               .checksums = std::move(tables_.checksums),
                               .metadata = std::move(metadata_)};
        for (const auto* array : {&tables_.volume_steps, &tables_.color_steps})
            for (const std::vector<StepEntry>& level : *array)
                append_to(sections.steps, level);
        append_to(sections.checksums, tables_.unit_checksums);
        append_to(sections.checksums, tables_.color_checksums);
        append_to(sections.checksums, tables_.states);
        return sections;
    }

  private:
    /// The rows that the sections of the file get, as far as they are known.
    struct ArrayTables {
        std::vector<UnitEntry> directory;
        std::vector<std::uint64_t> checksums, unit_checksums, color_checksums, states;
        std::vector<std::vector<StepEntry>> volume_steps, color_steps; ///< by level of detail
    };

    /// Which steps are read, and which get cells.
    struct StepsToBuild {
        std::uint32_t all = 0;         ///< steps of the series
        std::size_t fresh = 0;         ///< the first step that is not held
        std::size_t window = 0;        ///< the first step whose values are needed
        std::uint32_t covered = 0;     ///< number of first steps that cells hold
        std::uint32_t first_epoch = 0; ///< the first epoch whose cells are built
    };

    bool has(Tier tier) const { return metadata_.plan.tiers.has(tier); }

    template <class T, class From>
    static void append_to(std::vector<T>& to, const From& more) {
        to.insert(to.end(), more.begin(), more.end());
    }

    /// @param more level after level
    void append_steps(std::vector<std::vector<StepEntry>>& array, std::span<const StepEntry> more) {
        array.resize(levels_);
        const std::size_t count = more.size() / levels_;
        for (std::size_t level = 0; level < levels_; ++level)
            append_to(array[level], more.subspan(level * count, count));
    }

    /// Takes over the parts that an index has already; they stay where they are.
    void take(const IndexFile& held) {
        const Metadata& known = held.metadata();
        steps_.fresh = known.info.steps();
        metadata_.earlier = known.earlier;
        metadata_.earlier.push_back(held.content_hash());
        metadata_.plan = known.plan;
        metadata_.levels = known.levels;
        counts_ = known.stats.counts;
        held_stay_ = known.stats.staying;
        append_steps(tables_.volume_steps, held.step_entries().first(steps_.fresh * levels_));
        append_to(tables_.checksums, held.checksums().first(steps_.fresh));
        append_to(tables_.states, held.source_states());
        if (held.color()) {
            append_steps(tables_.color_steps, held.step_entries().last(steps_.fresh * levels_));
            append_to(tables_.color_checksums, held.color_checksums());
        }
    }

    /// Decides which steps get cells, and which values must be read for them.
    void plan_cells() {
        steps_.window = steps_.fresh;
        steps_.covered = steps_.all;
        if (!held_ || !has(Tier::cells))
            return;
        const std::uint32_t known = held_->metadata().cell_steps;
        steps_.covered = covered_steps(steps_.all, known);
        steps_.first_epoch = known / TimePath::kMaxSteps;
        const std::size_t kept = steps_.covered == known
                                     ? held_->directory().size()
                                     : steps_.first_epoch * Stretches(metadata_.info.grid).count();
        append_to(tables_.directory, held_->directory().first(kept));
        append_to(tables_.unit_checksums, held_->checksums().subspan(steps_.fresh, 2 * kept));
        if (steps_.covered == known)
            return;
        const std::size_t begin = std::size_t{steps_.first_epoch} * TimePath::kMaxSteps;
        const std::size_t before = has(Tier::deltas) && begin > 0 ? 1 : 0;
        steps_.window = std::min(steps_.window, begin - before);
    }

    /// Decides what must be known before the first step is read: whether chunks have bricks, and
    /// whether values must be kept because cells or the tree may be built from them.
    void plan_tiers_ahead() {
        const SeriesInfo& info = metadata_.info;
        const auto& known = held_ ? std::optional(metadata_.plan) : options_.plan;
        bricks_ = known ? known->tiers.has(Tier::bricks)
                        : !options_.tiers || options_.tiers->has(Tier::bricks);
        if (held_) {
            kept_.always = steps_.covered != held_->metadata().cell_steps && has(Tier::cells);
        } else if (known) {
            kept_.always =
                options_.with_tree || known->tiers.has(Tier::cells) || known->tiers.has(Tier::tree);
        } else {
            kept_.always =
                options_.with_tree || (options_.tiers && asks_for_values(*options_.tiers));
        }
        if (!kept_.always && (held_ || known || options_.tiers || !cells_may_pay(info)))
            return;
        scratch_.emplace(team_, spill(".volume"));
        team_.together([&] {
            kept_.file = &scratch_->sink();
            if (team_.rank() == 0 && kept_.always)
                scratch_->sink().reserve((info.steps() - steps_.window) *
                                         step_stride(info.step_bytes()));
        });
    }

    /// Building cells takes about four times as long as reading and packing.
    ArrayWork estimated_work(bool cells) const {
        const auto step = static_cast<double>(metadata_.info.step_bytes());
        const auto fresh = static_cast<double>(steps_.all - steps_.fresh);
        const auto window = static_cast<double>(steps_.all - steps_.window);
        const double colors =
            options_.color ? fresh * static_cast<double>(options_.color->info().step_bytes()) : 0;
        return {step * window + colors, cells ? 4 * step * window : 0};
    }

    static bool asks_for_values(const TierSet& tiers) {
        return tiers.has(Tier::cells) || tiers.has(Tier::tree);
    }

    void take_kept_values() {
        const SeriesInfo& info = metadata_.info;
        values_ = {.grid = info.grid,
                   .type = info.type,
                   .scaling = info.scaling,
                   .steps = info.steps(),
                   .first = nullptr,
                   .stride = step_stride(info.step_bytes()),
                   .first_step = steps_.window};
        if (!kept_.file)
            return;
        team_.together([&] { written_.emplace(scratch_->sink().path_to_open()); });
        values_.first = written_->bytes().data();
    }

    /// Whether the levels of the existing cells have every value of the new steps.
    bool fits_held_levels() const {
        if (!has(Tier::cells) || !metadata_.levels->lossless() ||
            !has_step_levels(metadata_.info.type))
            return true;
        if (!found_levels_->lossless())
            return false;
        const auto known = metadata_.levels->distinct(), given = found_levels_->distinct();
        return std::ranges::includes(known, given);
    }

    void plan() {
        team_.together([&] {
            const bool keeps = options_.plan && (found_levels_->lossless() ||
                                                 !options_.plan->tiers.has(Tier::deltas));
            metadata_.plan =
                keeps ? *options_.plan
                      : plan_tiers(values_, *found_levels_, options_.tiers, chunks_over_values());
            if (options_.with_tree)
                metadata_.plan.tiers = metadata_.plan.tiers.with(Tier::tree);
            if (!keeps) {
                metadata_.plan.steps = steps_.all;
                metadata_.plan.tiers = metadata_.plan.tiers.with(Tier::bricks, bricks_);
            }
        });
        if (has(Tier::cells))
            metadata_.levels = found_levels_;
    }

    /// Bytes of the chunks of all levels of detail, with their tables, for each byte of values.
    double chunks_over_values() const {
        std::uint64_t bytes = 0;
        for (const std::vector<StepEntry>& level : tables_.volume_steps)
            for (const StepEntry& step : level)
                bytes += step.bytes;
        return static_cast<double>(bytes) /
               (static_cast<double>(metadata_.info.step_bytes()) * steps_.all);
    }

    ChunkContents contents() const {
        return {bricks_, !options_.referral, options_.codec, !held_ || held_->has_since(),
                !held_ || held_->has_wide_rows()};
    }
    WriterMeans means(const char* what) const {
        return {threads_, options_.waiting_bytes, spill(what), options_.color != nullptr};
    }
    std::string spill(const char* what) const {
        return out_.string() + what + (number_ > 0 ? std::to_string(number_) : "");
    }
    /// Moves the end to where the next part begins.
    void align() { end_ = align_up(end_, kPartAlignment); }

    void take_colors(ColorFindings&& found) {
        append_steps(tables_.color_steps, found.steps);
        append_to(tables_.color_checksums, found.checksums);
        metadata_.color = std::move(found.array);
        metadata_.color->chosen_array = options_.color_array;
        metadata_.color->chosen_component = options_.color_component;
    }

    void write_cells(const Progress& progress) {
        if (!has(Tier::cells))
            return;
        metadata_.cell_steps = steps_.covered;
        if (held_ && held_->metadata().cell_steps == steps_.covered)
            return;
        align();
        StepValues covered = values_;
        covered.steps = steps_.covered;
        const UnitFindings units = write_units(covered, steps_.first_epoch, *written_,
                                               *metadata_.levels, has(Tier::deltas), target_.sink(),
                                               end_, spill(".units"), threads_, team_, progress);
        append_to(tables_.directory, units.directory);
        append_to(tables_.unit_checksums, units.checksums);
    }

    void write_tree(const Progress& progress) {
        align();
        const std::vector<std::byte> tree =
            has(Tier::tree) ? build_thi_tree(values_, options_.tree, progress, threads_)
                            : std::vector<std::byte>();
        tree_ = {end_, tree.size(), checksum_of(tree)};
        target_.sink().write_at(end_, tree);
        end_ += tree.size();
        align();
    }

    VolumeSeries& series_;
    const std::filesystem::path& out_;
    const BuildOptions& options_;
    std::size_t number_; ///< number of the array in the index
    Team& team_;
    unsigned threads_;
    BuildTarget& target_;
    std::optional<NewTarget> scratch_; ///< the kept values; never committed
    KeptValues kept_;
    std::optional<ColorPass> colors_;
    ArrayWork work_;
    bool bricks_ = true; ///< in the chunks
    const IndexFile* held_;
    Metadata metadata_;
    std::uint64_t content_hash_ = 0;
    Section tree_;
    StepsToBuild steps_;
    std::size_t levels_; ///< number of levels of detail
    ValueCounts counts_;
    std::uint64_t held_stay_ = 0; ///< chunk-steps of the held ones that are as in the step before
    std::optional<LevelMap> found_levels_; ///< levels of the new steps together
    std::optional<MappedFile> written_;    ///< the values, once they are complete
    StepValues values_;
    ArrayTables tables_;
    std::uint64_t end_ = 0; ///< end of what has been written
};

ArrayBuild::ArrayBuild(VolumeSeries& series, const std::filesystem::path& out,
                       const BuildOptions& options, std::size_t number, Team& team,
                       BuildTarget& target, const IndexFile* held)
    : work_(std::make_unique<Work>(series, out, options, number, team, target, held)) {}

ArrayBuild::~ArrayBuild() = default;

ArrayWork ArrayBuild::work() const {
    return work_->work();
}
ArrayPass ArrayBuild::pass() {
    return work_->pass();
}
bool ArrayBuild::take(VolumeFindings found) {
    return work_->take(std::move(found));
}
std::uint64_t ArrayBuild::write_tiers(std::uint64_t end, const Progress& progress) {
    return work_->write_tiers(end, progress);
}
ArraySections ArrayBuild::take_sections() {
    return work_->take_sections();
}

} // namespace isochron::index
