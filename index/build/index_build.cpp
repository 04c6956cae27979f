// Builds .isochron files: array after array, then the sections of all.
#include "index/build/index_build.h"

#include "index/build/array_build.h"
#include "index/build/color_pass.h"
#include "index/build/section_writer.h"
#include "index/error.h"
#include "index/file/file_layout.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochron::index {
namespace {

/// Refuses to replace a file that is not an index, so that a typing error does not destroy data.
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

void check_array(const SeriesInfo& info, const BuildOptions& options) {
    check_limits(info);
    if (options.tiers)
        check_tiers(info.grid, *options.tiers);
    if (options.with_tree)
        check_tiers(info.grid, TierSet().with(Tier::tree));
    if (options.referral && has_wide_ids(info.grid))
        throw Error(fmt::format("{} cells, expected fewer than 2^32 for an index that refers to "
                                "its sources",
                                info.grid.cell_count()));
}

void check_options(const SeriesInfo& info, const BuildOptions& options) {
    try {
        check_array(info, options);
        if (options.color)
            expect_colors_of(options.color->info(), info);
        if (options.further.size() >= kMostArrays)
            throw Error(fmt::format("{} arrays, expected at most {}", options.further.size() + 1,
                                    kMostArrays));
        std::set<std::string> names{info.array};
        for (const FurtherArray& array : options.further) {
            const SeriesInfo& further = array.series->info();
            check_array(further, options);
            expect_colors_of(further, info);
            if (further.grid != info.grid)
                throw Error(fmt::format("arrays {} and {} lie at different places", info.array,
                                        further.array));
            if (!names.insert(further.array).second)
                throw Error(fmt::format("array {} is given twice", further.array));
        }
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", info.sources.empty() ? "series" : info.sources.front(),
                                error.what()));
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

/// Writes the arrays one after the other, then all their sections.
/// @return false if appending is impossible
bool build_arrays(VolumeSeries& first, const std::filesystem::path& out, const BuildOptions& all,
                  const Progress& progress, Team& team, BuildTarget& target,
                  const IndexFile* held) {
    struct One {
        BuildOptions options;
        Progress progress;
        std::unique_ptr<ArrayBuild> build;
    };
    std::vector<std::unique_ptr<One>> arrays;
    std::uint64_t end = held ? held->header().file_bytes : kDataBegin;
    const std::size_t count = all.further.size() + 1;
    for (std::size_t number = 0; number < count; ++number) {
        One& one = *arrays.emplace_back(std::make_unique<One>());
        one.options = number == 0 ? all : options_of(all.further[number - 1], all);
        one.progress = [&progress, number, count](std::string_view phase, double done) {
            if (progress)
                progress(phase, (static_cast<double>(number) + done) / static_cast<double>(count));
        };
        one.build = std::make_unique<ArrayBuild>(
            number == 0 ? first : *all.further[number - 1].series, out, one.options, one.progress,
            team, target, held ? &held->array(number) : nullptr, end);
        if (!one.build->write_parts())
            return false;
        end = one.build->end();
    }
    FileHeader header;
    header.sequence = held ? held->header().sequence + 1 : 0;
    team.together([&] {
        if (team.rank() > 0)
            return;
        std::vector<ArraySections> sections;
        for (const auto& one : arrays)
            sections.push_back(one->build->take_sections());
        write_sections(sections, held, end, header, target.sink());
    });
    arrays.back()->build->report_flushing();
    target.commit(header);
    return true;
}

} // namespace

void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress, Team& team) {
    check_options(series.info(), options);
    NewTarget target(team, out);
    team.together([&] { refuse_foreign_file(out); });
    build_arrays(series, out, options, progress, team, target, nullptr);
}

void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress) {
    build_index(series, out, options, progress, *alone());
}

bool append_index(VolumeSeries& series, const IndexFile& held, GrowingSink& file,
                  const std::filesystem::path& out, const BuildOptions& options,
                  const Progress& progress, Team& team) {
    check_options(series.info(), options);
    GrowingTarget target(team, file, held.header());
    return build_arrays(series, out, options, progress, team, target, &held);
}

} // namespace isochron::index
