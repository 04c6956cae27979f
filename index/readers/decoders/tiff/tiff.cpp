// TIFF volumes: pages of a file, of several, or a file for each slice.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/decoders.h"
#include "index/readers/decoders/tiff/tiff_file.h"
#include "index/readers/decoders/tiff/tiff_metadata.h"
#include "index/readers/decoders/tiff/tiff_microscopes.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/named_file.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stored_file.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// `channel 1` where the file has no name for it.
std::vector<std::string> names_of_channels(const TiffStack& stack) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < stack.channels; ++i) {
        std::string name = i < stack.channel_names.size() ? stack.channel_names[i] : "";
        if (name.empty() || std::ranges::find(names, name) != names.end())
            name = stack.channels == 1 ? "intensity" : fmt::format("channel {}", i);
        names.push_back(std::move(name));
    }
    return names;
}

/// The file's own description, or that of the file beside it to which it refers.
std::string full_description(const TiffFile& file, const fs::path& path) {
    const std::string& own = file.description();
    const std::string name = ome_metadata_file(own);
    if (name.empty())
        return own;
    const fs::path beside = path.parent_path() / fs::path(path_named_in(path, name)).filename();
    if (lower_case(beside.extension().string()).starts_with(".tif"))
        return TiffFile(beside).description();
    constexpr std::uint64_t kLargest = std::uint64_t{256} << 20;
    return read_text(beside, kLargest);
}

/// @throws Error naming the file
TiffStack stack_in(const TiffFile& file, const fs::path& path, const ReadOptions& options) {
    const std::string name = path.string();
    const BytesAt bytes_at = [&](std::uint64_t offset, std::size_t count) {
        return file.bytes_at(offset, count);
    };
    if (auto stack = lsm_stack(file.lsm_record(), file.pages(), bytes_at, name)) {
        constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
        if (file_bytes(path) >= kMost)
            throw Error("{}: LSM of 4 GiB or more, whose places have wrapped, expected less; "
                        "bfconvert IN OUT.ome.tif of Bio-Formats makes OME-TIFF of it",
                        name);
        return *stack;
    }
    if (auto stack = metamorph_stack(bytes_at))
        return *stack;
    std::string said = full_description(file, path);
    if (file.software().starts_with("SI."))
        said = file.software() + "\n" + said;
    return stack_of(said, file.pages(), file.shape().samples, file.resolution(0),
                    file.resolution(1), options.array.value_or(""), name);
}

class TiffVolume final : public DecodedFile {
  public:
    TiffVolume(const fs::path& path, const ReadOptions& options)
        : path_(path), slices_(options.slices), first_(path),
          stack_(slices_.empty()
                     ? stack_in(first_, path, options)
                     : TiffStack{.slices = slices_.size(),
                                 // Files of other channels have been left out by this name.
                                 .channel_names = {options.array.value_or("intensity")}}) {
        const std::string name = path.string();
        if (stack_.appended)
            first_.take_appended(stack_.slices * stack_.frames * stack_.channels);
        if (slices_.empty())
            keep_whole_frames(
                stack_, [&](const TiffPlane& plane) { return is_there(plane); }, name);
        if (!stack_.planes.empty() && is_in_first(stack_.planes.front()))
            first_.take_shape_of(stack_.planes.front().page);
        choose(options, name);
        const TiffShape& shape = first_.shape();
        if (stack_.slices == 1 && stack_.frames > 1) {
            std::swap(stack_.slices, stack_.frames); // a volume of it shows more than nothing
            info_.notes.push_back("frames of one slice each: they are taken for slices");
            frames_are_slices_ = true;
        }
        info_.grid.vertices = checked_vertices(
            {std::int64_t{shape.width}, shape.height, static_cast<std::int64_t>(stack_.slices)},
            name);
        expect_few_steps(stack_.frames, name);
        chosen_.describe(info_);
        if (stack_.field_of_view.x > 0 && stack_.field_of_view.y > 0) {
            set_spacing(stack_.axes[0], stack_.field_of_view.x / shape.width, "um");
            set_spacing(stack_.axes[1], stack_.field_of_view.y / shape.height, "um");
        }
        const auto& [x, y, z] = stack_.axes;
        place_axes({.file = name, .name = info_.array, .axes = {z, y, x}}, layout_of_zyx(), options,
                   info_);
        calibrate();
        for (const auto& notes : {chosen_.notes(), stack_.notes, first_.notes()})
            info_.notes.insert(info_.notes.end(), notes.begin(), notes.end());
        if (shape.half)
            info_.notes.push_back("float16 values converted to f32");
        note_resolution();
        stack_.time.length = stack_.frames;
        if (!frames_are_slices_)
            place_steps(stack_.time, options, info_);
        if (!info_.times.empty()) // the last ones may have none
            stack_.frames = info_.times.size();
    }

    std::size_t steps() const override { return stack_.frames; }
    std::uint32_t slices_at_once() const override { return slices_worth_asking(info_); }
    std::uint64_t decoded_bytes() const override {
        const TiffShape& shape = first_.shape();
        return std::uint64_t{shape.width} * shape.height * shape.samples * size_of(shape.type);
    }

    void read(std::size_t step, Slices slices, std::span<std::byte> out) override {
        const std::size_t page = out.size() / slices.count;
        for (std::uint32_t i = 0; i < slices.count; ++i)
            read_slice(step, slices.first + i, out.subspan(i * page, page));
    }

  private:
    /// Chooses among the channels; of a file with several images also among these.
    void choose(const ReadOptions& options, const std::string& name) {
        const TiffShape& shape = first_.shape();
        std::vector<StoredArray> offered;
        for (const std::string& channel : names_of_channels(stack_))
            offered.push_back({.name = channel, .type = shape.type, .components = shape.samples});
        ReadOptions asked = options;
        if (!stack_.images.empty()) {
            const std::string& image = stack_.images[stack_.image];
            // By the image's name or identifier before the channel's, or by the channel's alone.
            const std::string said = options.array.value_or("");
            const std::string channel = said.substr(said.rfind('/') + 1);
            for (StoredArray& each : offered) {
                const bool is_meant = offered.size() == 1 || each.name == channel;
                each.name = offered.size() == 1 ? image : image + "/" + each.name;
                if (is_meant)
                    asked.array = each.name;
            }
        }
        chosen_ = choose_scalar(offered, asked, name);
        channel_ = static_cast<std::size_t>(
            std::ranges::find(offered, chosen_.array.name, &StoredArray::name) - offered.begin());
        for (std::size_t i = 0; i < stack_.images.size(); ++i)
            if (i != stack_.image)
                chosen_.offered.push_back(fmt::format("{} (another image)", stack_.images[i]));
    }

    /// The name of the file that holds a plane, without its folder.
    fs::path name_of_file(const TiffPlane& plane) const {
        return fs::path(path_named_in(path_, plane.file)).filename();
    }

    bool is_in_first(const TiffPlane& plane) const {
        return plane.file.empty() || name_of_file(plane) == path_.filename();
    }

    /// Whether the page of a plane is there; of other files, whether these are.
    bool is_there(const TiffPlane& plane) const {
        if (is_in_first(plane))
            return plane.page < first_.pages();
        std::error_code ignored;
        return fs::exists(path_.parent_path() / name_of_file(plane), ignored);
    }

    /// ImageJ calibrates 8 and 16 bits only.
    void calibrate() {
        if (stack_.scaling == Scaling{} && stack_.value_unit.empty())
            return;
        const TiffShape& shape = first_.shape();
        if (shape.type != StoredType::u8 && shape.type != StoredType::u16 &&
            shape.type != StoredType::i8 && shape.type != StoredType::i16) {
            info_.notes.push_back(
                fmt::format("stated and not used: calibration of {} values, as in "
                            "ImageJ",
                            name_of(shape.type)));
            return;
        }
        info_.scaling = stack_.scaling;
        info_.value_unit = stack_.value_unit;
    }

    /// Notes the resolution of a plain file: it may be that of a print or of a pixel, nobody can
    /// tell.
    void note_resolution() {
        const double x = first_.resolution(0), y = first_.resolution(1);
        const unsigned unit = first_.resolution_unit();
        const std::string& said = first_.description();
        if (!slices_.empty() || !(x > 0) || !(y > 0) || unit < 2 || unit > 3 ||
            said.starts_with("ImageJ=") || said.find("<OME") != said.npos)
            return;
        // Usual resolutions of screens and prints; 25.4 is what VTK and ITK write for pixels of 1 mm.
        constexpr std::array kUsual{1.0, 25.4, 72.0, 75.0, 96.0, 100.0, 150.0, 200.0, 300.0, 600.0};
        constexpr double kRounded = 0.01, kCentimeters = 2.54; // in an inch
        const double in_inch = unit == 2 ? x : x * kCentimeters;
        if (x == y && std::ranges::any_of(kUsual, [&](double usual) {
                return std::abs(in_inch / usual - 1) < kRounded;
            }))
            return;
        info_.notes.push_back(fmt::format("stated and not used: {} x {} pixels for each {} "
                                          "(--spacing, --length-unit)",
                                          x, y, unit == 2 ? "inch" : "cm"));
    }

    void read_slice(std::size_t step, std::uint32_t z, std::span<std::byte> out) {
        const std::size_t number =
            channel_ + stack_.channels * (frames_are_slices_ ? z : z + stack_.slices * step);
        TiffPlane plane{.file = "", .page = number, .there = true};
        if (!slices_.empty())
            plane = {slices_[z].string(), 0, true};
        else if (!stack_.planes.empty())
            plane = stack_.planes[number];
        TiffFile& file = file_of(plane);
        if (plane.page >= file.pages())
            throw Error("{}: truncated: {} pages, page {} is described", file.name(), file.pages(),
                        plane.page);
        Grid slice = info_.grid;
        slice.vertices[2] = 1;
        convert_planes(chosen_, slice, out, file.name(),
                       [&](std::size_t component, std::span<std::byte> samples) {
                           file.read(plane.page, static_cast<std::uint32_t>(component), samples);
                       });
    }

    TiffFile& file_of(const TiffPlane& plane) {
        if (is_in_first(plane))
            return first_;
        const fs::path path =
            slices_.empty() ? path_.parent_path() / name_of_file(plane) : fs::path(plane.file);
        if (!other_ || other_path_ != path) {
            other_.reset();
            other_ = std::make_unique<TiffFile>(path);
            other_path_ = path;
            if (other_->shape() != first_.shape())
                throw Error("{}: {}, {} has {}", path.string(), text(other_->shape()),
                            path_.string(), text(first_.shape()));
        }
        return *other_;
    }

    fs::path path_;
    std::vector<fs::path> slices_;
    TiffFile first_;
    TiffStack stack_;
    ChosenScalar chosen_;
    std::size_t channel_ = 0;
    bool frames_are_slices_ = false;
    std::unique_ptr<TiffFile> other_;
    fs::path other_path_;
};

} // namespace

std::unique_ptr<DecodedFile> decode_tiff(const fs::path& path, const ReadOptions& options) {
    return std::make_unique<TiffVolume>(path, options);
}

} // namespace isochron::index
