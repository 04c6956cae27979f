// Reads records in pieces that stay in a processor's cache until they are decoded.
#include "index/file/chunks/record_stream.h"

#include <algorithm>
#include <utility>

namespace isochron::index {
namespace {

/// Pieces that wait to be decoded.
constexpr std::size_t kWaiting = 12;

/// The end of the piece that begins at a place: as many whole records as are read together.
std::uint32_t end_of_piece(const ChunkLayer& table, std::uint32_t first) {
    const auto end =
        std::ranges::upper_bound(table.offsets.begin() + first + 1, table.offsets.end(),
                                 table.offsets[first] + kRecordsTogether);
    return std::max(first + 1, static_cast<std::uint32_t>(end - table.offsets.begin() - 1));
}

} // namespace

RecordStream::RecordStream(const ChunkStore& store, std::uint32_t step, std::uint32_t first,
                           std::uint32_t end, std::stop_token stop)
    : store_(store), stop_(std::move(stop)),
      reading_(
          [this, step, first, end](const std::stop_token& quit) { run(quit, step, first, end); }) {}

RecordStream::~RecordStream() {
    close();
}

std::uint32_t RecordStream::pieces_of(const ChunkLayer& table) {
    std::uint32_t pieces = 0;
    for (std::uint32_t place = 0; place < table.low.size(); place = end_of_piece(table, place))
        ++pieces;
    return pieces;
}

void RecordStream::run(const std::stop_token& quit, std::uint32_t step, std::uint32_t first,
                       std::uint32_t end) {
    std::exception_ptr failure;
    bool announced = false;
    try {
        RecordPiece piece;
        for (std::uint32_t layer = first; layer < end; ++layer) {
            const ChunkLayerPtr table = store_.layer(step, layer);
            for (std::uint32_t place = 0; place < table->low.size(); place = piece.end) {
                stop_if_asked(stop_);
                piece.layer = layer;
                piece.first = place;
                piece.end = end_of_piece(*table, place);
                piece.table = table;
                const std::size_t bytes = table->offsets[piece.end] - table->offsets[place];
                piece.bytes.resize(std::max(piece.bytes.size(), bytes));
                store_.read_in_order(step, table->offsets[place],
                                     std::span(piece.bytes).first(bytes), announced);
                if (!put(piece, quit))
                    return;
            }
        }
    } catch (...) {
        failure = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    failure_ = failure;
    ended_ = true;
    came_.notify_all();
}

/// @param piece gets memory for the next one; its place stays @return false when closed
bool RecordStream::put(RecordPiece& piece, const std::stop_token& quit) {
    std::unique_lock lock(mutex_);
    if (!taken_.wait(lock, quit, [this] { return ended_ || pieces_.size() < kWaiting; }) || ended_)
        return false;
    std::vector<std::byte> memory;
    if (!free_.empty()) {
        memory = std::move(free_.back());
        free_.pop_back();
    }
    pieces_.push_back({piece.layer, piece.first, piece.end, piece.table,
                       std::exchange(piece.bytes, std::move(memory))});
    came_.notify_one();
    return true;
}

bool RecordStream::next(RecordPiece& piece) {
    std::unique_lock lock(mutex_);
    if (piece.bytes.capacity() > 0)
        free_.push_back(std::move(piece.bytes));
    came_.wait(lock, [this] { return ended_ || !pieces_.empty(); });
    if (failure_)
        std::rethrow_exception(failure_);
    if (pieces_.empty())
        return false;
    piece = std::move(pieces_.front());
    pieces_.pop_front();
    taken_.notify_one();
    return true;
}

void RecordStream::close() {
    const std::scoped_lock lock(mutex_);
    pieces_.clear();
    ended_ = true;
    came_.notify_all();
    taken_.notify_all();
}

} // namespace isochron::index
