// Files that readers decode, and the handling of readers that end.
#include "index/readers/formats/foreign_file.h"

#include "index/error.h"
#include "index/readers/formats/cropped_file.h"
#include "index/readers/formats/foreign_names.h"
#include "index/readers/formats/reader_lease.h"
#include "index/readers/formats/stored_file.h"
#include "index/system/huge_pages.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <functional>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The program of a reader: one for each library, so that no format waits until the library of
/// another is loaded.
std::string program_of(std::string_view reader) {
    return fmt::format("isochron-reader-{}", reader);
}

/// Checks what a reader says of a file, as a hostile file may control the reader.
void check(const Described& described, const std::string& name) {
    const SeriesInfo& info = described.info;
    check_grid(info.grid, name);
    glm::dmat3 axes = info.grid.direction;
    Grid grid;
    for (int axis = 0; axis < 3; ++axis)
        axes[axis] *= std::max(info.grid.spacing[axis], 0.0);
    set_axes(grid, axes, name);
    if (described.steps == 0 || (!info.times.empty() && info.times.size() != described.steps) ||
        described.slices_at_once == 0 || described.slices_at_once > info.grid.vertices[2] ||
        info.scaling.slope == 0 || !std::isfinite(info.scaling.slope) ||
        !std::isfinite(info.scaling.intercept))
        throw Error("{}: cannot be read: its reader describes no volume", name);
}

/// A file that describes a folder stands for it: `CASE/system/controlDict`.
fs::path place_of(const Format& format, const fs::path& path) {
    for (const std::string_view described : format.describe_folder) {
        fs::path place = path;
        fs::path name = described;
        for (; name.has_filename() && place.filename() == name.filename();
             place = place.parent_path())
            name = name.parent_path();
        if (!name.has_filename())
            return place.empty() ? "." : place;
    }
    return path;
}

class ForeignFile final : public VolumeFile {
  public:
    ForeignFile(ReaderPool& readers, const Format& format, const fs::path& path,
                const ReadOptions& options)
        : name_(path.string()), open_{.format = std::string(format.name),
                                      .path = path,
                                      .options = options},
          lease_(readers, program_of(format.reader), path, format.decodes_all_arrays) {
        readers.let_read(place_of(format, path));
        readers.let_read(options.slices);
        lease_.work([] {}, [this] { described_ = open(); });
        check(described_, name_);
    }

    const SeriesInfo& info() const override { return described_.info; }
    std::size_t steps() const override { return described_.steps; }

    std::vector<fs::path> beside() const override { return open_.options.slices; }

    void read(std::size_t step, std::span<std::byte> out) override {
        std::span<std::byte> rest = out;
        take_step(
            step,
            [&](std::span<const std::byte> piece) {
                std::memcpy(rest.data(), piece.data(), piece.size());
                rest = rest.subspan(piece.size());
            },
            [&](std::size_t bytes) {
                if (!last_page_is_there(rest.first(bytes)))
                    fetch_pages(rest.first(bytes));
            });
    }

    void stream(std::size_t step, const TakePiece& take) override {
        take_step(step, take, [](std::size_t /*bytes*/) {});
    }

  private:
    Described open() {
        open_.number = lease_.number();
        lease_.reader().ask(open_);
        return lease_.expect<Described>();
    }

    void open_again() {
        const Described now = open();
        if (now.info.step_bytes() != described_.info.step_bytes() ||
            now.info.type != described_.info.type || now.steps != described_.steps ||
            now.slices_at_once != described_.slices_at_once)
            throw Error("{}: has changed since it was opened", name_);
    }

    /// What to do before the next piece is there; only the size of that piece is known.
    using Meanwhile = std::function<void(std::size_t bytes)>;

    void take_step(std::size_t step, const TakePiece& take, const Meanwhile& meanwhile) {
        std::size_t taken = 0; // a new reader goes on from there
        lease_.work([this] { open_again(); }, [&] { take_slabs(step, taken, take, meanwhile); });
    }

    // The reader makes the next slab while this process takes one. The first `taken` are skipped.
    void take_slabs(std::size_t step, std::size_t& taken, const TakePiece& take,
                    const Meanwhile& meanwhile) {
        const std::uint32_t all = described_.info.grid.vertices[2],
                            at_once = described_.slices_at_once;
        const std::size_t slice = described_.info.step_bytes() / all, slab_bytes = slice * at_once;
        const std::size_t slabs = (std::size_t{all} + at_once - 1) / at_once;
        const std::size_t places = std::min<std::size_t>(slabs, 2);
        const auto memory = lease_.reader().memory(places * slab_bytes);
        const auto slices_of = [&](std::size_t slab) {
            const auto first = static_cast<std::uint32_t>(slab * at_once);
            return Slices{first, std::min(at_once, all - first)};
        };
        std::size_t asked = taken;
        while (taken < slabs) {
            for (; asked < std::min(slabs, taken + places); ++asked)
                lease_.reader().ask(
                    ReadSlab{step, slices_of(asked), asked % places * slab_bytes, lease_.number()});
            std::size_t replied = taken;
            try {
                const auto slab =
                    memory.subspan(taken % places * slab_bytes, slices_of(taken).count * slice);
                meanwhile(slab.size());
                ++replied;
                lease_.expect<SlabRead>();
                ++taken;
                take(slab);
            } catch (const ReaderEnded&) {
                throw;
            } catch (...) {
                for (; replied < asked && lease_.reader().answers(); ++replied)
                    lease_.reader().reply();
                throw;
            }
        }
    }

    std::string name_;
    OpenFile open_;
    ReaderLease lease_;
    Described described_;
};

} // namespace

void let_readers_read(std::span<const KnownFile> files) {
    std::vector<fs::path> places;
    for (const KnownFile& file : files)
        if (file.format && !file.format->reader.empty())
            places.push_back(place_of(*file.format, file.path));
    readers_of_this_process().let_read(places);
}

std::unique_ptr<VolumeFile> open_foreign(ReaderPool& readers, const Format& format,
                                         const fs::path& path, const ReadOptions& options) {
    return std::make_unique<ForeignFile>(readers, format, path, options);
}

std::unique_ptr<VolumeFile> open_in_format(const Format& format, const fs::path& path,
                                           const ReadOptions& options) {
    const auto open = [&](const ReadOptions& how) {
        try {
            return format.open ? format.open(path, how)
                               : open_foreign(readers_of_this_process(), format, path, how);
        } catch (const Error&) {
            FileStart start(path);
            const std::string other = foreign_format_of(start);
            if (other.empty() || (format.headerless && options.dims) || begins_as(format, start))
                throw;
            throw Error("{}: {} by its name, its content is {}", path.string(), format.name, other);
        }
    };
    if (!options.crop && !options.stride)
        return open(options);
    ReadOptions whole = options, rest = options;
    whole.stride.reset();
    (format.reads_parts ? rest : whole).crop.reset();
    return cropped(open(whole), rest, path);
}

OpenVolumeFile opener_of(const Format& format) {
    return [&format](const fs::path& path, const ReadOptions& options) {
        return open_in_format(format, path, options);
    };
}

ListedFiles read_pvd(const fs::path& path) {
    ReaderPool& readers = readers_of_this_process();
    readers.let_read(path);
    ReaderLease lease(readers, program_of("vti"), path, false);
    ListedFiles files;
    lease.work([] {},
               [&] {
                   lease.reader().ask(ReadCollection{path});
                   files = lease.expect<Collected>().files;
               });
    for (const ListedFile& listed : files)
        if (!readers.may_read(listed.path))
            throw Error(leads_out(path, listed.path));
    return files;
}

} // namespace isochron::index
