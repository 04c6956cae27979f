// Builds .isochron files: one pass over the sources of all arrays, then their trees, then their
// sections.
#include "index/indexing/index_build.h"

#include "index/error.h"
#include "index/file/blend_advice.h"
#include "index/file/sections/file_layout.h"
#include "index/indexing/array_build.h"
#include "index/indexing/color_pass.h"
#include "index/indexing/section_writer.h"
#include "index/indexing/volume_pass.h"
#include "index/indexing/work_progress.h"
#include "index/system/byte_source.h"
#include "index/system/input_file.h"
#include "index/system/parallel.h"

#include <array>
#include <deque>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::uint64_t kMostVertices = std::uint64_t{1} << 35; ///< in a step that is shown

/// Refuses to replace a file that is not an index, so that a typing error does not destroy data.
void refuse_foreign_file(const std::filesystem::path& out) {
    std::error_code ignored;
    if (!std::filesystem::exists(out, ignored))
        return;
    std::array<char, 8> start{};
    const std::size_t got = InputFile(out).read(0, std::as_writable_bytes(std::span(start)));
    if (got > 0 && start != FileHeader{}.magic)
        throw Error("{}: exists and is not an isochron index: not replaced", out.string());
}

/// A new index can be shown. One that holds a larger grid, as others could be built, may still grow.
void check_can_be_shown(const Grid& grid) {
    if (grid.vertex_count() > kMostVertices)
        throw Error("{} vertices, expected at most 2^35 in a step; --crop reads a part of the "
                    "grid, --stride 2 every second vertex",
                    grid.vertex_count());
}

void check_array(const SeriesInfo& info, const BuildOptions& options, bool is_new) {
    check_limits(info);
    if (is_new)
        check_can_be_shown(info.grid);
    const bool tree = options.with_tree || (options.tiers && options.tiers->has(Tier::tree));
    if (tree && has_wide_ids(info.grid))
        throw Error("{} cells, expected fewer than 2^32 for the tier tree", info.grid.cell_count());
    if (options.referral && has_wide_ids(info.grid))
        throw Error("{} cells, expected fewer than 2^32 for an index that refers to its sources",
                    info.grid.cell_count());
}

void check_options(const SeriesInfo& info, const BuildOptions& options, bool is_new) {
    try {
        check_array(info, options, is_new);
        if (options.color)
            expect_colors_of(options.color->info(), info);
        if (options.further.size() >= kMostArrays)
            throw Error("{} arrays, expected at most {}", options.further.size() + 1, kMostArrays);
        std::set<std::string> names{info.array};
        for (const FurtherArray& array : options.further) {
            const SeriesInfo& further = array.series->info();
            check_array(further, options, is_new);
            expect_colors_of(further, info);
            if (further.grid != info.grid)
                throw Error("arrays {} and {} lie at different places", info.array, further.array);
            if (!names.insert(further.array).second)
                throw Error("array {} is given twice", further.array);
        }
    } catch (const Error& error) {
        throw Error("{}: {}", info.sources.empty() ? "series" : info.sources.front(), error.what());
    }
}

/// The options of an array besides the first.
BuildOptions options_of(const FurtherArray& array, const BuildOptions& all) {
    BuildOptions options = all;
    options.array = array.array;
    options.component = array.component;
    options.plan = array.plan;
    if (options.referral) {
        options.referral->options.array = array.array;
        options.referral->options.component = array.component;
    }
    options.color = nullptr;
    options.further.clear();
    return options;
}

/// The arrays that are built together.
class Arrays {
  public:
    Arrays(VolumeSeries& first, const std::filesystem::path& out, const BuildOptions& all,
           const Progress& progress, Team& team, BuildTarget& target, const IndexFile* held)
        : work_(progress) {
        for (std::size_t number = 0; number <= all.further.size(); ++number) {
            const FurtherArray* further = number > 0 ? &all.further[number - 1] : nullptr;
            options_.push_back(further ? options_of(*further, all) : all);
            builds_.emplace_back(further ? *further->series : first, out, options_.back(), number,
                                 team, target, held ? &held->array(number) : nullptr);
        }
    }

    /// Reads every step once, writes its chunks, then the trees of one array after the other.
    void write(const PassTarget& to, std::size_t fresh, Team& team) {
        plan_work();
        std::vector<ArrayPass> passes;
        for (ArrayBuild& build : builds_) {
            passes.push_back(build.pass());
            passes.back().means.lends |= builds_.size() > 1;
        }
        std::vector<VolumeFindings> found =
            read_volumes(passes, fresh, to, team, [this](std::string_view phase, double done) {
                work_.report(phase, done);
            });
        for (std::size_t number = 0; number < builds_.size(); ++number)
            builds_[number].take(std::move(found[number]));
        double before = 0;
        for (ArrayBuild& build : builds_) {
            const double own = build.work().indexing;
            to.end = build.write_tree(to.end, [&](std::string_view phase, double done) {
                work_.report(phase, indexing_ > 0 ? (before + own * done) / indexing_ : done);
            });
            before += own;
        }
    }

    std::vector<ArraySections> take_sections() {
        std::vector<ArraySections> sections;
        for (ArrayBuild& build : builds_)
            sections.push_back(build.take_sections());
        return sections;
    }

    /// Reports that all is written, but not flushed to disk.
    void report_flushing() { work_.report("flushing to disk", 0); }

  private:
    /// Flushing takes a twentieth of all the rest.
    void plan_work() {
        double reading = 0;
        indexing_ = 0;
        for (const ArrayBuild& build : builds_) {
            reading += build.work().reading;
            indexing_ += build.work().indexing;
        }
        std::vector<std::pair<std::string, double>> phases{{"reading", reading}};
        for (const char* of_tree : {"dividing span space", "finding coherence", "sorting lists"})
            phases.emplace_back(of_tree, indexing_ / 3);
        phases.emplace_back("flushing to disk", (reading + indexing_) / 20);
        work_.plan(std::move(phases));
    }

    WorkProgress work_;
    double indexing_ = 0;              ///< the work of all arrays
    std::deque<BuildOptions> options_; ///< deques, since the builds refer to the options
    std::deque<ArrayBuild> builds_;
};

/// Measures what blends between the steps are worth, on the values as they lie in the file by now.
/// What cannot be measured is measured by whoever asks for it.
void measure(ArraySections& array, const ByteSource& written, std::uint32_t version) {
    constexpr std::uint64_t kCache = 32 << 20;
    Metadata& metadata = array.metadata;
    ChunkArray volume{.called = "volume",
                      .info = metadata.info,
                      .steps = array.steps,
                      .has_bricks = metadata.plan.tiers.has(Tier::bricks),
                      .has_values = !metadata.referral,
                      .has_since = version > kVersionWithoutSince};
    volume.steps.resize(metadata.info.steps()); // steps of the volume itself come first
    try {
        ByteCache cache(kCache);
        const ChunkStore store(written, cache, std::move(volume));
        metadata.blends = measure_blends(store, metadata.stats);
    } catch (const Error&) {
    }
}

/// Writes all arrays, then their sections. @return what was written, on rank 0
std::shared_ptr<const IndexFile> build_arrays(VolumeSeries& first, const std::filesystem::path& out,
                                              const BuildOptions& all, const Progress& progress,
                                              Team& team, BuildTarget& target,
                                              const IndexFile* held) {
    const auto written = [&] { return open_local_bytes(target.path_to_read(out), out); };
    Arrays arrays(first, out, all, progress, team, target, held);
    std::uint64_t end = align_up(held ? held->header().file_bytes : kDataBegin, kPartAlignment);
    arrays.write({target.sink(), end, out.string() + ".chunks", thread_count(all.threads)},
                 held ? held->info().steps() : 0, team);
    FileHeader header;
    header.version = held ? held->header().version : kFileVersion;
    header.sequence = held ? held->header().sequence + 1 : 0;
    team.together([&] {
        if (team.rank() > 0)
            return;
        auto sections = arrays.take_sections();
        const auto values = written();
        for (ArraySections& array : sections) {
            array.metadata.blends.reset();
            if (all.measures_blends)
                measure(array, *values, header.version);
        }
        write_sections(sections, held, end, header, target.sink());
    });
    arrays.report_flushing();
    std::shared_ptr<const IndexFile> built;
    target.commit(header, [&] { built = IndexFile::open(written()); });
    return built;
}

} // namespace

std::shared_ptr<const IndexFile> build_index(VolumeSeries& series, const std::filesystem::path& out,
                                             const BuildOptions& options, const Progress& progress,
                                             Team& team) {
    check_options(series.info(), options, true);
    NewTarget target(team, out);
    if (!options.replaces_any)
        team.together([&] { refuse_foreign_file(out); });
    return build_arrays(series, out, options, progress, team, target, nullptr);
}

std::shared_ptr<const IndexFile> build_index(VolumeSeries& series, const std::filesystem::path& out,
                                             const BuildOptions& options,
                                             const Progress& progress) {
    return build_index(series, out, options, progress, *alone());
}

std::shared_ptr<const IndexFile> append_index(VolumeSeries& series, const IndexFile& held,
                                              GrowingSink& file, const std::filesystem::path& out,
                                              const BuildOptions& options, const Progress& progress,
                                              Team& team) {
    check_options(series.info(), options, false);
    GrowingTarget target(team, file, held.header());
    return build_arrays(series, out, options, progress, team, target, &held);
}

} // namespace isochron::index
