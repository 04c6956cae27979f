// Puts blocks into one grid.
#include "index/readers/formats/series/joined_blocks.h"

#include "index/error.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/series/block_places.h"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <utility>

namespace isochron::index {
namespace {

struct Block {
    SeriesFile file;
    BlockSize vertices{}, begin{}; ///< its first vertex in the whole grid
};

class JoinedBlocks final : public VolumeFile {
  public:
    JoinedBlocks(std::vector<SeriesFile> parts, ReadOptions options)
        : options_(std::move(options)) {
        std::vector<Grid> grids;
        std::vector<std::string> names;
        for (SeriesFile& part : parts) {
            names.push_back(part.path.string());
            grids.push_back(add(std::move(part)));
        }
        open_.reset();
        const BlockPlaces places = places_of_blocks(grids, names);
        info_.grid = places.whole;
        for (std::size_t i = 0; i < blocks_.size(); ++i)
            blocks_[i].begin = places.begins[i];
        info_.notes.push_back(fmt::format("put together from {} parts", blocks_.size()));
    }

    const SeriesInfo& info() const override { return info_; }
    std::size_t steps() const override { return 1; }
    std::vector<std::filesystem::path> beside() const override {
        std::vector<std::filesystem::path> others;
        for (const Block& block : blocks_)
            others.push_back(block.file.path);
        return others;
    }

    void read(std::size_t, std::span<std::byte> out) override {
        const std::size_t size = size_of(info_.type);
        std::vector<std::byte> values;
        for (const Block& block : blocks_) {
            open(block.file);
            if (open_->info().grid.vertices != block.vertices || open_->info().type != info_.type)
                throw Error("{}: changed while it was read", block.file.path.string());
            values.resize(open_->info().step_bytes());
            open_->read(0, values);
            each_row_of_block(block.begin, block.vertices, info_.grid.vertices,
                              [&](std::uint64_t to, std::uint64_t from) {
                                  std::memcpy(out.data() + to * size, values.data() + from * size,
                                              block.vertices[0] * size);
                              });
        }
        open_.reset();
    }

    void stream(std::size_t step, const TakePiece& take) override {
        std::vector<std::byte> whole(info_.step_bytes());
        read(step, whole);
        take(whole);
    }

  private:
    void open(const SeriesFile& file) {
        open_.reset(); // first, so that the next file can use the same reader
        open_ = file.open(file.path, options_);
    }

    /// @return its grid
    Grid add(SeriesFile part) {
        open(part);
        const SeriesInfo& got = open_->info();
        const std::string name = part.path.string();
        if (open_->steps() != 1)
            throw Error("{}: {} steps, expected 1 of a part", name, open_->steps());
        if (blocks_.empty())
            info_ = got;
        if (got.array != info_.array || got.type != info_.type || got.scaling != info_.scaling)
            throw Error("{}: another array, type or scaling than {}", name,
                        blocks_.front().file.path.string());
        blocks_.push_back({std::move(part), got.grid.vertices, {}});
        return got.grid;
    }

    ReadOptions options_;
    std::vector<Block> blocks_;
    SeriesInfo info_;
    std::unique_ptr<VolumeFile> open_;
};

} // namespace

std::unique_ptr<VolumeFile> join_blocks(std::vector<SeriesFile> parts, const ReadOptions& options) {
    const std::filesystem::path path = parts.front().path;
    ReadOptions whole = options;
    whole.crop.reset();
    whole.stride.reset();
    return cropped(std::make_unique<JoinedBlocks>(std::move(parts), whole), options, path);
}

} // namespace isochron::index
