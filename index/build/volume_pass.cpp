// The pass of a build over the series: reads every step once, analyzes and packs it.
#include "index/build/volume_pass.h"

#include "index/build/layer_stream.h"
#include "index/build/level_choice.h"
#include "index/build/value_stats.h"
#include "index/file/detail_levels.h"
#include "index/file/metadata.h"
#include "index/system/running_checksum.h"

#include <algorithm>
#include <optional>

namespace isochron::index {
namespace {

/// Statistics of the steps of one member.
class Observer {
  public:
    explicit Observer(const SeriesInfo& info) : info_(info), chooser_(info.type) {}

    void look(std::size_t step, const LayerView& layer) {
        counts_.add(info_.type, info_.scaling, layer.own());
        const std::size_t plane = layer.plane / size_of(info_.type);
        chooser_.add(step, {layer.begin * plane, layer.end * plane, info_.grid.vertex_count()},
                     layer.own());
        checksum_.add(layer.own());
        if (layer.end == info_.grid.vertices[2])
            checksums_.push_back(checksum_.take());
    }

    bool lossless() const { return chooser_.lossless(); }

    VolumeFindings agreed(const std::vector<std::uint64_t>& states, Team& team) {
        LevelChooser chooser(info_.type);
        const std::vector<std::uint64_t> seen = chooser_.state();
        for (const auto& bytes : team.gather(std::as_bytes(std::span(seen)))) {
            const auto* state = reinterpret_cast<const std::uint64_t*>(bytes.data());
            chooser.merge(LevelChooser(info_.type, {state, bytes.size() / sizeof *state}));
        }
        return {agreed_counts(counts_, info_.type, team),
                team.gather_items(checksums_),
                team.gather_items(states),
                chooser.choose(),
                {},
                {}};
    }

  private:
    const SeriesInfo& info_;
    ValueCounts counts_;
    LevelChooser chooser_;
    RunningChecksum checksum_;
    std::vector<std::uint64_t> checksums_;
};

} // namespace

VolumeFindings read_volume(VolumeSeries& series, std::size_t first, std::size_t fresh,
                           const KeptValues& kept, const PassTarget& target, ColorPass* colors,
                           Team& team, const Progress& progress) {
    const SeriesInfo& info = series.info();
    const std::size_t stride = step_stride(info.step_bytes());
    Observer observer(info);
    std::optional<PartWriter> parts;
    std::vector<StepEntry> steps;
    std::vector<std::uint64_t> states;
    team.together([&] {
        parts.emplace(target.file, target.end, target.means.beside, team);
        StepWriter writer(info, target.contents, target.means);
        const auto keep = [&](std::size_t step, const LayerView& layer) {
            if (kept.file && (kept.always || observer.lossless()))
                kept.file->write_at((step - first) * stride + layer.begin * layer.plane,
                                    layer.own());
        };
        const auto stream = [&](std::span<VolumeSeries* const> arrays, std::size_t begin,
                                std::size_t end, const TakeLayer& take) {
            stream_layers(arrays, begin, end, target.means.threads, take, [&](double done) {
                if (progress)
                    progress("reading", done);
            });
        };
        std::vector<VolumeSeries*> arrays{&series};
        // Held steps are divided among the members, and so are new steps.
        if (const auto [begin, end] = team.share(fresh - first); begin < end)
            stream(
                arrays, first + begin, first + end,
                [&](std::size_t, std::size_t step, const LayerView& layer) { keep(step, layer); });
        if (colors)
            arrays.push_back(&colors->series());
        const auto [begin, end] = team.share(info.steps() - fresh);
        stream(arrays, fresh + begin, fresh + end,
               [&](std::size_t array, std::size_t step, const LayerView& layer) {
                   if (array > 0)
                       return colors->take(layer, *parts);
                   observer.look(step, layer);
                   keep(step, layer);
                   writer.take(layer, *parts, steps);
               });
        for (std::size_t step = fresh + begin; step < fresh + end; ++step)
            states.push_back(series.state(step));
    });
    VolumeFindings found = observer.agreed(states, team);
    const PartWriter::Placed placed = parts->place(team);
    const std::uint64_t mine = target.end + placed.start;
    found.steps = agreed_steps(std::move(steps), mine, detail_grids(info.grid).size(), team);
    if (colors)
        found.colors = colors->agreed(mine, team);
    target.end += placed.bytes;
    return found;
}

} // namespace isochron::index
