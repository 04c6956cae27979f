// The pass of a build over its arrays: reads every step once, analyzes and packs it.
#include "index/indexing/volume_pass.h"

#include "index/file/detail_levels.h"
#include "index/file/sections/metadata.h"
#include "index/indexing/chunk_history.h"
#include "index/indexing/layer_stream.h"
#include "index/indexing/value_stats.h"
#include "index/system/running_checksum.h"

#include <deque>
#include <functional>
#include <utility>

namespace isochron::index {
namespace {

/// Statistics of the steps of one member.
class Observer {
  public:
    explicit Observer(const SeriesInfo& info) : info_(info) {}

    void look(const LayerView& layer) {
        counts_.add(info_.type, info_.scaling, layer.own());
        checksum_.add(layer.own());
        if (layer.end == info_.grid.vertices[2])
            checksums_.push_back(checksum_.take());
    }

    VolumeFindings agreed(const std::vector<std::uint64_t>& states, Team& team) {
        return {agreed_counts(counts_, info_.type, team),
                team.gather_items(checksums_),
                team.gather_items(states),
                {},
                0,
                {}};
    }

  private:
    const SeriesInfo& info_;
    ValueCounts counts_;
    RunningChecksum checksum_;
    std::vector<std::uint64_t> checksums_;
};

/// What a member finds in, and writes of, one array.
class Reading {
  public:
    explicit Reading(const ArrayPass& pass)
        : pass_(pass), stride_(step_stride(info().step_bytes())), observer_(info()),
          writer_(info(), pass.contents, pass.means) {}

    const ArrayPass& pass() const { return pass_; }

    void take(std::size_t step, const LayerView& layer, PartWriter& parts) {
        observer_.look(layer);
        if (pass_.kept)
            pass_.kept->write_at(step * stride_ + layer.begin * layer.plane, layer.own());
        writer_.take(layer, parts, steps_);
    }

    StepWriter& writer() { return writer_; }

    void settle(const MemberSteps& steps, PartWriter& parts, Team& team) {
        settle_since(writer_, steps_, steps, parts, team);
    }

    void take_states(std::size_t begin, std::size_t end) {
        for (std::size_t step = begin; step < end; ++step)
            states_.push_back(pass_.series.state(step));
    }

    /// @param begin of this member's parts in the file
    VolumeFindings agreed(std::uint64_t begin, Team& team) {
        VolumeFindings found = observer_.agreed(states_, team);
        found.steps =
            agreed_steps(std::move(steps_), begin, detail_grids(info().grid).size(), team);
        for (const std::uint64_t of_member : team.gather_values(writer_.stayed()))
            found.stayed += of_member;
        if (pass_.colors)
            found.colors = pass_.colors->agreed(begin, team);
        return found;
    }

  private:
    const SeriesInfo& info() const { return pass_.series.info(); }

    const ArrayPass& pass_;
    std::size_t stride_;
    Observer observer_;
    StepWriter writer_;
    std::vector<StepEntry> steps_;
    std::vector<std::uint64_t> states_;
};

using Stream =
    std::function<void(std::span<VolumeSeries* const>, std::size_t, std::size_t, const TakeLayer&)>;

/// Looks at the step before a member's first one, to see what stays.
void look_before(std::deque<Reading>& readings, std::size_t fresh, std::size_t first,
                 const Stream& stream) {
    const auto before = static_cast<std::uint32_t>(first == 0 ? 0 : first - 1);
    const auto look = [&](StepWriter& writer, VolumeSeries& series, bool since,
                          std::span<const std::uint32_t> held) {
        writer.begin_at(before);
        if (first == 0 || !since)
            return writer.begin_at(static_cast<std::uint32_t>(first));
        VolumeSeries* const alone[]{&series};
        stream(alone, before, first,
               [&](std::size_t, std::size_t, const LayerView& layer) { writer.look(layer); });
        if (first == fresh)
            writer.set_since(held);
    };
    for (Reading& reading : readings) {
        const ArrayPass& pass = reading.pass();
        look(reading.writer(), pass.series, pass.contents.since, pass.since);
        if (pass.colors)
            look(pass.colors->writer(), pass.colors->series(), pass.contents.since,
                 pass.colors->held_since());
    }
}

/// Reads this member's share of all steps.
void read_share(std::deque<Reading>& readings, std::size_t fresh, const PassTarget& target,
                PartWriter& parts, const Team& team, const Progress& progress) {
    const auto stream = [&](std::span<VolumeSeries* const> arrays, std::size_t begin,
                            std::size_t end, const TakeLayer& take) {
        stream_layers(arrays, begin, end, target.threads, take, [&](double done) {
            if (progress)
                progress("reading", done);
        });
    };
    struct Part {
        Reading* reading;
        bool colors;
    };
    std::vector<VolumeSeries*> arrays;
    std::vector<Part> of;
    for (Reading& reading : readings) {
        const ArrayPass& pass = reading.pass();
        arrays.push_back(&pass.series);
        of.push_back({&reading, false});
        if (!pass.colors)
            continue;
        arrays.push_back(&pass.colors->series());
        of.push_back({&reading, true});
    }
    const auto [begin, end] = team.share(arrays.front()->info().steps() - fresh);
    if (begin < end)
        look_before(readings, fresh, fresh + begin, stream);
    stream(arrays, fresh + begin, fresh + end,
           [&](std::size_t array, std::size_t step, const LayerView& layer) {
               const auto [reading, colors] = of[array];
               if (colors)
                   reading->pass().colors->take(layer, parts);
               else
                   reading->take(step, layer, parts);
           });
    for (Reading& reading : readings)
        reading.take_states(fresh + begin, fresh + end);
}

} // namespace

std::vector<VolumeFindings> read_volumes(std::span<const ArrayPass> arrays, std::size_t fresh,
                                         const PassTarget& target, Team& team,
                                         const Progress& progress) {
    std::optional<PartWriter> parts;
    std::deque<Reading> readings; // which cannot move
    team.together([&] {
        parts.emplace(target.file, target.end, target.beside, team);
        for (const ArrayPass& array : arrays)
            readings.emplace_back(array);
        read_share(readings, fresh, target, *parts, team, progress);
    });
    const Team::Share share = team.share(arrays.front().series.info().steps() - fresh);
    const MemberSteps steps{fresh, fresh + share.first, fresh + share.last};
    for (Reading& reading : readings) {
        reading.settle(steps, *parts, team);
        if (ColorPass* const colors = reading.pass().colors)
            colors->settle(steps, *parts, team);
    }
    const PartWriter::Placed placed = parts->place(team);
    std::vector<VolumeFindings> found;
    for (Reading& reading : readings)
        found.push_back(reading.agreed(target.end + placed.start, team));
    target.end += placed.bytes;
    return found;
}

} // namespace isochron::index
