// Times looks at steps whose bytes are on the disk alone.
#include "tests/bench/cold_steps.h"
#include "index/readers/formats/open_series.h"

#include "index/error.h"
#include "index/scan/scan.h"
#include "index/search/index_search.h"
#include "index/surface/cell_set.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "tests/bench/measures/timing.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;
using index::ValueType;

constexpr std::uint32_t kColdSteps = 12;
constexpr double kColdIsovalue = 220.5;

/// Some waves that move, between about 0 and 255, in one file of all steps.
class SmallSteps {
  public:
    SmallSteps(const std::array<std::uint32_t, 3>& vertices, ValueType type, const fs::path& path)
        : grid_{.vertices = vertices}, type_(type), path_(path) {
        const std::size_t count = std::size_t{vertices[0]} * vertices[1] * vertices[2];
        step_bytes_ = count * size_of(type);
        values_.resize((step_bytes_ + 7) / 8 * 8);
        index::NewFile file(path);
        for (std::uint32_t step = 0; step < kColdSteps; ++step) {
            make(step);
            file.write_at(step * step_bytes_, std::span(values_).first(step_bytes_));
        }
        file.commit();
    }

    const fs::path& path() const { return path_; }
    std::size_t step_bytes() const { return step_bytes_; }
    std::unique_ptr<index::VolumeSeries> series() const {
        index::ReadOptions options;
        options.dims = grid_.vertices;
        options.type = type_;
        return index::open_series({path_}, options);
    }

    /// What any program does without an index.
    double read_and_scan(std::uint32_t step, index::CellSet& set) {
        forget(path_);
        const index::InputFile file(path_);
        return seconds_of([&] {
            file.read(step * step_bytes_, std::span(values_).first(step_bytes_));
            const index::StepValues values{.grid = grid_,
                                           .type = type_,
                                           .scaling = {},
                                           .steps = 1,
                                           .first = values_.data(),
                                           .stride = values_.size()};
            set.query = {index::Instant(0), kColdIsovalue};
            index::scan(values, set.query, set.ids);
            index::shade_cells(values, set);
        });
    }

  private:
    void make(std::uint32_t step) {
        const auto [nx, ny, nz] = grid_.vertices;
        std::size_t i = 0;
        const double moved = 0.2 * step;
        for (std::uint32_t z = 0; z < nz; ++z)
            for (std::uint32_t y = 0; y < ny; ++y)
                for (std::uint32_t x = 0; x < nx; ++x, ++i) {
                    const double v = 128 + 40 * (std::sin(0.11 * x + moved) + std::sin(0.13 * y) +
                                                 std::sin(0.17 * z - moved + 0.02 * x));
                    if (type_ == ValueType::f32) {
                        const auto stored = static_cast<float>(v);
                        std::memcpy(values_.data() + 4 * i, &stored, 4);
                    } else {
                        values_[i] = static_cast<std::byte>(std::lround(v));
                    }
                }
    }

    index::Grid grid_;
    ValueType type_;
    fs::path path_;
    std::size_t step_bytes_ = 0;
    std::vector<std::byte> values_;
};

} // namespace

double seconds_of(const std::function<void()>& work) {
    const auto started = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

void forget(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        throw index::Error(fmt::format("{}: cannot be opened", path.string()));
    ::fsync(file);
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
}

void measure_cold_steps(const fs::path& folder, const index::Progress& progress,
                        const std::function<void(const std::string& row)>& print) {
    for (const ValueType type : {ValueType::u8, ValueType::f32})
        for (const auto& vertices : std::array<std::array<std::uint32_t, 3>, 3>{
                 {{64, 64, 64}, {128, 128, 64}, {256, 128, 64}}}) {
            SmallSteps steps(vertices, type, folder / "steps.raw");
            const fs::path path = folder / "steps.isochron";
            index::build_index(*steps.series(), path, {}, progress);
            std::vector<double> ours, plain;
            std::size_t found = 0;
            for (const bool first : {true, false}) // each comes first once
                for (std::uint32_t step = 0; step < kColdSteps; ++step) {
                    index::CellSet scanned;
                    if (!first)
                        plain.push_back(steps.read_and_scan(step, scanned));
                    const auto file = index::IndexFile::open(path);
                    const index::Search search = index::search_in(file, {}, index::Shading::cells);
                    forget(path);
                    index::CellSetPtr set;
                    ours.push_back(seconds_of([&] {
                        set = search({index::Instant(step), kColdIsovalue}, {});
                    }));
                    if (first)
                        plain.push_back(steps.read_and_scan(step, scanned));
                    if (scanned.ids != set->ids)
                        throw index::Error("the index and the scan find different cells");
                    found = set->ids.size();
                }
            print(fmt::format(
                "{}x{}x{} {}, {} cells, cold step: index {:.2f} ms; read and scan {:.2f} ms, "
                "{:.2f}x\n",
                vertices[0], vertices[1], vertices[2], name_of(type), found, 1e3 * median(ours),
                1e3 * median(plain), median(plain) / median(ours)));
        }
}

} // namespace isochron::bench
