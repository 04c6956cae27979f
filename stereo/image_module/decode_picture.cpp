// Reads pictures of four formats, whatever their names, and the notes in them.
#include "stereo/image_module/picture_codec.h"

#include "render/gl/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace isochron::stereo::image_module {
namespace {

using namespace std::string_view_literals;

struct Beginning {
    PictureFormat format;
    std::string_view bytes;
};
constexpr std::array kBeginnings{Beginning{PictureFormat::png, "\x89PNG"sv},
                                 Beginning{PictureFormat::exr, "\x76\x2f\x31\x01"sv},
                                 Beginning{PictureFormat::jpeg, "\xff\xd8\xff"sv},
                                 Beginning{PictureFormat::tiff, "II*\0"sv},
                                 Beginning{PictureFormat::tiff, "MM\0*"sv},
                                 Beginning{PictureFormat::tiff, "II+\0"sv},
                                 Beginning{PictureFormat::tiff, "MM\0+"sv}};

/// What OpenImageIO says of a picture, in one line. It says it twice, or names the file, which the
/// caller does, too.
std::string one_line(std::string text) {
    text = text.substr(0, text.find('\n'));
    for (const std::string_view name : {" (\"picture\")"sv, "\"picture\" "sv})
        if (const std::size_t at = text.find(name); at != std::string::npos)
            text.erase(at, name.size());
    return text.empty() ? "the picture cannot be read" : text;
}

/// A file that a picture is read from. OpenImageIO loses memory where a PNG ends early. So such a
/// file seems to go on with zeros, which are no PNG either, and is refused afterwards.
class PictureFile final : public OIIO::Filesystem::IOFile {
  public:
    explicit PictureFile(const std::string& path) : IOFile(path, IOProxy::Read) {}
    std::size_t read(void* bytes, std::size_t size) override {
        const std::size_t done = IOFile::read(bytes, size);
        ended_ |= done < size;
        if (!goes_on_)
            return done;
        std::memset(static_cast<char*>(bytes) + done, 0, size - done);
        return size;
    }
    void go_on() { goes_on_ = true; }
    bool ended() const { return ended_; }

  private:
    bool goes_on_ = false, ended_ = false;
};

/// The format of a file by its first bytes, so that no other of OpenImageIO's many readers sees it.
PictureFormat format_in(OIIO::Filesystem::IOProxy& file) {
    if (!file.opened())
        throw std::runtime_error(one_line(file.error()));
    std::array<char, 4> begin{};
    const std::string_view read(begin.data(), file.pread(begin.data(), begin.size(), 0));
    const auto* found = std::ranges::find_if(
        kBeginnings, [&](const Beginning& beginning) { return read.starts_with(beginning.bytes); });
    if (found == kBeginnings.end())
        throw std::runtime_error("not a picture: expected PNG, EXR, TIFF or JPEG");
    return found->format;
}

/// While it is there, nothing is written to standard error: libpng and others write there what they
/// also return as an error. What other threads write there meanwhile is lost; pictures are read by
/// commands alone that do nothing else.
class QuietErrors {
  public:
    QuietErrors()
        : lock_(mutex()), kept_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
        const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (kept_ >= 0 && nowhere >= 0)
            dup2(nowhere, STDERR_FILENO);
        if (nowhere >= 0)
            close(nowhere);
    }
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;
    ~QuietErrors() {
        if (kept_ < 0)
            return;
        dup2(kept_, STDERR_FILENO);
        close(kept_);
    }

  private:
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    std::scoped_lock<std::mutex> lock_;
    int kept_;
};

/// A picture whose header has been read.
struct Reader {
    /// @param file stays there as long as the reader
    explicit Reader(OIIO::Filesystem::IOProxy& file) : format(format_in(file)) {
        set_up_library();
        input = OIIO::ImageInput::create(library_name_of(format));
        if (!input)
            throw std::runtime_error(one_line(OIIO::geterror()));
        OIIO::Filesystem::IOProxy* proxy = &file;
        OIIO::ImageSpec hints, opened;
        hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        hints.attribute("oiio:UnassociatedAlpha", 1); // colors as they are stored
        if (!input->open("picture", opened, hints))
            throw std::runtime_error(one_line(input->geterror()));
    }

    QuietErrors quiet;
    PictureFormat format;
    std::unique_ptr<OIIO::ImageInput> input;
};

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(value, 0), 1) * 255));
}

/// Which channels of a file are red, green, blue and alpha.
struct Channels {
    explicit Channels(const OIIO::ImageSpec& spec) : count(std::min(spec.nchannels, 4)) {
        if (count < 3 || spec.channelnames.at(0) == "Y")
            color = {0, 0, 0};
        if (spec.alpha_channel >= 0 && spec.alpha_channel < count)
            alpha = spec.alpha_channel;
    }

    int count; ///< read of those in the file
    std::array<int, 3> color{0, 1, 2};
    std::optional<int> alpha;
};

/// @param values of all pixels, `channels.count` each
template <typename Value, typename ByteOfColor, typename ByteOfAlpha>
render::Image image_of(const OIIO::ImageSpec& spec, const Channels& channels,
                       const std::vector<Value>& values, ByteOfColor byte_of_color,
                       ByteOfAlpha byte_of_alpha) {
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
    render::Image image{spec.width, spec.height, std::vector<std::uint8_t>(4 * pixels)};
    const Value* from = values.data();
    std::uint8_t* to = image.rgba.data();
    for (std::size_t i = 0; i < pixels; ++i, from += channels.count, to += 4) {
        for (std::size_t c = 0; c < 3; ++c)
            to[c] = byte_of_color(from[channels.color[c]]);
        to[3] = channels.alpha ? byte_of_alpha(from[*channels.alpha]) : std::uint8_t{255};
    }
    return image;
}

template <typename Value>
std::vector<Value> read_values(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int count,
                               OIIO::TypeDesc type) {
    std::vector<Value> values(static_cast<std::size_t>(spec.width) * spec.height * count);
    // Some libraries read a truncated file to its end without failing, and only note an error.
    if (!input.read_image(0, 0, 0, count, type, values.data()) || input.has_error())
        throw std::runtime_error(one_line(input.geterror()));
    return values;
}

render::Image image_in(OIIO::Filesystem::IOProxy& file) {
    const Reader reader(file);
    const OIIO::ImageSpec spec = reader.input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep || spec.nchannels < 1 ||
        static_cast<std::size_t>(spec.width) * spec.height > kMostPixels)
        throw std::runtime_error("a picture of " + std::to_string(spec.width) + " x " +
                                 std::to_string(spec.height) + " pixels and " +
                                 std::to_string(spec.nchannels) + " channels cannot be read");
    const Channels channels(spec);
    if (spec.format.is_floating_point()) // linear light
        return image_of(
            spec, channels,
            read_values<float>(*reader.input, spec, channels.count, OIIO::TypeDesc::FLOAT),
            [](float value) { return byte_of(render::srgb_from_linear(value)); }, byte_of);
    const auto same = [](std::uint8_t value) { return value; };
    return image_of(
        spec, channels,
        read_values<std::uint8_t>(*reader.input, spec, channels.count, OIIO::TypeDesc::UINT8), same,
        same);
}

std::string note_in(OIIO::Filesystem::IOProxy& file) {
    const Reader reader(file);
    std::string note(reader.input->spec().get_string_attribute(note_attribute_of(reader.format)));
    // JPEG's comments may end with a zero.
    note.erase(std::ranges::find(note, '\0'), note.end());
    return note;
}

/// What a function reads in the file at a path.
template <typename Function>
auto read_from(const std::string& path, Function function) {
    PictureFile file(path);
    if (format_in(file) != PictureFormat::png)
        return function(file);
    file.go_on();
    try {
        auto result = function(file);
        if (!file.ended())
            return result;
    } catch (const std::exception&) {
        if (!file.ended())
            throw;
    }
    throw std::runtime_error("the file ends early");
}

} // namespace

render::Image read(const std::string& path) {
    return read_from(path, image_in);
}

render::Image decode(std::span<const std::byte> bytes) {
    OIIO::Filesystem::IOMemReader file(const_cast<std::byte*>(bytes.data()), bytes.size());
    return image_in(file);
}

std::string note_of(const std::string& path) {
    return read_from(path, note_in);
}

} // namespace isochron::stereo::image_module
