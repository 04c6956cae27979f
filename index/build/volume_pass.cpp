// The first pass of a build: every step is read once, kept and looked at.
#include "index/build/volume_pass.h"

#include "index/build/level_choice.h"
#include "index/build/value_stats.h"
#include "index/file/file_layout.h"
#include "index/file/metadata.h"

#include <algorithm>
#include <future>

namespace isochron::index {
namespace {

/// What one member has seen of its steps.
class Observer {
  public:
    Observer(const SeriesInfo& info, std::size_t first, std::size_t fresh, ByteSink& file)
        : info_(info), first_(first), fresh_(fresh), file_(file), chooser_(info.type) {}

    /// @param step padded to its stride
    void look(std::size_t t, std::span<const std::byte> step, std::uint64_t state) {
        file_.write_at((t - first_) * step.size(), step);
        if (t < fresh_)
            return;
        const auto stored = step.first(info_.step_bytes());
        counts_.add(info_.type, info_.scaling, stored);
        chooser_.add(t, stored);
        checksums_.push_back(checksum_of(stored));
        states_.push_back(state);
    }

    VolumeFindings agreed(Team& team) {
        LevelChooser chooser(info_.type);
        const std::vector<std::uint64_t> seen = chooser_.state();
        for (const auto& bytes : team.gather(std::as_bytes(std::span(seen)))) {
            const auto* state = reinterpret_cast<const std::uint64_t*>(bytes.data());
            chooser.merge(LevelChooser(info_.type, {state, bytes.size() / sizeof *state}));
        }
        return {agreed_counts(counts_, info_.type, team), team.gather_items(checksums_),
                team.gather_items(states_), chooser.choose()};
    }

  private:
    const SeriesInfo& info_;
    std::size_t first_, fresh_;
    ByteSink& file_;
    ValueCounts counts_;
    LevelChooser chooser_;
    std::vector<std::uint64_t> checksums_, states_;
};

constexpr std::size_t kReadAhead = 64 << 20; ///< [bytes] of a step
constexpr std::size_t kTooSmall = 32 << 10;  ///< [bytes] starting a thread takes longer

} // namespace

VolumeFindings read_volume(VolumeSeries& series, std::size_t first, std::size_t fresh,
                           ByteSink& file, Team& team, const Progress& progress) {
    const SeriesInfo& info = series.info();
    const std::size_t stride = step_stride(info.step_bytes());
    Observer observer(info, first, fresh, file);
    team.together([&] {
        const auto [begin, end] = team.share(info.steps() - first);
        std::array<std::vector<std::byte>, 2> buffers; // their padding stays zero
        // Large steps are not read ahead: with a reader that decodes there would be three of them.
        const std::size_t steps_at_once = stride <= kReadAhead ? 2 : 1;
        std::future<void> looking; // its end is waited for when this is left
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t t = first + i;
            if (progress)
                progress("reading",
                         static_cast<double>(i - begin) / static_cast<double>(end - begin));
            std::vector<std::byte>& step = buffers[t % steps_at_once];
            if (steps_at_once == 1 && looking.valid())
                looking.get();
            step.resize(stride);
            series.read(t, std::span(step).first(info.step_bytes()));
            const std::uint64_t state = series.state(t);
            if (looking.valid())
                looking.get();
            if (stride <= kTooSmall) {
                observer.look(t, step, state);
                continue;
            }
            looking = std::async(std::launch::async,
                                 [&observer, t, &step, state] { observer.look(t, step, state); });
        }
        if (looking.valid())
            looking.get();
    });
    return observer.agreed(team);
}

} // namespace isochron::index
