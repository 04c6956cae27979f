// A series whose first steps come from an index that holds them already.
#include "index/indexing/appended_series.h"

#include "index/error.h"
#include "index/system/running_checksum.h"

#include <fmt/format.h>

#include <cstring>

namespace isochron::index {
namespace {

/// The function that loads one step from the index.
using Load = LoadedStep (IndexFile::*)(std::uint32_t) const;

class AppendedSeries final : public VolumeSeries {
  public:
    AppendedSeries(std::shared_ptr<const IndexFile> index, std::unique_ptr<VolumeSeries> all,
                   Load load)
        : index_(std::move(index)), all_(std::move(all)), load_(load) {}

    const SeriesInfo& info() const override { return all_->info(); }

    void read(std::size_t step, std::span<std::byte> out) override {
        if (step >= index_->info().steps())
            return all_->read(step, out);
        const LoadedStep held = ((*index_).*load_)(static_cast<std::uint32_t>(step));
        std::memcpy(out.data(), held.values.step_bytes(step).data(), out.size());
    }

    void stream(std::size_t step, const TakePiece& take) override {
        if (step >= index_->info().steps())
            return all_->stream(step, take);
        VolumeSeries::stream(step, take);
    }

    std::uint64_t state(std::size_t step) const override { return all_->state(step); }

  private:
    std::shared_ptr<const IndexFile> index_;
    std::unique_ptr<VolumeSeries> all_;
    Load load_;
};

template <class T>
bool begins_with(const std::vector<T>& all, const std::vector<T>& first) {
    return all.size() >= first.size() && std::equal(first.begin(), first.end(), all.begin());
}

/// Checks that the sources of the held steps are unchanged. Reads only the steps whose state does
/// not show it.
void expect_unchanged(const std::string& name, VolumeSeries& all, std::size_t held,
                      std::span<const std::uint64_t> checksums,
                      std::span<const std::uint64_t> states, bool read_alike) {
    RunningChecksum checksum;
    for (std::size_t step = 0; step < held; ++step) {
        if (states[step] != 0 && all.state(step) == states[step])
            continue;
        all.stream(step, [&](std::span<const std::byte> piece) { checksum.add(piece); });
        if (checksum.take() == checksums[step])
            continue;
        const std::vector<std::string>& sources = all.info().sources;
        throw Error("{}: cannot be appended to: its source {} has changed under step {}{}", name,
                    sources.size() == all.info().steps() ? sources[step]
                    : sources.empty()                    ? "?"
                                                         : sources.back(),
                    step,
                    read_alike ? ""
                               : ", or is read otherwise than by the version that built it: "
                                 "build it again without --append");
    }
}

} // namespace

std::unique_ptr<VolumeSeries> append_to(std::shared_ptr<const IndexFile> index,
                                        const std::string& name,
                                        std::unique_ptr<VolumeSeries> all) {
    const SeriesInfo &held = index->info(), &given = all->info();
    const bool read_alike = index->metadata().reading_number == kReading;
    const auto refuse = [&](const std::string& what) {
        throw Error("{}: cannot be appended to: {}{}", name, what,
                    read_alike ? ""
                               : "; it was built by a version that may have read the "
                                 "files otherwise: build it again without --append");
    };
    if (given.grid != held.grid || given.type != held.type || given.scaling != held.scaling ||
        given.array != held.array)
        refuse("the files differ from it in grid, type, scaling or array");
    // A single source of all steps may have another name now: a scan is named after its first file.
    const bool named_alike = begins_with(given.sources, held.sources);
    const bool one_source = given.sources.size() == 1 && held.sources.size() == 1;
    if (!(named_alike || one_source) || !begins_with(given.times, held.times))
        refuse(fmt::format("the files given must begin with the {} steps that it holds, {} to {}",
                           held.steps(), held.sources.empty() ? "?" : held.sources.front(),
                           held.sources.empty() ? "?" : held.sources.back()));
    const std::vector<std::uint64_t> unknown(held.steps(), 0);
    expect_unchanged(name, *all, held.steps(), index->checksums(),
                     named_alike && read_alike ? index->source_states() : unknown, read_alike);
    if (given.steps() == held.steps())
        return nullptr;
    return std::make_unique<AppendedSeries>(std::move(index), std::move(all),
                                            static_cast<Load>(&IndexFile::load));
}

std::unique_ptr<VolumeSeries> append_colors_to(std::shared_ptr<const IndexFile> index,
                                               const std::string& name,
                                               std::unique_ptr<VolumeSeries> all) {
    const ColorArray* held = index->color();
    const std::string given = all ? all->info().array : "";
    if ((held ? held->array : "") != given)
        throw Error("{}: cannot be appended to: it holds {}, {} given", name,
                    held ? "the colors " + held->array : "no colors",
                    all ? "the colors " + given : "none");
    if (!all)
        return nullptr;
    if (held->type != all->info().type || held->scaling != all->info().scaling)
        throw Error("{}: cannot be appended to: its colors {} differ in type or scaling", name,
                    given);
    const bool read_alike = index->metadata().reading_number == kReading;
    const std::vector<std::uint64_t> unknown(index->info().steps(), 0);
    expect_unchanged(name, *all, index->info().steps(), index->color_checksums(),
                     read_alike ? index->source_states() : unknown, read_alike);
    return std::make_unique<AppendedSeries>(std::move(index), std::move(all),
                                            static_cast<Load>(&IndexFile::load_color));
}

} // namespace isochron::index
