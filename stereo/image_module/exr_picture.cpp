// EXR by OpenEXR: half floats of linear light.
#include "stereo/image_module/picture_codec.h"

#include "render/gl/srgb.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace isochron::stereo::image_module {
namespace {

class MemoryStream : public Imf::OStream {
  public:
    explicit MemoryStream(std::vector<std::byte>& bytes) : OStream("picture"), bytes_(bytes) {}
    void write(const char data[], int size) override {
        bytes_.resize(std::max(bytes_.size(), std::size_t(place_) + size));
        std::memcpy(bytes_.data() + place_, data, size);
        place_ += size;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }

  private:
    std::vector<std::byte>& bytes_;
    std::uint64_t place_ = 0;
};

constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(value, 0), 1) * 255));
}

} // namespace

std::vector<std::byte> encode_exr(const render::Image& image, const std::string& note) {
    std::array<Imath::half, 256> linear;
    for (int i = 0; i < 256; ++i)
        linear[i] = render::linear_from_srgb(static_cast<float>(i) / 255.0f);
    const auto pixels = static_cast<std::size_t>(image.width) * image.height;
    std::vector<Imath::half> rgb(3 * pixels);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = linear[image.rgba[i / 3 * 4 + i % 3]];
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c) {
        header.channels().insert(kChannels[c], Imf::Channel(Imf::HALF));
        frame.insert(kChannels[c],
                     Imf::Slice(Imf::HALF, reinterpret_cast<char*>(rgb.data() + c),
                                3 * sizeof(Imath::half), 3 * sizeof(Imath::half) * image.width));
    }
    if (!note.empty())
        header.insert(kNote, Imf::StringAttribute(note));
    std::vector<std::byte> bytes;
    MemoryStream stream(bytes);
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(image.height);
    } // the destructor writes the file's table of lines
    return bytes;
}

render::Image decode_exr(const std::string& path) {
    Imf::InputFile file(path.c_str(), 0);
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || std::size_t(width) * height > kMostPixels)
        throw std::runtime_error("a picture of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " pixels cannot be read");
    const bool gray = file.header().channels().findChannel("Y") != nullptr;
    std::vector<float> values(std::size_t(4) * width * height, 1.0f);
    Imf::FrameBuffer frame;
    const auto insert = [&](const char* name, std::size_t channel, double otherwise) {
        // OpenEXR counts pixels from the origin, not from the window's corner.
        char* base = reinterpret_cast<char*>(values.data() + channel) -
                     16 * (window.min.x + width * std::int64_t(window.min.y));
        frame.insert(name, Imf::Slice(Imf::FLOAT, base, 16, 16 * width, 1, 1, otherwise));
    };
    if (gray)
        insert("Y", 0, 0);
    else
        for (std::size_t c = 0; c < 3; ++c)
            insert(kChannels[c], c, 0);
    insert("A", 3, 1);
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    render::Image image{int(width), int(height), std::vector<std::uint8_t>(values.size())};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t c = i % 4;
        image.rgba[i] = c == 3 ? byte_of(values[i])
                               : byte_of(render::srgb_from_linear(values[gray ? i - c : i]));
    }
    return image;
}

std::string exr_note(const std::string& path) {
    const Imf::InputFile file(path.c_str(), 0);
    const auto* note = file.header().findTypedAttribute<Imf::StringAttribute>(kNote);
    return note ? note->value() : std::string();
}

} // namespace isochron::stereo::image_module
