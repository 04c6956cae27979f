// Finds records that are read together; checks and unpacks them.
#include "index/file/chunks/chunk_records.h"

#include "index/error.h"
#include "index/file/chunks/chunk_codec.h"

#include <fmt/format.h>

#include <cstring>

namespace isochron::index {
namespace {

/// Records with fewer bytes than this between them are read together: a disk reads these in the
/// time of one more request.
constexpr std::uint64_t kNear = 16 << 10;

} // namespace

std::vector<RecordRun> runs_of(const ChunkLayer& table, std::span<const std::uint32_t> places,
                               std::uint64_t most) {
    std::vector<RecordRun> runs;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::uint64_t begin = table.offsets[places[i]], end = table.offsets[places[i] + 1];
        if (!runs.empty() && begin - runs.back().end < kNear && end - runs.back().begin <= most) {
            runs.back().last = i;
            runs.back().end = end;
        } else {
            runs.push_back({i, i, begin, end});
        }
    }
    return runs;
}

void ChunkDecoder::damaged(std::uint32_t step, const std::string& what) const {
    throw Error("{}: damaged: {}, step {}: {}", source_.name(), array_.called, step, what);
}

void ChunkDecoder::damaged(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
                           const std::string& what) const {
    const auto [x, y] = grid_.at(place);
    damaged(step, fmt::format("chunk {} {} {}: {}", x, y, layer, what));
}

ChunkLayerPtr ChunkDecoder::table(std::uint32_t step, std::uint32_t layer,
                                  std::span<const std::byte> bytes) const {
    const StepEntry& entry = array_.steps[step];
    const std::uint32_t count = grid_.chunks_of_layer();
    LayerHead head;
    std::memcpy(&head, bytes.data(), sizeof head);
    if (checksum_of(bytes.subspan(sizeof head.checksum)) != head.checksum)
        damaged(step, fmt::format("the checksum of the table of layer {} does not match", layer));
    auto table = std::make_shared<ChunkLayer>();
    table->offsets.resize(count + 1);
    table->low.resize(count);
    table->high.resize(count);
    table->since.resize(count);
    const std::size_t size = array_.has_since ? sizeof(ChunkEntry) : kEntryWithoutSince;
    std::uint64_t end = head.records;
    for (std::uint32_t place = 0; place < count; ++place) {
        ChunkEntry chunk;
        chunk.since = step;
        std::memcpy(&chunk, bytes.data() + sizeof head + place * size, size);
        if (chunk.since > step)
            damaged(step, layer, place, "it stays since a later step");
        table->offsets[place] = entry.offset + end;
        table->low[place] = chunk.low;
        table->high[place] = chunk.high;
        table->since[place] = chunk.since;
        end += chunk.bytes;
    }
    table->offsets[count] = entry.offset + end;
    if (head.records > entry.tables || end > entry.tables)
        damaged(step, fmt::format("layer {} lies outside its step", layer));
    return table;
}

void ChunkDecoder::chunk(std::uint32_t step, std::uint32_t layer, std::uint32_t place,
                         std::span<const std::byte> record, ChunkBricks& bricks,
                         std::span<std::byte> values) const {
    const auto refuse = [&](const char* what) { damaged(step, layer, place, what); };
    RecordChecksum checksum = 0;
    const std::size_t head = head_bytes();
    if (record.size() < head)
        refuse("too short");
    std::memcpy(&checksum, record.data(), sizeof checksum);
    if (record_checksum(record.subspan(sizeof checksum)) != checksum)
        refuse("its checksum does not match");
    if (array_.has_bricks)
        std::memcpy(bricks.data(), record.data() + sizeof checksum, sizeof bricks);
    if (array_.has_values && !values.empty() &&
        !unpack_chunk(array_.info.type, grid_.size(layer, place), record.subspan(head), values))
        refuse("it cannot be unpacked");
}

} // namespace isochron::index
