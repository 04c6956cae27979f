// The first pass of a build: every step is read once, kept and looked at.
#include "index/build/volume_pass.h"

#include "index/build/level_choice.h"
#include "index/build/value_stats.h"
#include "index/file/file_layout.h"
#include "index/file/metadata.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <future>

namespace isochron::index {
namespace {

/// What one member has seen of its steps.
class Observer {
  public:
    Observer(const SeriesInfo& info, NewFile& file, std::uint64_t offset)
        : info_(info), file_(file), offset_(offset), chooser_(info.type) {}

    /// @param step padded to its stride
    void look(std::size_t t, std::span<const std::byte> step) {
        const auto stored = step.first(info_.step_bytes());
        add_range(info_.type, info_.scaling, stored, range_.low, range_.high, range_.nan_values);
        chooser_.add(t, stored);
        checksums_.push_back(checksum_of(stored));
        file_.write_at(offset_ + t * step.size(), step);
    }

    VolumeFindings agreed(Team& team) {
        const ValueRange all = agreed_range(range_, team);
        LevelChooser chooser(info_.type);
        const std::vector<std::uint64_t> seen = chooser_.state();
        for (const auto& bytes : team.gather(std::as_bytes(std::span(seen)))) {
            const auto* state = reinterpret_cast<const std::uint64_t*>(bytes.data());
            chooser.merge(LevelChooser(info_.type, {state, bytes.size() / sizeof *state}));
        }
        return {all.low, all.high, all.nan_values, team.gather_items(checksums_), chooser.choose()};
    }

  private:
    const SeriesInfo& info_;
    NewFile& file_;
    std::uint64_t offset_;
    ValueRange range_;
    LevelChooser chooser_;
    std::vector<std::uint64_t> checksums_;
};

constexpr std::size_t kReadAhead = 64 << 20; ///< [bytes] of a step
constexpr std::size_t kTooSmall = 32 << 10;  ///< [bytes] starting a thread takes longer

} // namespace

VolumeFindings read_volume(VolumeSeries& series, NewFile& file, std::uint64_t offset, Team& team,
                           const Progress& progress) {
    const SeriesInfo& info = series.info();
    const std::size_t stride = step_stride(info.step_bytes());
    Observer observer(info, file, offset);
    team.together([&] {
        const auto [first, last] = team.share(info.steps());
        std::array<std::vector<std::byte>, 2> buffers; // their padding stays zero
        // Large steps are not read ahead: with a reader that decodes there would be three of them.
        const std::size_t steps_at_once = stride <= kReadAhead ? 2 : 1;
        std::future<void> looking; // its end is waited for when this is left
        for (std::size_t t = first; t < last; ++t) {
            if (progress)
                progress("reading",
                         static_cast<double>(t - first) / static_cast<double>(last - first));
            std::vector<std::byte>& step = buffers[t % steps_at_once];
            if (steps_at_once == 1 && looking.valid())
                looking.get();
            step.resize(stride);
            series.read(t, std::span(step).first(info.step_bytes()));
            if (looking.valid())
                looking.get();
            if (stride <= kTooSmall) {
                observer.look(t, step);
                continue;
            }
            looking =
                std::async(std::launch::async, [&observer, t, &step] { observer.look(t, step); });
        }
        if (looking.valid())
            looking.get();
    });
    return observer.agreed(team);
}

std::vector<std::uint64_t> count_values(const StepValues& values, const MappedFile& volume,
                                        double low, double high, unsigned threads, Team& team,
                                        const Progress& progress) {
    constexpr std::size_t kPiece = 16 << 20;
    using Bins = std::array<std::uint64_t, kHistogramBins>;
    std::vector<Bins> counted(threads, Bins{});
    const auto [first, last] = team.share(values.steps);
    team.together([&] {
        parallel_for(
            last - first, threads,
            [&](std::size_t item, unsigned worker) {
                const std::span<const std::byte> step = values.step_bytes(first + item);
                for (std::size_t at = 0; at < step.size(); at += kPiece) {
                    const auto piece = step.subspan(at, std::min(kPiece, step.size() - at));
                    add_histogram(values.type, values.scaling, piece, low, high, counted[worker]);
                    volume.let_go(piece);
                }
            },
            phase_of(progress, "counting"));
    });
    Bins mine{};
    for (const Bins& bins : counted)
        for (std::size_t i = 0; i < mine.size(); ++i)
            mine[i] += bins[i];
    std::vector<std::uint64_t> all(kHistogramBins);
    for (const Bins& bins : team.gather_values(mine))
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] += bins[i];
    return all;
}

} // namespace isochron::index
