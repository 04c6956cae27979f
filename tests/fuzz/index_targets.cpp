// Fuzz targets: indices, whose checksums are repaired before they are read.
#include "tests/fuzz/targets.h"

#include "index/error.h"
#include "index/extraction/extraction.h"
#include "index/file/color_source.h"
#include "index/search/cell_change.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "tests/support/index_repair.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::fuzz {
namespace {

class IndexInMemory final : public index::ByteSource {
  public:
    explicit IndexInMemory(Bytes input) : bytes_(input.size()) {
        std::ranges::copy(std::as_bytes(input), bytes_.begin());
        index::repair_checksums(bytes_);
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return bytes_.size(); }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        const std::size_t begin = std::min<std::uint64_t>(offset, bytes_.size());
        const std::size_t count = std::min(out.size(), bytes_.size() - begin);
        std::memcpy(out.data(), bytes_.data() + begin, count);
        return count;
    }

  private:
    std::string name_ = "input";
    std::vector<std::byte> bytes_;
};

/// An index that is refused, now or later, is fine.
void attempt(const std::function<void()>& work) {
    try {
        work();
    } catch (const index::Error& error) {
        claim_one_line(error.what());
    }
}

void claim_ids(const index::CellSet& set, const index::Grid& grid) {
    claim(std::ranges::adjacent_find(set.ids, std::greater_equal()) == set.ids.end(), "ids ascend");
    claim(set.ids.empty() || set.ids.back() < grid.cell_count(), "ids are those of cells");
}

/// Searches in all steps, by all that there is, at all levels.
void use_index(const std::shared_ptr<const index::IndexFile>& file) {
    constexpr std::size_t kMostBytes = 256 << 10, kMostSteps = 4;
    const index::SeriesInfo& info = file->info();
    if (info.step_bytes() > kMostBytes || file->referral())
        return;
    const index::IndexStats& stats = file->stats();
    index::ChangeSearch changes(file);
    index::Query before{index::Instant(0), stats.low};
    for (std::uint32_t step = 0; step < std::min(info.steps(), kMostSteps); ++step)
        for (const double part : {0.25, 0.6}) {
            const index::Query query{index::Instant(step),
                                     stats.low + part * (stats.high - stats.low)};
            for (std::size_t i = 0; i < index::kSearchMethodNames.size(); ++i) {
                const auto method = static_cast<index::SearchMethod>(i);
                if (index::can_search(*file, method))
                    attempt(
                        [&] { claim_ids(*index::search_in(file, method)(query, {}), info.grid); });
            }
            for (std::size_t level = 0; level < file->detail_levels(); ++level)
                attempt([&] {
                    claim_ids(index::search_level(file, level, query),
                              file->chunks(level).info().grid);
                });
            attempt([&] { changes(before, query); });
            if (file->color())
                attempt([&] { file->load_color(step); });
            before = query;
        }
    attempt([&] { file->verify(); });
}

/// The surfaces of the first array in the colors of each that there is to color by.
void use_colors(const std::shared_ptr<const index::IndexFile>& file) {
    constexpr std::size_t kMostBytes = 256 << 10, kMostColors = 3;
    if (file->info().step_bytes() > kMostBytes || file->referral())
        return;
    const index::Extract extract = index::extract_from(file);
    const double middle = file->stats().low / 2 + file->stats().high / 2;
    const std::size_t colors = index::ColorSource::count(*file);
    for (std::uint32_t number = 0; number < std::min(colors, kMostColors); ++number)
        attempt([&] {
            extract({.instant = {},
                     .isovalues = {middle},
                     .coloring = index::CellColoring::value,
                     .colors = number},
                    {});
        });
}

void fuzz_index_file(Bytes input) {
    attempt([&] {
        const auto file = index::IndexFile::open(std::make_unique<IndexInMemory>(input), 1 << 20);
        for (std::size_t number = 0; number < std::min<std::size_t>(file->arrays(), 3); ++number)
            use_index(index::array_of(file, number));
        use_colors(file);
    });
}

} // namespace

std::span<const Target> index_targets() {
    static constexpr std::array kTargets{Target{"index_file", fuzz_index_file}};
    return kTargets;
}

} // namespace isochron::fuzz
