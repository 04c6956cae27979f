// Fuzz targets: descriptions of volumes that readers parse themselves, beside libraries that decode
// values.
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/targets.h"

#include "index/error.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/model/model.h"
#include "index/readers/decoders/reader_service.h"
#include "index/readers/decoders/tiff/tiff_metadata.h"
#include "index/readers/decoders/tiff/tiff_microscopes.h"
#include "index/readers/decoders/zarr/zarr_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::fuzz {
namespace {

/// Reads what was opened, in slabs as readers do.
void read_decoded(index::DecodedFile& file) {
    constexpr std::size_t kMostBytes = 1 << 20, kMostSteps = 4;
    const index::SeriesInfo& info = file.info();
    claim(file.steps() > 0, "a file has a step");
    claim(info.times.empty() || info.times.size() == file.steps(), "every step has a time");
    const std::uint32_t slices = info.grid.vertices[2], at_once = file.slices_at_once();
    claim(at_once > 0 && at_once <= slices, "a slab is a part of a step");
    if (info.step_bytes() > kMostBytes || file.decoded_bytes() > (std::uint64_t{1} << 31))
        return;
    std::vector<std::byte> step(info.step_bytes());
    for (std::size_t t = 0; t < std::min(file.steps(), kMostSteps); ++t)
        for (std::uint32_t first = 0; first < slices; first += at_once) {
            const std::uint32_t count = std::min(at_once, slices - first);
            const std::size_t slice = step.size() / slices;
            file.read(t, {first, count}, std::span(step).subspan(first * slice, count * slice));
        }
}

template <class Open>
void open_and_read(const Open& open, Bytes input) {
    index::ReadOptions options;
    options.any_array = input.size() % 2 == 1;
    options.extra_axis_is_time = input.size() % 4 >= 2;
    try {
        const auto file = open(options);
        if (file)
            read_decoded(*file);
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what())); // as a reader sends it
    }
}

/// A hierarchy in memory: a line `@key` before each value.
class TextStore final : public index::ZarrStore {
  public:
    explicit TextStore(Bytes input) : ZarrStore("store") {
        const std::string text(input.begin(), input.end());
        for (std::size_t at = text.starts_with('@') ? 0 : text.npos; at != text.npos;) {
            const std::size_t line = std::min(text.find('\n', at), text.size());
            const std::size_t next = text.find("\n@", line);
            const std::size_t begin = std::min(line + 1, text.size());
            values_[text.substr(at + 1, line - at - 1)] =
                text.substr(begin, next == text.npos ? next : next - std::min(begin, next));
            at = next == text.npos ? next : next + 1;
        }
    }

    using ZarrStore::read;
    bool read(const std::string& key, index::ZarrBytes& into) const override {
        const auto found = values_.find(key);
        if (found == values_.end())
            return false;
        into.resize(found->second.size());
        part(key, 0, into);
        return true;
    }
    std::optional<std::uint64_t> size_of_value(const std::string& key) const override {
        const auto found = values_.find(key);
        return found == values_.end() ? std::nullopt : std::optional(found->second.size());
    }
    void part(const std::string& key, std::uint64_t at, std::span<std::byte> into) const override {
        const std::string& value = values_.at(key);
        if (at > value.size() || into.size() > value.size() - at)
            throw index::Error("store: truncated");
        std::ranges::copy(std::as_bytes(std::span(value)).subspan(at, into.size()), into.begin());
    }
    std::vector<std::string> names(const std::string& group) const override {
        const std::string prefix = group.empty() ? "" : group + "/";
        std::set<std::string> found;
        for (const auto& [key, value] : values_)
            if (key.starts_with(prefix))
                found.insert(
                    key.substr(prefix.size(), key.find('/', prefix.size()) - prefix.size()));
        return {found.begin(), found.end()};
    }

  private:
    std::map<std::string, std::string> values_;
};

void fuzz_zarr(Bytes input) {
    open_and_read(
        [&](const index::ReadOptions& options) {
            return index::decode_zarr(std::make_unique<TextStore>(input), options);
        },
        input);
}

void fuzz_zarr_zip(Bytes input) {
    const MemoryFile file(input);
    open_and_read(
        [&](const index::ReadOptions& options) {
            return index::decode_zarr(index::open_zarr_store(file.path()), options);
        },
        input);
}

void fuzz_xdmf(Bytes input) {
    static const ValueFiles kFiles;
    const std::string path = kFiles.with_header("h.xmf", input);
    open_and_read(
        [&](const index::ReadOptions& options) { return index::decode_xdmf(path, options); },
        input);
}

void fuzz_vti(Bytes input) {
    const MemoryFile file(input);
    open_and_read(
        [&](const index::ReadOptions& options) { return index::decode_vti(file.path(), options); },
        input);
}

void fuzz_pvd(Bytes input) {
    const MemoryFile file(input);
    try {
        const index::ListedFiles files = index::decode_pvd(file.path());
        claim(!files.empty(), "a collection lists files");
        for (const index::ListedFile& each : files)
            claim(std::isfinite(each.time), "times are finite");
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what()));
    }
}

void expect_whole(const index::TiffStack& stack) {
    claim(stack.channels > 0 && stack.slices > 0 && stack.frames > 0, "a stack has pages");
    claim(stack.planes.empty() ||
              stack.planes.size() == stack.channels * stack.slices * stack.frames,
          "every plane has a page");
    claim(stack.time.at.empty() || stack.time.at.size() == stack.frames, "every frame has a time");
}

/// A TIFF of 1 to 64 pages, as many as the input's length leaves.
void fuzz_tiff_description(Bytes input) {
    const std::string text(input.begin(), input.end());
    const std::size_t pages = 1 + input.size() % 64;
    const auto samples = static_cast<std::uint32_t>(1 + input.size() % 3);
    try {
        index::TiffStack stack = index::stack_of(text, pages, samples, 300, 300,
                                                 input.size() % 2 == 0 ? "" : "Image:1", "t.tif");
        keep_whole_frames(
            stack, [&](const index::TiffPlane& plane) { return plane.page < pages; }, "t.tif");
        expect_whole(stack);
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what()));
    }
}

/// The record of Zeiss LSM, ScanImage's lines, or the start of a file of MetaMorph.
void fuzz_tiff_microscopes(Bytes input) {
    const std::string text(input.begin(), input.end());
    const std::size_t pages = 1 + input.size() % 64;
    const auto bytes_at = [&](std::uint64_t offset, std::size_t count) {
        return offset < text.size() ? text.substr(offset, count) : std::string();
    };
    try {
        if (const auto stack = index::scanimage_stack(text, pages))
            expect_whole(*stack);
        if (const auto stack = index::lsm_stack(text, pages, bytes_at, "t.lsm"))
            expect_whole(*stack);
        if (const auto stack = index::metamorph_stack(bytes_at))
            expect_whole(*stack);
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what()));
    }
}

/// A letter for the format, then the file.
void fuzz_model(Bytes input) {
    if (input.empty())
        return;
    const auto parse = input[0] == 's'   ? index::stl_model
                       : input[0] == 'p' ? index::ply_model
                                         : index::obj_model;
    try {
        const index::TriangleMesh mesh =
            index::finished(parse(std::as_bytes(input.subspan(1)), "m"), "m");
        claim(!mesh.corners.empty() && mesh.corners.size() % 3 == 0, "a model has triangles");
        claim(mesh.normals.size() == mesh.points.size(), "every point has a normal");
        for (const std::uint32_t corner : mesh.corners)
            claim(corner < mesh.points.size(), "a corner is a point");
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                claim(std::isfinite(mesh.points[i][axis]) && std::isfinite(mesh.normals[i][axis]) &&
                          std::isfinite(mesh.origin[axis]),
                      "places and normals are finite");
    } catch (const index::Error& error) {
        claim_one_line(index::in_one_line(error.what()));
    }
}

} // namespace

std::span<const Target> decoder_targets() {
    static constexpr std::array kTargets{Target{"zarr", fuzz_zarr},
                                         Target{"zarr_zip", fuzz_zarr_zip},
                                         Target{"xdmf", fuzz_xdmf},
                                         Target{"tiff_description", fuzz_tiff_description},
                                         Target{"tiff_microscopes", fuzz_tiff_microscopes},
                                         Target{"vti", fuzz_vti},
                                         Target{"pvd", fuzz_pvd},
                                         Target{"model", fuzz_model}};
    return kTargets;
}

} // namespace isochron::fuzz
