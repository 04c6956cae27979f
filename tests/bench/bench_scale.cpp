// `isochron-bench scale`: the cost of a step that is opened for the first time, on large grids.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/generate/fourier_modes.h"
#include "index/error.h"
#include "index/indexing/index_build.h"
#include "index/readers/formats/open_series.h"
#include "index/scan/bricks.h"
#include "index/scan/scan.h"
#include "index/search/index_search.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/machine.h"
#include "tests/bench/measures/isovalues.h"
#include "tests/bench/measures/mesh_making.h"
#include "tests/bench/measures/stopwatch.h"
#include "tests/bench/measures/timing.h"
#include "tests/bench/measures/touched_lines.h"
#include "tests/bench/measures/work_folder.h"
#include "tests/bench/rivals/flying_edges.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
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
    bool warm = false;
};

/// Bytes that this process has read from disks.
std::uint64_t bytes_from_disk() {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_inblock) * 512;
}

/// Elapsed time [s].
double seconds_of(const std::function<void()>& work) {
    const auto started = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

/// Drops a file from the page cache. @throws Error if it cannot be opened
void forget(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        throw index::Error("{}: cannot be opened", path.string());
    ::fsync(file);
    ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    ::close(file);
}

/// One step of turbulence as raw values: floats, or bytes of which 255 is the highest.
class Field {
  public:
    Field(std::size_t size, bool smooth, index::ValueType type, const fs::path& path)
        : size_(size), type_(type), path_(path) {
        std::vector<float> exact(size * size * size);
        const int longest = smooth ? 10 : static_cast<int>(size / 4);
        app::FourierModes(12345, 64, longest).vorticity_magnitude(size, 0, exact);
        bytes_.resize((count() + 7) / 8 * 8);
        if (type == index::ValueType::f32) {
            std::memcpy(bytes_.data(), exact.data(), count());
        } else {
            const float highest = *std::ranges::max_element(exact);
            std::ranges::transform(exact, bytes_.begin(), [highest](float v) {
                return static_cast<std::uint8_t>(std::lround(255 * v / highest));
            });
        }
        index::NewFile file(path);
        file.write_at(0, std::as_bytes(std::span(bytes_)).first(count()));
        file.commit();
    }

    StepValues values() const {
        const auto n = static_cast<std::uint32_t>(size_);
        return {.grid = {.vertices = {n, n, n}},
                .type = type_,
                .scaling = {},
                .steps = 1,
                .first = reinterpret_cast<const std::byte*>(bytes_.data()),
                .stride = bytes_.size()};
    }
    /// [bytes] of the values.
    std::size_t count() const { return size_ * size_ * size_ * size_of(type_); }
    const fs::path& path() const { return path_; }

    /// Reads the values from the file again, in order and without advice: the kernel reads ahead.
    void read_again() {
        const auto to = std::as_writable_bytes(std::span(bytes_)).first(count());
        if (index::InputFile(path_).read(0, to) != to.size())
            throw index::Error("{}: too short", path_.string());
    }
    std::unique_ptr<index::VolumeSeries> series() const {
        index::ReadOptions options;
        options.dims = values().grid.vertices;
        options.type = type_;
        return index::open_series({path_}, options);
    }

  private:
    std::size_t size_;
    index::ValueType type_;
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

/// The cost of finding and shading the cells of one isovalue with nothing of the file in memory.
struct Cost {
    double seconds = 0;
    std::uint64_t bytes = 0;
};

Cost cost_of_index(const fs::path& path, const Query& query, index::CellSetPtr& found) {
    forget(path);
    found = nullptr; // the scan's cells are not freed in its time either
    std::shared_ptr<const index::IndexFile> file; // is closed after the clock has stopped
    const std::uint64_t before = bytes_from_disk();
    Cost cost;
    cost.seconds = seconds_of([&] {
        file = index::IndexFile::open(path);
        found = index::search_in(file)(query, {});
    });
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
    rival->contour({index::Instant(0), -1}, false); // loads the module; finds nothing
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
    Field field(arguments.size, name == "smooth", index::ValueType::u8, folder.path() / "step.raw");
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
        const Query query{index::Instant(0), isovalue_with(field.values(), cells * percent / 100)};
        index::CellSetPtr found;
        // In turn, since memory that the system has not used for a while comes late.
        std::vector<double> our_seconds, scan_seconds;
        Cost ours;
        for (int round = 0; round < 3; ++round) {
            ours = cost_of_index(path, query, found);
            our_seconds.push_back(ours.seconds);
            scan_seconds.push_back(cost_of_scan(field, query, found->ids).seconds);
        }
        ours.seconds = median(our_seconds);
        const Cost scan{.seconds = median(scan_seconds), .bytes = field.count()};
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
            // If values are stored in these blocks, no search can read less.
            const auto blocks = static_cast<double>(
                touched_blocks(found->ids, field.values().grid, {edge, edge, edge}, 1).held);
            const double bytes = blocks * std::pow(edge, 3);
            fmt::print("  of it in blocks of {}^3 cells that hold an active one: {:.0f} blocks, "
                       "{:.1f} MiB of values, {:.1f} %\n",
                       edge, blocks, bytes / (1 << 20), 100 * bytes / cells);
        }
    }
}

/// Ids by bricks and by the scan, with everything in memory, beside what no search of such blocks
/// can do without: the cache lines with the values of those that hold an active cell.
void measure_warm(const ScaleArguments& arguments, const std::string& name,
                  const index::Progress& progress) {
    const WorkFolder folder(arguments.work);
    progress("making", 0);
    const Field field(arguments.size, name == "smooth", index::ValueType::f32,
                      folder.path() / "step.raw");
    const fs::path path = folder.path() / "a.isochron";
    index::build_index(*field.series(), path, {}, progress);
    const auto file = index::IndexFile::open(path);
    const index::LoadedStep step = file->load(0);
    const auto& grid = field.values().grid;
    const auto cells = static_cast<double>(grid.cell_count());
    constexpr double kMib = 1 << 20;
    const double all = static_cast<double>(field.count()) / kMib;
    for (const double percent : arguments.active) {
        const Query query{index::Instant(0), isovalue_with(field.values(), cells * percent / 100)};
        std::vector<index::CellId> ids, found;
        const auto by_bricks = [&](std::uint32_t) {
            found.clear();
            index::search_bricks(step.values, *file->chunks().levels(0), step.bricks, query, found);
        };
        const auto by_scan = [&](std::uint32_t) {
            ids.clear();
            index::scan(field.values(), query, ids);
        };
        const auto seconds = time_in_turn({by_bricks, by_scan}, 1, 15);
        std::ranges::sort(found);
        if (found != ids)
            throw index::Error("the index and the scan find different cells");
        found.clear();
        const auto tested = static_cast<double>(
            index::test_bricks(step.values, *file->chunks().levels(0), step.bricks, query, found));
        fmt::print("{} {}^3 f32, {} cells ({:.3f} %), warm: ids by bricks {:.2f} ms, scan {:.2f} "
                   "ms, {:.1f}x; cells of candidates {:.1f} %\n",
                   name, arguments.size, ids.size(), 100 * static_cast<double>(ids.size()) / cells,
                   1e3 * seconds[0], 1e3 * seconds[1], seconds[1] / seconds[0],
                   100 * tested / cells);
        if (arguments.vtk) {
            const MeshMaking mesh = measure_mesh_making(field.values(), query, ids);
            fmt::print("  mesh of {} triangles with normals from these cells, one thread: {:.1f} "
                       "ms, VTK {:.1f} ms, {:.1f}x\n",
                       mesh.triangles, 1e3 * mesh.seconds, 1e3 * mesh.seconds_of_vtk,
                       mesh.seconds_of_vtk / mesh.seconds);
        }
        constexpr std::array<std::array<std::uint32_t, 3>, 4> kEdges{
            index::BrickGrid::kCells, {4, 4, 2}, {2, 2, 2}, {1, 1, 1}};
        for (const auto& edges : kEdges) {
            const TouchedBlocks touched = touched_blocks(ids, grid, edges, sizeof(float));
            const double lines = static_cast<double>(touched.bytes) / kMib;
            fmt::print("  in blocks of {}x{}x{} cells: {:.1f} % hold an active one; their values "
                       "lie in cache lines of {:.1f} of {:.0f} MiB, {:.1f}x less than a scan "
                       "reads\n",
                       edges[0], edges[1], edges[2],
                       100 * static_cast<double>(touched.held) /
                           static_cast<double>(touched.blocks),
                       lines, all, all / lines);
        }
    }
}

void run_bench_scale(const ScaleArguments& arguments) {
    const app::CancelOnSignal signals;
    const auto header = this_machine();
    fmt::print("commit {}, {}, {} threads\n", header.commit, header.processor, header.threads);
    for (const std::string& name : arguments.fields)
        (arguments.warm ? measure_warm : measure_field)(
            arguments, name, [&](std::string_view, double) { signals.check(); });
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
    command.flag("--warm", arguments->warm,
                 "Measure ids of a float step in memory instead, by bricks and by the scan, and "
                 "what limits them; with --vtk also how long its mesh takes");
    command.option("--work DIR", arguments->work, "Folder for the files, on a disk: two steps")
        .existing_folder()
        .shows_default();
    command.footer("Cold: the file has been taken out of the page cache. Bytes are what disks "
                   "gave this process, from opening on.\nThe plain read is in order, "
                   "and the kernel reads ahead as it does for any file. Times are medians of "
                   "three, in turn.\nTakes five bytes of memory for each "
                   "vertex. The cells found are compared with the scan's.");
    command.on_run([arguments] { run_bench_scale(*arguments); });
}

} // namespace isochron::bench
