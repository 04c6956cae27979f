// Opening of .isochron files.
#include "index/index_file.h"

#include "index/error.h"
#include "index/file_layout.h"
#include "index/mapped_file.h"
#include "index/metadata.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <mutex>

namespace isochron::index {
namespace {

constexpr std::uint64_t kMaxMetadataBytes = 256 << 20;

class MappedIndex : public IndexFile {
  public:
    explicit MappedIndex(const std::filesystem::path& path)
        : name_(path.string()), file_(path), header_(checked_header(name_, file_.bytes())) {
        const Section& text = header_.section(SectionKind::metadata);
        if (text.bytes > kMaxMetadataBytes)
            throw damaged(fmt::format("metadata of {} bytes", text.bytes));
        check(SectionKind::metadata);
        const auto bytes = section(SectionKind::metadata);
        try {
            metadata_ =
                metadata_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        } catch (const Error& error) {
            throw damaged(fmt::format("metadata: {}", error.what()));
        }
        set_values();
        metadata_.stats.file_bytes = header_.file_bytes;
        metadata_.stats.volume_bytes = header_.section(SectionKind::volume).bytes;
        metadata_.stats.tree_bytes = header_.section(SectionKind::tree).bytes;
    }

    const SeriesInfo& info() const override { return metadata_.info; }
    const IndexStats& stats() const override { return metadata_.stats; }
    const StepValues& values() const override { return values_; }
    const BuildOptions& options() const override { return metadata_.options; }
    std::uint64_t content_hash() const override { return header_.content_hash; }

    const ThiTree* tree() const override {
        std::call_once(tree_checked_, [this] {
            const auto bytes = section(SectionKind::tree);
            if (bytes.empty())
                return;
            check(SectionKind::tree, {});
            try {
                tree_ = std::make_unique<ThiTree>(bytes);
            } catch (const Error& error) {
                throw damaged(fmt::format("tree: {}", error.what()));
            }
            if (tree_->steps() != values_.steps)
                throw damaged(fmt::format("tree of {} steps, the volume has {}", tree_->steps(),
                                          values_.steps));
        });
        return tree_.get();
    }

    void verify(const Progress& progress) const override {
        check(SectionKind::volume, progress);
        check(SectionKind::tree, progress);
    }

  private:
    std::span<const std::byte> section(SectionKind kind) const {
        const Section& section = header_.section(kind);
        return file_.bytes().subspan(section.offset, section.bytes);
    }

    Error damaged(const std::string& what) const {
        return Error(fmt::format("{}: damaged: {}", name_, what));
    }

    void check(SectionKind kind, const Progress& progress = {}) const {
        const std::string name = kSectionNames[static_cast<std::size_t>(kind)];
        const auto bytes = section(kind);
        const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                             XXH3_freeState);
        XXH3_64bits_reset(state.get());
        constexpr std::size_t kChunk = 16 << 20;
        for (std::size_t at = 0; at < bytes.size(); at += kChunk) {
            const auto chunk = bytes.subspan(at, std::min(kChunk, bytes.size() - at));
            XXH3_64bits_update(state.get(), chunk.data(), chunk.size());
            if (progress)
                progress(name, static_cast<double>(at + chunk.size()) /
                                   static_cast<double>(bytes.size()));
        }
        if (XXH3_64bits_digest(state.get()) != header_.section(kind).checksum)
            throw damaged(fmt::format("the checksum of section {} does not match", name));
    }

    void set_values() {
        const SeriesInfo& info = metadata_.info;
        const auto volume = section(SectionKind::volume);
        values_ = {.grid = info.grid,
                   .type = info.type,
                   .scaling = info.scaling,
                   .steps = info.steps(),
                   .first = volume.data(),
                   .stride = step_stride(info.step_bytes())};
        // Division, since the product of damaged numbers could wrap.
        if (volume.size() / values_.steps != values_.stride || volume.size() % values_.steps)
            throw damaged(fmt::format("volume of {} bytes, expected {} steps of {}", volume.size(),
                                      values_.steps, values_.stride));
    }

    std::string name_;
    MappedFile file_;
    FileHeader header_;
    Metadata metadata_;
    StepValues values_;
    mutable std::once_flag tree_checked_;
    mutable std::unique_ptr<ThiTree> tree_;
};

} // namespace

std::shared_ptr<const IndexFile> IndexFile::open(const std::filesystem::path& path) {
    return std::make_shared<const MappedIndex>(path);
}

} // namespace isochron::index
