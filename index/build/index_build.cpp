// Building of .isochron files: one pass over the series, then the tiers over what was written.
#include "index/build/index_build.h"

#include "index/build/chunk_pass.h"
#include "index/build/color_pass.h"
#include "index/build/tier_plan.h"
#include "index/build/unit_pass.h"
#include "index/build/volume_pass.h"
#include "index/error.h"
#include "index/file/file_layout.h"
#include "index/file/metadata.h"
#include "index/system/input_file.h"
#include "index/system/mapped_file.h"
#include "index/system/new_file.h"
#include "index/system/parallel.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <optional>

namespace isochron::index {
namespace {

/// A slip of the hand must not cost anybody a volume.
void refuse_foreign_file(const std::filesystem::path& out) {
    std::error_code ignored;
    if (!std::filesystem::exists(out, ignored))
        return;
    std::array<char, 8> start{};
    const std::size_t got = InputFile(out).read(0, std::as_writable_bytes(std::span(start)));
    if (got > 0 && start != FileHeader{}.magic)
        throw Error(
            fmt::format("{}: exists and is not an isochron index: not replaced", out.string()));
}

/// Of everything that decides what a query answers and where it lies.
std::uint64_t content_hash(const SeriesInfo& info, std::span<const std::uint64_t> checksums) {
    std::vector<double> numbers(info.grid.vertices.begin(), info.grid.vertices.end());
    for (const glm::dvec3& v : {info.grid.origin, info.grid.spacing, info.grid.direction[0],
                                info.grid.direction[1], info.grid.direction[2]})
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
    numbers.insert(numbers.end(),
                   {static_cast<double>(info.type), info.scaling.slope, info.scaling.intercept});
    numbers.insert(numbers.end(), info.times.begin(), info.times.end());
    return XXH3_64bits_withSeed(numbers.data(), numbers.size() * sizeof(double),
                                checksum_of(std::as_bytes(checksums)));
}

/// A new file of all members of the team, made by the first.
class TeamFile {
  public:
    TeamFile(Team& team, const std::filesystem::path& target) : team_(team) {
        std::string temporary;
        team.together([&] {
            if (team.rank() == 0) {
                file_.emplace(target);
                file_->remove_remains();
                temporary = file_->temporary().string();
            }
        });
        const auto names = team.gather(std::as_bytes(std::span(temporary)));
        team.together([&] {
            if (team.rank() > 0)
                file_.emplace(
                    target, std::filesystem::path(std::string(
                                reinterpret_cast<const char*>(names[0].data()), names[0].size())));
        });
    }

    NewFile& operator*() { return *file_; }
    NewFile* operator->() { return &*file_; }

    void commit() {
        team_.together([&] {
            if (team_.rank() > 0)
                file_->commit();
        });
        team_.together([&] {
            if (team_.rank() == 0)
                file_->commit();
        });
    }

  private:
    Team& team_;
    std::optional<NewFile> file_;
};

/// The sections of the file in the making.
class Build {
  public:
    Build(VolumeSeries& series, const std::filesystem::path& out, const BuildOptions& options,
          const Progress& progress, Team& team)
        : series_(series), out_(out), options_(options), progress_(progress), team_(team),
          threads_(thread_count(options.threads)), file_(team, out),
          values_file_(team, out.string() + ".volume"), metadata_{.info = series.info(),
                                                                  .codec = options.codec,
                                                                  .tree = options.tree,
                                                                  .referral = options.referral} {}

    void run() {
        team_.together([&] { refuse_foreign_file(out_); });
        read_steps();
        team_.together([&] { written_.emplace(values_file_->temporary()); });
        const SeriesInfo& info = metadata_.info;
        values_ = {.grid = info.grid,
                   .type = info.type,
                   .scaling = info.scaling,
                   .steps = info.steps(),
                   .first = written_->bytes().data(),
                   .stride = step_stride(info.step_bytes())};
        IndexStats& stats = metadata_.stats;
        stats.histogram =
            count_values(values_, *written_, stats.low, stats.high, threads_, team_, progress_);
        team_.together([&] {
            metadata_.plan = plan_tiers(values_, *metadata_.levels, options_.tiers);
            if (options_.with_tree)
                metadata_.plan.tiers = metadata_.plan.tiers.with(Tier::tree);
        });
        write_volume();
        write_colors();
        write_cells();
        team_.together([&] {
            if (team_.rank() == 0)
                write_rest();
        });
        if (progress_)
            progress_("flushing to disk", 0.0);
        file_.commit();
    }

  private:
    bool has(Tier tier) const { return metadata_.plan.tiers.has(tier); }

    void read_steps() {
        const SeriesInfo& info = metadata_.info;
        team_.together([&] {
            if (team_.rank() == 0)
                values_file_->reserve(info.steps() * step_stride(info.step_bytes()));
        });
        VolumeFindings found = read_volume(series_, *values_file_, 0, team_, progress_);
        metadata_.stats.low = found.low;
        metadata_.stats.high = found.high;
        metadata_.stats.nan_values = found.nan_values;
        metadata_.levels = std::move(found.levels);
        header_.content_hash = content_hash(info, found.checksums);
        checksums_ = std::move(found.checksums);
    }

    /// Of the sections that are made in parts, which begin where pages do.
    Section& begin(SectionKind kind) {
        Section& section = header_.section(kind);
        section.offset = align_up(end_, kSectionAlignment);
        return section;
    }

    ChunkContents contents() const {
        return {has(Tier::bricks), !options_.referral, options_.codec};
    }
    std::string spill(const char* what) const { return out_.string() + what; }

    void write_volume() {
        Section& section = begin(SectionKind::volume);
        ChunkFindings found =
            write_chunks(values_, *written_, *metadata_.levels, contents(), *file_, section.offset,
                         spill(".chunks"), threads_, team_, progress_);
        section.bytes = found.bytes;
        end_ = section.offset + section.bytes;
        steps_ = std::move(found.steps);
    }

    void write_cells() {
        if (!has(Tier::cells))
            return;
        Section& section = begin(SectionKind::units);
        UnitFindings units =
            write_units(values_, *written_, *metadata_.levels, has(Tier::deltas), *file_,
                        section.offset, spill(".units"), threads_, team_, progress_);
        section.bytes = units.bytes;
        end_ = section.offset + section.bytes;
        directory_ = std::move(units.directory);
        metadata_.stats.cell_entries = units.entries;
        append_checksums(units.checksums);
    }

    void write_colors() {
        if (!options_.color)
            return;
        Section& section = header_.section(SectionKind::volume);
        const std::uint64_t before = align_up(section.bytes, kPartAlignment);
        ColorFindings found =
            read_colors(*options_.color, contents(), *file_, section.offset + before,
                        spill(".colors"), threads_, team_, progress_);
        for (StepEntry& step : found.chunks.steps)
            step.offset += before;
        steps_.insert(steps_.end(), found.chunks.steps.begin(), found.chunks.steps.end());
        section.bytes = before + found.chunks.bytes;
        end_ = section.offset + section.bytes;
        color_checksums_ = std::move(found.checksums);
        metadata_.color = std::move(found.array);
        metadata_.color->chosen_array = options_.color_array;
        metadata_.color->chosen_component = options_.color_component;
    }

    void append_checksums(const std::vector<std::uint64_t>& more) {
        checksums_.insert(checksums_.end(), more.begin(), more.end());
    }

    void append(SectionKind kind, std::span<const std::byte> bytes) {
        Section& section = header_.section(kind);
        section = {align_up(end_, kPartAlignment), bytes.size(), checksum_of(bytes)};
        file_->write_at(section.offset, bytes);
        end_ = section.offset + section.bytes;
    }

    void write_rest() {
        if (has(Tier::tree))
            append(SectionKind::tree, build_thi_tree(values_, options_.tree, progress_, threads_));
        append_checksums(color_checksums_);
        append(SectionKind::steps, std::as_bytes(std::span(steps_)));
        append(SectionKind::directory, std::as_bytes(std::span(directory_)));
        append(SectionKind::checksums, std::as_bytes(std::span(checksums_)));
        const std::string text = to_json(metadata_);
        append(SectionKind::metadata, std::as_bytes(std::span(text)));
        for (Section& section : header_.sections)
            if (section.offset == 0)
                section.offset = kSectionAlignment; // an empty one lies anywhere
        header_.file_bytes = end_;
        file_->write_at(0, header_bytes(header_));
    }

    VolumeSeries& series_;
    const std::filesystem::path& out_;
    const BuildOptions& options_;
    const Progress& progress_;
    Team& team_;
    unsigned threads_;
    TeamFile file_;
    TeamFile values_file_; ///< the values as they are read; never gets its name
    Metadata metadata_;
    FileHeader header_;
    std::optional<MappedFile> written_; ///< the values, once they are complete
    StepValues values_;
    std::vector<UnitEntry> directory_;
    std::vector<std::uint64_t> checksums_;
    std::vector<StepEntry> steps_;
    std::vector<std::uint64_t> color_checksums_;
    std::uint64_t end_ = kSectionAlignment; ///< of what has been written
};

} // namespace

void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress, Team& team) {
    const SeriesInfo& info = series.info();
    try {
        check_limits(info);
        if (options.tiers)
            check_tiers(info.grid, *options.tiers);
        if (options.color)
            expect_colors_of(options.color->info(), info);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", info.sources.empty() ? "series" : info.sources.front(),
                                error.what()));
    }
    Build(series, out, options, progress, team).run();
}

void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress) {
    build_index(series, out, options, progress, *alone());
}

} // namespace isochron::index
