// The windows of all stereo modes, compared with golden pictures and with the geometry of each
// eye's part.
#include "tests/support/drawing/golden_fixture.h"

#include "stereo/image_file.h"
#include "tests/support/paths.h"

#include <stdexcept>

namespace isochron::app {
namespace {

/// Whether a mode shows the right eye's picture in a channel of a pixel. For the upright modes that
/// put both eyes into one place and mix no channels.
bool shows_right(StereoMode mode, std::size_t x, std::size_t y, std::size_t channel) {
    switch (mode) {
    case StereoMode::anaglyph_red_cyan: return channel > 0;
    case StereoMode::vertical_interlaced: return y % 2 == 1;
    case StereoMode::horizontal_interlaced: return x % 2 == 1;
    case StereoMode::checkerboard: return (x + y) % 2 == 1;
    default: throw std::logic_error("not a mode of this kind");
    }
}

Image interleaved(StereoMode mode, const Image& left, const Image& right) {
    Image both = left;
    const auto width = static_cast<std::size_t>(both.width);
    for (std::size_t i = 0; i < both.rgba.size(); ++i)
        if (shows_right(mode, i / 4 % width, i / 4 / width, i % 4))
            both.rgba[i] = right.rgba[i];
    return both;
}

Image part_of(const Image& image, glm::ivec2 corner, glm::ivec2 size) {
    Image part{size.x, size.y, {}};
    for (int y = 0; y < size.y; ++y) {
        const std::uint8_t* row = image.at(corner.x, corner.y + y);
        part.rgba.insert(part.rgba.end(), row, row + std::ptrdiff_t{4} * size.x);
    }
    return part;
}

class GoldenModes : public GoldenPictures {
  protected:
    static Image golden(Eye eye) {
        return stereo::read_image((test_support::test_data() + "/golden/surface_") +
                                  std::string(name_of(eye)) + ".png");
    }
    /// A part of the window shows what this eye sees.
    void expect_view(const Session& session, const Image& part, Eye eye) const {
        const PinholeEye pinhole = before_window(session, eye, {part.width, part.height});
        expect_sphere(warm_part(part), expected_part(pinhole, kPlacement, kOuterRadius), 0.0);
        EXPECT_EQ(expect_box(part, pinhole, kPlacement), 12 * kPerEdge);
    }
    /// What a window shows, by geometry and by the eyes' golden pictures.
    void expect_window(const Session& session, StereoMode mode, const std::string& name) const {
        const Image window = session.outputs().display().read_window();
        // The eyes by the place in which they are shown.
        const Eye first = place_of(Eye::left, mode), second = place_of(Eye::right, mode);
        const glm::ivec2 half_width(kPicture.x / 2, kPicture.y);
        const glm::ivec2 half_height(kPicture.x, kPicture.y / 2);
        switch (upright(mode)) {
        case StereoMode::mono:
            EXPECT_TRUE(images_match(window, golden(Eye::center), tolerance_, name));
            [[fallthrough]];
        case StereoMode::left: // letters of one eye's picture begin at whole pixels
        case StereoMode::right: expect_view(session, window, eyes_of(mode).front()); break;
        case StereoMode::quadbuffer:
            EXPECT_TRUE(images_match(window, golden(first), tolerance_, name));
            EXPECT_TRUE(images_match(session.outputs().display().read_right_buffer(),
                                     golden(second), tolerance_, name + "_right"));
            break;
        case StereoMode::side_by_side:
            expect_view(session, part_of(window, {0, 0}, half_width), first);
            expect_view(session, part_of(window, {half_width.x, 0}, half_width), second);
            break;
        case StereoMode::top_bottom:
            expect_view(session, part_of(window, {0, 0}, half_height), first);
            expect_view(session, part_of(window, {0, half_height.y}, half_height), second);
            break;
        case StereoMode::anaglyph_dubois: break; // mixes: see the tests of its matrices
        default:
            EXPECT_TRUE(images_match(window,
                                     interleaved(upright(mode), golden(first), golden(second)),
                                     tolerance_, name));
        }
    }
};

INSTANTIATE_TEST_SUITE_P(, GoldenModes,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

/// Whether the mode's window has a golden picture of its own. An inverted one needs none where the
/// eyes' pictures, exchanged, say it all: only Dubois' anaglyph mixes them. Nor do those that show what
/// other golden pictures show.
bool has_picture(StereoMode mode) {
    switch (mode) {
    case StereoMode::mono:
    case StereoMode::quadbuffer: return false;
    default: return !is_inverted(mode) || upright(mode) == StereoMode::anaglyph_dubois;
    }
}

TEST_P(GoldenModes, EveryStereoMode) {
    Config config = one_window(StereoMode::mono);
    config.quality.settled = Footprint::surface;
    const auto context = stereo::make_context(GetParam(), {.size = kPicture});
    Session session(config, file_, *context);
    Commands commands = showing(kPlacement);
    for (const StereoMode mode : stereo::all_stereo_modes()) {
        const std::string name = "mode_" + std::string(name_of(mode));
        SCOPED_TRACE(name);
        commands.stereo = name_of(mode);
        ASSERT_EQ(settle(session, commands), Footprint::surface);
        ASSERT_EQ(session.outputs().display().mode(), mode);
        expect_window(session, mode, name);
        if (has_picture(mode)) {
            EXPECT_TRUE(
                matches_golden(session.outputs().display().read_window(), name, tolerance_));
        }
    }
}

} // namespace
} // namespace isochron::app
