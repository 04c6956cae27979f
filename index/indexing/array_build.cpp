// Builds one array of an index: plans the pass over its values, then makes the paper's tree from the
// values that the pass has kept.
#include "index/indexing/array_build.h"

#include "index/file/detail_levels.h"
#include "index/indexing/chunk_history.h"
#include "index/indexing/color_pass.h"
#include "index/paper/thi_tree.h"
#include "index/system/mapped_file.h"
#include "index/system/parallel.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {

class ArrayBuild::Work {
  public:
    Work(VolumeSeries& series, const std::filesystem::path& out, const BuildOptions& options,
         std::size_t number, Team& team, BuildTarget& target, const IndexFile* held)
        : series_(series), out_(out), options_(options), number_(number), team_(team),
          threads_(thread_count(options.threads)), target_(target),
          held_(held), metadata_{.info = series.info(),
                                 .codec = options.codec,
                                 .tree = options.tree,
                                 .referral = options.referral,
                                 .chosen_array = options.array,
                                 .chosen_component = options.component,
                                 .reading = options.reading},
          steps_(static_cast<std::uint32_t>(series.info().steps())),
          levels_(detail_grids(series.info().grid).size()) {
        if (held)
            take(*held);
        else
            metadata_.plan = planned();
        if (!held && has(Tier::tree))
            keep_values();
    }

    /// Building the tree takes about four times as long as reading and packing.
    ArrayWork work() const {
        const auto step = static_cast<double>(metadata_.info.step_bytes());
        const auto fresh = static_cast<double>(steps_ - fresh_);
        const double colors =
            options_.color ? fresh * static_cast<double>(options_.color->info().step_bytes()) : 0;
        return {step * fresh + colors, scratch_ ? 4 * step * fresh : 0};
    }

    ArrayPass pass() {
        if (options_.color)
            team_.together([&] {
                ChunkContents values_alone = contents();
                values_alone.bricks = false;
                colors_.emplace(*options_.color, fresh_, held_ ? held_->color() : nullptr,
                                values_alone, means(".colors"), team_);
                if (held_ && held_->has_since())
                    colors_->hold_since(held_since(*held_, true));
            });
        std::vector<std::uint32_t> since;
        team_.together([&] {
            if (held_ && held_->has_since())
                since = held_since(*held_, false);
        });
        return {series_,          scratch_ ? &scratch_->sink() : nullptr, contents(),
                means(".chunks"), colors_ ? &*colors_ : nullptr,          std::move(since)};
    }

    void take(VolumeFindings found) {
        counts_.merge(metadata_.info.type, found.counts);
        set_counts(metadata_, counts_);
        metadata_.stats.staying = held_stay_ + found.stayed;
        append_to(tables_.checksums, found.checksums);
        append_to(tables_.states, found.states);
        append_steps(tables_.volume_steps, found.steps);
        if (found.colors)
            take_colors(std::move(*found.colors));
        content_hash_ = content_hash_of(metadata_.info, tables_.checksums);
    }

    std::uint64_t write_tree(std::uint64_t end, const Progress& progress) {
        end_ = end;
        team_.together([&] {
            if (team_.rank() == 0)
                put_tree(progress);
        });
        end_ = team_.gather_items(std::vector{end_}).front();
        scratch_.reset();
        return end_;
    }

    ArraySections take_sections() {
        ArraySections sections{.content_hash = content_hash_,
                               .tree = tree_,
                               .steps = {},
                               .checksums = std::move(tables_.checksums),
                               .metadata = std::move(metadata_)};
        for (const auto* array : {&tables_.volume_steps, &tables_.color_steps})
            for (const std::vector<StepEntry>& level : *array)
                append_to(sections.steps, level);
        append_to(sections.checksums, tables_.color_checksums);
        append_to(sections.checksums, tables_.states);
        return sections;
    }

  private:
    /// The rows that the sections of the file get, as far as they are known.
    struct ArrayTables {
        std::vector<std::uint64_t> checksums, color_checksums, states;
        std::vector<std::vector<StepEntry>> volume_steps, color_steps; ///< by level of detail
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

    /// Takes over the parts that an index has already; they stay where they are. What is no longer
    /// used is not named again.
    void take(const IndexFile& held) {
        const Metadata& known = held.metadata();
        fresh_ = known.info.steps();
        metadata_.earlier = known.earlier;
        metadata_.earlier.push_back(held.content_hash());
        metadata_.plan = known.plan;
        counts_ = known.stats.counts;
        held_stay_ = known.stats.staying;
        append_steps(tables_.volume_steps, held.step_entries().first(fresh_ * levels_));
        append_to(tables_.checksums, held.checksums().first(fresh_));
        append_to(tables_.states, held.source_states());
        if (held.color()) {
            append_steps(tables_.color_steps, held.step_entries().last(fresh_ * levels_));
            append_to(tables_.color_checksums, held.color_checksums());
        }
    }

    /// What is asked for, else what an index that is written anew had, else bricks.
    ChosenTiers planned() const {
        ChosenTiers plan{TierSet().with(Tier::bricks),
                      {"bricks: exact with the volume, for every type and size"}};
        if (options_.plan)
            plan = *options_.plan;
        else if (options_.tiers)
            plan = {*options_.tiers, {"as asked for"}, true};
        if (options_.with_tree)
            plan.tiers = plan.tiers.with(Tier::tree);
        if (!options_.plan)
            plan.steps = steps_;
        return plan;
    }

    /// Keeps the values for the tree, which spans all steps.
    void keep_values() {
        scratch_.emplace(team_, spill(".volume"));
        team_.together([&] {
            if (team_.rank() == 0)
                scratch_->sink().reserve(steps_ * step_stride(metadata_.info.step_bytes()));
        });
    }

    ChunkContents contents() const {
        return {has(Tier::bricks), !options_.referral, options_.codec, !held_ || held_->has_since(),
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

    void put_tree(const Progress& progress) {
        align();
        std::vector<std::byte> tree;
        if (scratch_) {
            const SeriesInfo& info = metadata_.info;
            const MappedFile written(scratch_->sink().path_to_open());
            tree = build_thi_tree({.grid = info.grid,
                                   .type = info.type,
                                   .scaling = info.scaling,
                                   .steps = info.steps(),
                                   .first = written.bytes().data(),
                                   .stride = step_stride(info.step_bytes())},
                                  options_.tree, progress, threads_);
        }
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
    std::optional<NewTarget> scratch_; ///< the values, for the tree; never committed
    std::optional<ColorPass> colors_;
    const IndexFile* held_;
    Metadata metadata_;
    std::uint64_t content_hash_ = 0;
    Section tree_;
    std::uint32_t steps_;   ///< number of steps of the series
    std::size_t fresh_ = 0; ///< the first step that is not held
    std::size_t levels_;    ///< number of levels of detail
    ValueCounts counts_;
    std::uint64_t held_stay_ = 0; ///< held chunk-steps that are as in the step before
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
void ArrayBuild::take(VolumeFindings found) {
    work_->take(std::move(found));
}
std::uint64_t ArrayBuild::write_tree(std::uint64_t end, const Progress& progress) {
    return work_->write_tree(end, progress);
}
ArraySections ArrayBuild::take_sections() {
    return work_->take_sections();
}

} // namespace isochron::index
