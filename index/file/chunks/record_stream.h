// The records of neighboring layers, read in the order of the file while others decode them.
#pragma once

#include "index/file/chunks/chunk_store.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace isochron::index {

/// Some records of one layer.
struct RecordPiece {
    std::uint32_t layer = 0;
    std::uint32_t first = 0, end = 0; ///< places
    ChunkLayerPtr table;
    std::vector<std::byte> bytes; ///< begin with the record of `first`; may be followed by others

    std::span<const std::byte> record(std::uint32_t place) const {
        return std::span(bytes).subspan(table->offsets[place] - table->offsets[first],
                                        table->offsets[place + 1] - table->offsets[place]);
    }
};

/// Reads on a thread of its own, a few MiB ahead of those that take pieces, which may be several
/// threads. Memory of pieces is used again.
class RecordStream {
  public:
    /// @param store outlives this @param first, end layers
    RecordStream(const ChunkStore& store, std::uint32_t step, std::uint32_t first,
                 std::uint32_t end, std::stop_token stop);
    ~RecordStream();
    RecordStream(const RecordStream&) = delete;
    RecordStream& operator=(const RecordStream&) = delete;

    /// Waits for the next piece: layer after layer, and ascending places within each.
    /// @param piece its memory is used for pieces to come @return false at the end, or when closed
    /// @throws Error that reading met, Stopped
    bool next(RecordPiece& piece);
    /// Ends the stream for all.
    void close();

    /// Pieces of a layer.
    static std::uint32_t pieces_of(const ChunkLayer& table);

  private:
    void run(const std::stop_token& quit, std::uint32_t step, std::uint32_t first,
             std::uint32_t end);
    bool put(RecordPiece& piece, const std::stop_token& quit);

    const ChunkStore& store_;
    const std::stop_token stop_;
    std::mutex mutex_; ///< for the members below
    std::condition_variable_any taken_, came_;
    std::deque<RecordPiece> pieces_;
    std::vector<std::vector<std::byte>> free_; ///< memory for pieces
    std::exception_ptr failure_;
    bool ended_ = false;
    std::jthread reading_; ///< last: starts after and ends before all that it uses
};

} // namespace isochron::index
