// `isochron-bench scale`: the cost of a step that is opened for the first time, on large grids.
#include "app/commands/cancel.h"
#include "app/commands/progress_bar.h"
#include "app/generate/fourier_modes.h"
#include "index/build/index_build.h"
#include "index/error.h"
#include "index/extraction/index_search.h"
#include "index/scan/scan.h"
#include "index/system/new_file.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/rivals/flying_edges.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace isochron::bench {
namespace {

namespace fs = std::filesystem;
using index::Query;
using index::StepValues;

struct ScaleArguments {
    std::size_t size = 512;
    std::vector<std::string> fields{"smooth", "rough"};
    std::vector<double> active{0.05, 0.31};
    fs::path work = fs::temp_directory_path();
    bool vtk = false;
};

double seconds_of(const std::function<void()>& work) {
    const auto started = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

/// Bytes that this process has read from disks.
std::uint64_t bytes_from_disk() {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_inblock) * 512;
}

/// Drops a file from the page cache.
void forget(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        throw index::Error(fmt::format("{}: cannot be opened", path.string()));
    ::fsync(file);
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
}

/// One step of turbulence as raw bytes; 255 is its highest value.
class Field {
  public:
    Field(std::size_t size, bool smooth, const fs::path& path) : size_(size), path_(path) {
        std::vector<float> exact(size * size * size);
        const int longest = smooth ? 10 : static_cast<int>(size / 4);
        app::FourierModes(12345, 64, longest).vorticity_magnitude(size, 0, exact);
        const float highest = *std::ranges::max_element(exact);
        bytes_.resize((exact.size() + 7) / 8 * 8);
        std::ranges::transform(exact, bytes_.begin(), [highest](float v) {
            return static_cast<std::uint8_t>(std::lround(255 * v / highest));
        });
        index::NewFile file(path);
        file.write_at(0, std::as_bytes(std::span(bytes_)).first(exact.size()));
        file.commit();
    }

    StepValues values() const {
        const auto n = static_cast<std::uint32_t>(size_);
        return {.grid = {.vertices = {n, n, n}},
                .type = index::ValueType::u8,
                .scaling = {},
                .steps = 1,
                .first = reinterpret_cast<const std::byte*>(bytes_.data()),
                .stride = bytes_.size()};
    }
    std::size_t count() const { return size_ * size_ * size_; }
    const fs::path& path() const { return path_; }

    /// Reads the values from the file again.
    void read_again() {
        index::open_bytes(path_)->read(0, std::as_writable_bytes(std::span(bytes_)).first(count()));
    }
    std::unique_ptr<index::VolumeSeries> series() const {
        index::ReadOptions options;
        options.dims = values().grid.vertices;
        options.type = index::ValueType::u8;
        return index::open_series({path_}, options);
    }

  private:
    std::size_t size_;
    fs::path path_;
    std::vector<std::uint8_t> bytes_;
};

/// Processor time of `zstd -1` for the same bytes.
double seconds_of_zstd(const Field& field) {
    const auto stored = field.values().step_bytes(0);
    std::vector<std::byte> out(ZSTD_compressBound(stored.size()));
    const Stopwatch watch(Stopwatch::Of::all_threads);
    ZSTD_compress(out.data(), out.size(), stored.data(), stored.size(), 1);
    return watch.seconds();
}

/// Number of blocks of `edge`^3 cells with an active cell: if values are stored in these blocks, no
/// search can read less.
std::size_t blocks_with(const std::vector<index::CellId>& ids, std::uint32_t size,
                        std::uint32_t edge) {
    const std::size_t cells = size - 1, across = (cells + edge - 1) / edge;
    std::vector<bool> held(across * across * across);
    for (const std::size_t id : ids) {
        const std::size_t x = id % cells, y = id / cells % cells, z = id / cells / cells;
        held[(z / edge * across + y / edge) * across + x / edge] = true;
    }
    return static_cast<std::size_t>(std::ranges::count(held, true));
}

/// The cost of finding and shading the cells of one isovalue with nothing of the file in memory.
struct Cost {
    double seconds = 0;
    std::uint64_t bytes = 0;
};

Cost cost_of_index(const fs::path& path, const Query& query, index::CellSetPtr& found) {
    forget(path);
    const std::uint64_t before = bytes_from_disk();
    Cost cost;
    cost.seconds =
        seconds_of([&] { found = index::search_in(index::IndexFile::open(path))(query, {}); });
    cost.bytes = bytes_from_disk() - before;
    return cost;
}

Cost cost_of_scan(Field& field, const Query& query, const std::vector<index::CellId>& expected) {
    forget(field.path());
    const std::uint64_t before = bytes_from_disk();
    index::CellSet set;
    set.query = query;
    Cost cost;
    cost.seconds = seconds_of([&] {
        field.read_again();
        index::scan(field.values(), query, set.ids);
        index::shade_cells(field.values(), set);
    });
    cost.bytes = bytes_from_disk() - before;
    if (set.ids != expected)
        throw index::Error("the index and the scan find different cells");
    return cost;
}

Cost cost_of_vtk(Field& field, const Query& query) {
    const auto rival = flying_edges(field.values());
    rival->contour({0, -1}, false); // loads the module; finds nothing
    forget(field.path());
    return {seconds_of([&] {
                field.read_again();
                rival->contour(query, false);
            }),
            0};
}

void measure_field(const ScaleArguments& arguments, const std::string& name,
                   const index::Progress& progress) {
    const WorkFolder folder(arguments.work);
    progress("making", 0);
    Field field(arguments.size, name == "smooth", folder.path() / "step.raw");
    const double mib = static_cast<double>(field.count()) / (1 << 20);
    const double zstd = seconds_of_zstd(field);
    const fs::path path = folder.path() / "a.isochron";
    for (const index::Codec codec : {index::Codec::none, index::Codec::fitting}) {
        const auto series = field.series();
        const Stopwatch watch(Stopwatch::Of::all_threads);
        index::build_index(*series, path, {.codec = codec}, progress);
        fmt::print("{} {}^3 u8, codec {}: index / data {:.3f}, build {:.2f} s of processor time, "
                   "{:.2f}x zstd -1\n",
                   name, arguments.size, index::kCodecNames[static_cast<std::size_t>(codec)],
                   static_cast<double>(fs::file_size(path)) / (1 << 20) / mib, watch.seconds(),
                   watch.seconds() / zstd);
    }
    const auto cells = static_cast<double>(field.values().grid.cell_count());
    for (const double percent : arguments.active) {
        const Query query{0, isovalue_with(field.values(), cells * percent / 100)};
        index::CellSetPtr found;
        const Cost ours = cost_of_index(path, query, found);
        const Cost scan = cost_of_scan(field, query, found->ids);
        fmt::print("{} {}^3 u8, {} cells ({:.3f} %), cold: {:.1f} of {:.0f} MiB read, {:.0f} ms; "
                   "read and scan {:.0f} ms, {:.1f}x",
                   name, arguments.size, found->ids.size(),
                   100 * static_cast<double>(found->ids.size()) / cells,
                   static_cast<double>(ours.bytes) / (1 << 20), mib, 1e3 * ours.seconds,
                   1e3 * scan.seconds, scan.seconds / ours.seconds);
        if (arguments.vtk) {
            const Cost vtk = cost_of_vtk(field, query);
            fmt::print("; VTK {:.0f} ms, {:.1f}x", 1e3 * vtk.seconds, vtk.seconds / ours.seconds);
        }
        fmt::print("\n");
        for (const std::uint32_t edge : {8u, 16u}) {
            const auto blocks = static_cast<double>(
                blocks_with(found->ids, static_cast<std::uint32_t>(arguments.size), edge));
            const double bytes = blocks * std::pow(edge, 3);
            fmt::print("  of it in blocks of {}^3 cells that hold an active one: {:.0f} blocks, "
                       "{:.1f} MiB of values, {:.1f} %\n",
                       edge, blocks, bytes / (1 << 20), 100 * bytes / cells);
        }
    }
}

void run_bench_scale(const ScaleArguments& arguments) {
    const app::CancelOnSignal signals;
    const auto header = this_machine();
    fmt::print("commit {}, {}, {} threads\n", header.commit, header.processor, header.threads);
    for (const std::string& name : arguments.fields)
        measure_field(arguments, name, [&](std::string_view, double) { signals.check(); });
}

} // namespace

void add_scale(app::Command& program) {
    auto arguments = std::make_shared<ScaleArguments>();
    app::Command command = program.subcommand(
        "scale", "Measure size, building and the first look at a step of large grids, beside zstd, "
                 "a plain read with a scan, and VTK.");
    command.option("--size", arguments->size, "Vertices along each axis")
        .between(std::size_t{16}, std::size_t{2048})
        .shows_default();
    command
        .option("--fields", arguments->fields,
                "smooth: 64 Fourier modes up to wave number 10; rough: up to a quarter of the size")
        .one_of({"smooth", "rough"})
        .comma_separated()
        .shows_default();
    command.option("--active", arguments->active, "Active cells to look for, percent of all")
        .comma_separated()
        .shows_default();
    command.flag("--vtk", arguments->vtk, "Measure VTK's flying edges too");
    command.option("--work", arguments->work, "Folder for the files, on a disk: two steps")
        .existing_folder()
        .type_name("DIR")
        .shows_default();
    command.footer("Cold: the file has been taken out of the page cache. Bytes are what disks "
                   "gave this process, from opening on.\nTakes five bytes of memory for each "
                   "vertex. The cells found are compared with the scan's.");
    command.on_run([arguments] { run_bench_scale(*arguments); });
}

} // namespace isochron::bench
