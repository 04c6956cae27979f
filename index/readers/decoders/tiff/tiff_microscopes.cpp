// Stacks as ScanImage, Zeiss LSM and MetaMorph describe them.
//
// "ScanImage BigTIFF specification", https://docs.scanimage.org; "LSM 5/7 release 6.0 file format",
// Carl Zeiss 2010; "MetaMorph stack (STK) image file format", Molecular Devices 2006.
#include "index/readers/decoders/tiff/tiff_microscopes.h"

#include "index/error.h"
#include "index/readers/formats/binary_header.h"
#include "index/readers/formats/length_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <sstream>

namespace isochron::index {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Numbers in a value of Matlab: `3`, `true`, `[1;2]`, `[-1.5 -1.5;2 2]`.
std::vector<double> matlab_numbers(std::string text) {
    std::ranges::replace_if(
        text,
        [](char c) { return c == '[' || c == ']' || c == ';' || c == ',' || c == '{' || c == '}'; },
        ' ');
    std::vector<double> numbers;
    for (const std::string& word : words_of(text)) {
        double number = word == "true" ? 1 : 0;
        std::from_chars(word.data(), word.data() + word.size(), number);
        numbers.push_back(number);
    }
    return numbers;
}

class ScanImageLines {
  public:
    explicit ScanImageLines(std::string text) {
        std::ranges::replace(text, '\r', '\n');
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            if (const auto field = field_of(line, '=')) {
                const bool prefixed = field->key.starts_with("scanimage.");
                values_.emplace(field->key.substr(prefixed ? 10 : 0), field->value);
            }
    }

    bool empty() const {
        return std::ranges::none_of(values_, [](const auto& value) {
            return value.first.starts_with("SI.") || value.first.starts_with("SI4.") ||
                   value.first.starts_with("SI5.") || value.first.starts_with("state.acq.");
        });
    }
    /// The numbers of the first of these keys that is there.
    std::vector<double> numbers(std::initializer_list<const char*> keys) const {
        for (const char* key : keys)
            if (const auto found = values_.find(key); found != values_.end())
                return matlab_numbers(found->second);
        return {};
    }
    double number(std::initializer_list<const char*> keys, double otherwise) const {
        const std::vector<double> found = numbers(keys);
        return found.empty() || !std::isfinite(found.front()) ? otherwise : found.front();
    }
    /// Whether newer versions sweep z fast.
    bool says_fast() const {
        const auto mode = values_.find("SI.hStackManager.stackMode");
        return mode != values_.end() && mode->second.find("fast") != std::string::npos &&
               number({"SI.hStackManager.enable"}, 0) != 0;
    }
    /// A number of pages along an axis; at least 1.
    std::size_t count(std::initializer_list<const char*> keys, double otherwise = 1) const {
        constexpr double kMost = 1 << 20;
        return static_cast<std::size_t>(std::clamp(number(keys, otherwise), 1.0, kMost));
    }

  private:
    std::map<std::string, std::string> values_;
};

std::size_t channels_of(const ScanImageLines& lines) {
    const auto saved =
        lines.numbers({"SI.hChannels.channelSave", "SI4.channelsSave", "SI5.channelsSave"});
    std::size_t old = 0;
    for (const char* key : {"state.acq.savingChannel1", "state.acq.savingChannel2",
                            "state.acq.savingChannel3", "state.acq.savingChannel4"})
        old += lines.number({key}, 0) != 0 ? 1 : 0;
    return std::max<std::size_t>({saved.size(), old, 1});
}

/// The field of view and what else places the pages.
void place_scanimage(const ScanImageLines& lines, double slice_step, TiffStack& stack) {
    const auto corners = lines.numbers({"SI.hRoiManager.imagingFovUm"});
    if (corners.size() == 8) {
        double low[2]{corners[0], corners[1]}, high[2]{corners[0], corners[1]};
        for (std::size_t i = 0; i < corners.size(); ++i) {
            low[i % 2] = std::min(low[i % 2], corners[i]);
            high[i % 2] = std::max(high[i % 2], corners[i]);
        }
        stack.field_of_view = {high[0] - low[0], high[1] - low[1]};
    }
    if (slice_step != 0 && stack.field_of_view.x > 0 && stack.field_of_view.y > 0)
        return set_spacing(stack.axes[2], std::abs(slice_step), "um");
    if (slice_step != 0 || stack.field_of_view.x > 0)
        stack.notes.push_back(fmt::format("stated and not used: the step of slices, {} um, or the "
                                          "field of view, as the other is not stated (--spacing)",
                                          std::abs(slice_step)));
    stack.field_of_view = {};
}

} // namespace

std::optional<TiffStack> scanimage_stack(const std::string& text, std::size_t pages) {
    const ScanImageLines lines(text);
    if (lines.empty())
        return std::nullopt;
    TiffStack stack{.channels = channels_of(lines)};
    const bool fast =
        lines.number({"SI.hFastZ.enable", "SI4.fastZEnable", "SI5.fastZEnable"}, 0) != 0 ||
        lines.says_fast();
    stack.slices =
        lines.count({"SI.hStackManager.actualNumSlices", "SI.hStackManager.numSlices",
                     "SI4.stackNumSlices", "SI5.stackNumSlices", "state.acq.numberOfZSlices"});
    std::size_t sweep = stack.slices, of_slice = 1;
    if (fast) { // the frames of the way back follow those of the volume
        sweep = lines.count(
            {"SI.hStackManager.numFramesPerVolumeWithFlyback", "SI.hFastZ.numFramesPerVolume"},
            static_cast<double>(sweep));
        const double back = lines.number({"SI4.fastZDiscardFlybackFrames"}, 0) != 0
                                ? lines.number({"SI4.fastZNumDiscardFrames"}, 0)
                                : 0;
        if (stack.slices == 1)
            stack.slices = lines.count({"SI.hStackManager.numFramesPerVolume"},
                                       static_cast<double>(sweep) -
                                           lines.number({"SI.hFastZ.numDiscardFlybackFrames"}, 0));
        sweep =
            std::max(sweep, stack.slices + static_cast<std::size_t>(std::clamp(back, 0.0, 1e6)));
    } else {
        const double averaged = lines.number({"SI.hScan2D.logAverageFactor"}, 1);
        of_slice = lines.count({"SI.hStackManager.framesPerSlice", "SI4.acqNumFrames",
                                "SI5.acqNumFrames", "state.acq.numberOfFrames"});
        if (lines.number({"state.acq.averaging"}, 0) != 0)
            of_slice = 1;
        if (averaged > 1)
            of_slice = std::max<std::size_t>(
                static_cast<std::size_t>(static_cast<double>(of_slice) / averaged), 1);
    }
    if (stack.channels * of_slice > pages) // another file's lines
        return TiffStack{.slices = pages};
    const std::size_t volume = stack.channels * sweep * of_slice;
    if (pages < volume) { // stopped, or one file of several
        stack.slices = std::max<std::size_t>(pages / (stack.channels * of_slice), 1);
        sweep = stack.slices;
        stack.notes.push_back(
            fmt::format("{} pages, a volume has {}: the whole slices are read", pages, volume));
    }
    const std::size_t volumes =
        std::max<std::size_t>(pages / (stack.channels * sweep * of_slice), 1);
    stack.frames = volumes * of_slice;
    for (std::size_t frame = 0; frame < stack.frames; ++frame)
        for (std::size_t slice = 0; slice < stack.slices; ++slice)
            for (std::size_t channel = 0; channel < stack.channels; ++channel) {
                const std::size_t at = frame / of_slice * sweep + slice;
                stack.planes.push_back(
                    {"", (at * of_slice + frame % of_slice) * stack.channels + channel, true});
            }
    if (sweep > stack.slices)
        stack.notes.push_back(fmt::format("frames of the way back are left out, {} of each volume",
                                          sweep - stack.slices));
    if (const std::size_t rest = pages % (stack.channels * sweep * of_slice);
        rest != 0 && pages > volume)
        stack.notes.push_back(
            fmt::format("the last {} pages are no whole volume and left out", rest));
    place_scanimage(
        lines,
        lines.number({"SI.hStackManager.actualStackZStepSize", "SI.hStackManager.stackZStepSize",
                      "SI4.stackZStepSize", "SI5.stackZStepSize", "state.acq.zStepSize"},
                     0),
        stack);
    if (const double rate = lines.number({"SI.hRoiManager.scanVolumeRate"}, 0); fast && rate > 0)
        set_spacing(stack.time, 1 / rate, "s");
    return stack;
}

std::optional<TiffStack> lsm_stack(const std::string& record, std::size_t pages,
                                   const BytesAt& bytes_at, const std::string& file) {
    constexpr std::size_t kLeast = 136; // up to the offset of the times
    constexpr std::uint32_t kVersion13 = 0x0300494c, kVersion15 = 0x0400494c;
    const BinaryHeader h(record, false);
    if (record.size() < kLeast ||
        (h.at<std::uint32_t>(0) != kVersion13 && h.at<std::uint32_t>(0) != kVersion15))
        return std::nullopt;
    const auto count = [&](std::size_t offset) {
        return static_cast<std::size_t>(std::max(h.at<std::int32_t>(offset), 1));
    };
    const auto positions = [&](std::size_t offset) {
        return record.size() >= offset + 4 ? count(offset) : 1;
    };
    constexpr std::size_t kPositions = 264, kTiles = 268;
    if (positions(kPositions) > 1 || positions(kTiles) > 1)
        throw Error("{}: LSM of {} positions and {} tiles, expected one of each; bfconvert -series "
                    "0 IN OUT.ome.tif of Bio-Formats makes OME-TIFF of it",
                    file, positions(kPositions), positions(kTiles));
    TiffStack stack{.slices = count(16), .frames = count(24)};
    if (stack.slices * stack.frames > pages) {
        const std::size_t whole = pages / stack.slices;
        if (whole == 0)
            throw Error("{}: truncated: {} pages, a step has {} slices", file, pages, stack.slices);
        stack.notes.push_back(
            fmt::format("{} of {} pages are there: the {} whole step{} of {} {} read", pages,
                        stack.slices * stack.frames, whole, whole == 1 ? "" : "s", stack.frames,
                        whole == 1 ? "is" : "are"));
        stack.frames = whole;
    }
    const auto scan = h.at<std::uint16_t>(88);
    if (scan == 3 || scan == 5 || scan == 9) // time before z
        for (std::size_t frame = 0; frame < stack.frames; ++frame)
            for (std::size_t slice = 0; slice < stack.slices; ++slice)
                stack.planes.push_back({"", slice * stack.frames + frame, true});
    constexpr double kMicrometers = 1e6;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        set_spacing(stack.axes[axis], h.at<double>(40 + 8 * axis) * kMicrometers, "um");
        if (const double first = h.at<double>(64 + 8 * axis);
            stack.axes[axis].regular && std::isfinite(first))
            stack.axes[axis].first = first * kMicrometers;
    }
    if (stack.frames < 2)
        return stack;
    set_spacing(stack.time, h.at<double>(112), "s");
    const std::uint64_t times_at = h.at<std::uint32_t>(132);
    const std::string times = times_at == 0 ? "" : bytes_at(times_at, 8 + 8 * stack.frames);
    if (times.size() != 8 + 8 * stack.frames)
        return stack;
    std::vector<double> at;
    for (std::size_t frame = 0; frame < stack.frames; ++frame)
        at.push_back(BinaryHeader(times, false).at<double>(8 + 8 * frame) -
                     BinaryHeader(times, false).at<double>(8));
    if (std::ranges::all_of(at, [](double t) { return std::isfinite(t); }) &&
        std::ranges::adjacent_find(at, std::greater_equal<>()) == at.end()) {
        stack.time.at = std::move(at);
        stack.time.unit = "s";
    }
    return stack;
}

std::optional<TiffStack> metamorph_stack(const BytesAt& bytes_at) {
    const std::string start = bytes_at(0, 8);
    if (start.size() < 8 || !start.starts_with(std::string_view("II*\0", 4)))
        return std::nullopt;
    const std::uint64_t directory = BinaryHeader(start, false).at<std::uint32_t>(4);
    const std::string number = bytes_at(directory, 2);
    if (number.size() < 2)
        return std::nullopt;
    const std::size_t entries = BinaryHeader(number, false).at<std::uint16_t>(0);
    const std::string listed = bytes_at(directory + 2, 12 * entries);
    struct Tag {
        std::size_t count = 0;
        std::uint64_t offset = 0;
    } planes, properties;
    for (std::size_t i = 0; 12 * i + 12 <= listed.size(); ++i) {
        const BinaryHeader h(listed, false);
        constexpr std::uint16_t kUic1 = 33628, kUic2 = 33629;
        const auto tag = h.at<std::uint16_t>(12 * i);
        if (tag == kUic1 || tag == kUic2)
            (tag == kUic1 ? properties : planes) = {h.at<std::uint32_t>(12 * i + 4),
                                                    h.at<std::uint32_t>(12 * i + 8)};
    }
    constexpr std::size_t kMostPlanes = 1 << 20;
    if (planes.count < 2 || planes.count > kMostPlanes)
        return std::nullopt;
    TiffStack stack{.slices = planes.count, .appended = true};
    const auto fraction = [&](const std::string& bytes, std::size_t at) {
        const BinaryHeader h(bytes, false);
        return h.at<std::uint32_t>(at) / static_cast<double>(h.at<std::uint32_t>(at + 4));
    };
    // Distance, day and millisecond of the making and of the change of each plane.
    constexpr std::size_t kPlane = 24;
    const std::string each = bytes_at(planes.offset, kPlane * planes.count);
    std::set<double> distances;
    for (std::size_t i = 0; kPlane * (i + 1) <= each.size(); ++i)
        distances.insert(fraction(each, kPlane * i));
    const double step = distances.empty() ? 0 : *distances.rbegin();
    std::array<double, 3> spacing{0, 0, step};
    std::string unit;
    constexpr std::size_t kMostProperties = 1000;
    const std::string pairs =
        bytes_at(properties.offset, 8 * std::min(properties.count, kMostProperties));
    for (std::size_t i = 0; 8 * i + 8 <= pairs.size(); ++i) {
        constexpr std::uint32_t kX = 4, kY = 5, kUnit = 6;
        const BinaryHeader h(pairs, false);
        const auto id = h.at<std::uint32_t>(8 * i);
        const std::uint64_t at = h.at<std::uint32_t>(8 * i + 4);
        if (id == kX || id == kY) {
            const std::string size = bytes_at(at, 8);
            spacing[id == kX ? 0 : 1] = size.size() == 8 ? fraction(size, 0) : 0;
        } else if (id == kUnit) {
            constexpr std::size_t kLongest = 64;
            const std::string text = bytes_at(at, 4 + kLongest);
            if (text.size() >= 4)
                unit = BinaryHeader(text, false)
                           .text(4, std::min<std::size_t>(
                                        BinaryHeader(text, false).at<std::uint32_t>(0), kLongest));
        }
    }
    for (std::size_t axis = 0; axis < 3 && !tidy_length_unit(unit).empty(); ++axis)
        set_spacing(stack.axes[axis], spacing[axis], unit);
    if (distances.size() > 1)
        stack.notes.push_back(fmt::format("distances of the planes of {} to {}: the last is taken "
                                          "for all",
                                          *distances.begin(), *distances.rbegin()));
    if (step == 0 && planes.count > 1)
        stack.notes.emplace_back("planes without a distance: if they are times of one plane, they "
                                 "are taken for slices");
    return stack;
}

} // namespace isochron::index
