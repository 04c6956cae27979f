// Reads the steps of an index that refers to its sources instead of carrying a copy.
#include "index/file/step_source.h"
#include "index/readers/formats/open_series.h"

#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/metadata.h"
#include "index/system/new_file.h"

#include <algorithm>
#include <span>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::size_t kKept = 4; // the step on screen, the requested one, and a neighbor of each

std::size_t words_of(const SeriesInfo& info) {
    return step_stride(info.step_bytes()) / sizeof(std::uint64_t);
}

} // namespace

StepSource::StepSource(std::filesystem::path index, const SeriesInfo& info,
                       const Referral& referral, std::vector<std::uint64_t> checksums)
    : index_(std::move(index)), info_(info), referral_(referral), checksums_(std::move(checksums)) {
}

/// A link to an index may lie beside the sources, or the index itself.
std::filesystem::path StepSource::beside_index(const std::filesystem::path& file) const {
    std::error_code ignored;
    const std::filesystem::path path = index_.parent_path() / file;
    return std::filesystem::exists(path, ignored) ? path
                                                  : end_of_links(index_).parent_path() / file;
}

void StepSource::open_sources() {
    series_.reset();
    std::vector<std::filesystem::path> files;
    for (const std::filesystem::path& file : referral_.files)
        files.push_back(beside_index(file));
    auto series = open_series(files, referral_.options);
    const SeriesInfo& now = series->info();
    if (now.grid.vertices != info_.grid.vertices || now.type != info_.type ||
        now.steps() < info_.steps())
        throw Error("{}: its sources have changed since it was built: {} steps, expected {} of the "
                    "same grid and type",
                    index_.string(), now.steps(), info_.steps());
    series_ = std::move(series);
}

std::shared_ptr<std::uint64_t[]> StepSource::room_for_a_step() {
    std::shared_ptr<std::uint64_t[]> words;
    if (kept_.size() == kKept) {
        words = std::move(kept_.front().words);
        kept_.erase(kept_.begin());
    }
    // Its pages are allocated already, which saves as much time as a fast reader takes.
    if (words && words.use_count() == 1)
        return words;
    words = std::make_shared_for_overwrite<std::uint64_t[]>(words_of(info_));
    // Clears the padding after the values.
    std::ranges::fill(
        std::as_writable_bytes(std::span(words.get(), words_of(info_))).subspan(info_.step_bytes()),
        std::byte{0});
    return words;
}

LoadedStep StepSource::load(std::uint32_t step) {
    const std::lock_guard lock(mutex_);
    auto found = std::find_if(kept_.begin(), kept_.end(),
                              [&](const Decoded& decoded) { return decoded.step == step; });
    if (found == kept_.end()) {
        auto words = room_for_a_step();
        const auto stored = std::as_writable_bytes(std::span(words.get(), words_of(info_)))
                                .first(info_.step_bytes());
        if (!series_)
            open_sources();
        try {
            series_->read(step, stored);
        } catch (const Error&) {
            // Files may have been copied or touched since they were opened; only their contents
            // matter.
            open_sources();
            series_->read(step, stored);
        }
        if (checksum_of(stored) != checksums_[step])
            throw Error(
                "{}: its source {} has changed since it was built (step {})", index_.string(),
                info_.sources.size() == info_.steps() ? info_.sources[step] : info_.sources.back(),
                step);
        kept_.push_back({step, std::move(words)});
        found = kept_.end() - 1;
    }
    std::rotate(found, found + 1, kept_.end());
    const Decoded& decoded = kept_.back();
    return {{.grid = info_.grid,
             .type = info_.type,
             .scaling = info_.scaling,
             .steps = info_.steps(),
             .first = reinterpret_cast<const std::byte*>(decoded.words.get()),
             .stride = words_of(info_) * sizeof(std::uint64_t),
             .first_step = step},
            {},
            decoded.words};
}

} // namespace isochron::index
