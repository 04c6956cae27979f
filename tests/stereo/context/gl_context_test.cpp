// Contexts without a window: chosen by name, of the wanted version, drawing to framebuffer objects.
#include "stereo/context/gl_context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace isochron::stereo {
namespace {

template <typename Function>
Function load(const GlContext& context, const char* name) {
    return reinterpret_cast<Function>(context.loader()(name));
}

/// Clears a small framebuffer object and reads one pixel back.
std::array<unsigned char, 4> drawn_pixel(GlContext& context, float red, float green, float blue) {
    const auto gen_textures = load<PFNGLCREATETEXTURESPROC>(context, "glCreateTextures");
    const auto storage = load<PFNGLTEXTURESTORAGE2DPROC>(context, "glTextureStorage2D");
    const auto gen_framebuffers =
        load<PFNGLCREATEFRAMEBUFFERSPROC>(context, "glCreateFramebuffers");
    const auto attach =
        load<PFNGLNAMEDFRAMEBUFFERTEXTUREPROC>(context, "glNamedFramebufferTexture");
    const auto clear = load<PFNGLCLEARNAMEDFRAMEBUFFERFVPROC>(context, "glClearNamedFramebufferfv");
    const auto read = load<PFNGLGETTEXTUREIMAGEPROC>(context, "glGetTextureImage");
    GLuint texture = 0, framebuffer = 0;
    gen_textures(GL_TEXTURE_2D, 1, &texture);
    storage(texture, 1, GL_RGBA8, 1, 1);
    gen_framebuffers(1, &framebuffer);
    attach(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    const float color[] = {red, green, blue, 1};
    clear(framebuffer, GL_COLOR, 0, color);
    std::array<unsigned char, 4> pixel{};
    read(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, sizeof pixel, pixel.data());
    return pixel;
}

/// A new texture's name; contexts that share no objects count for themselves.
GLuint new_texture(GlContext& context) {
    GLuint texture = 0;
    load<PFNGLCREATETEXTURESPROC>(context, "glCreateTextures")(GL_TEXTURE_2D, 1, &texture);
    return texture;
}

TEST(GlContext, KindsHaveNames) {
    for (const ContextKind kind : {ContextKind::glfw, ContextKind::egl, ContextKind::osmesa})
        EXPECT_EQ(context_kind_from_name(name_of(kind)), kind);
    EXPECT_EQ(context_kind_from_name("glx"), std::nullopt);
}

class WindowlessContext : public testing::TestWithParam<ContextKind> {};

TEST_P(WindowlessContext, IsGl45CoreAndDrawsToFramebufferObjects) {
    const auto context = make_context(GetParam(), {.size = {320, 200}});
    EXPECT_FALSE(context->has_window());
    EXPECT_FALSE(context->should_close());
    EXPECT_EQ(context->framebuffer_size(), glm::ivec2(320, 200));
    EXPECT_TRUE(context->poll_events().empty());
    EXPECT_THAT(context->description(), testing::HasSubstr("OpenGL 4."));
    EXPECT_EQ(drawn_pixel(*context, 1, 0, 0.2f), (std::array<unsigned char, 4>{255, 0, 51, 255}));
}

TEST_P(WindowlessContext, CanBeMadeAgainAndBesideAnotherOfItsKind) {
    make_context(GetParam(), {});
    const auto first = make_context(GetParam(), {});
    {
        const auto second = make_context(GetParam(), {});
        EXPECT_EQ(drawn_pixel(*second, 0, 1, 0)[1], 255);
    }
    first->make_current();
    EXPECT_EQ(drawn_pixel(*first, 1, 0, 0)[0], 255);
}

TEST_P(WindowlessContext, RefusesAnEmptySizeInOneLine) {
    try {
        make_context(GetParam(), {.size = {0, 10}});
        FAIL() << "made a context of 0x10 pixels";
    } catch (const render::Error& error) {
        EXPECT_THAT(error.what(),
                    testing::StartsWith("context " + std::string(name_of(GetParam()))));
        EXPECT_THAT(error.what(), testing::HasSubstr("0x10"));
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    }
}

INSTANTIATE_TEST_SUITE_P(, WindowlessContext,
                         testing::Values(ContextKind::egl, ContextKind::osmesa),
                         [](const auto& kind) { return std::string(name_of(kind.param)); });

TEST(GlContext, KindsTakeTurnsInOneProcess) {
    const auto egl = make_context(ContextKind::egl, {});
    const auto osmesa = make_context(ContextKind::osmesa, {});
    for (GLuint turn = 1; turn <= 3; ++turn) {
        egl->make_current();
        EXPECT_THAT(egl->description(), testing::StartsWith("EGL, OpenGL 4."));
        EXPECT_EQ(new_texture(*egl), turn);
        osmesa->make_current();
        EXPECT_THAT(osmesa->description(), testing::StartsWith("OSMesa, OpenGL 4.5"));
        EXPECT_EQ(new_texture(*osmesa), turn);
    }
}

} // namespace
} // namespace isochron::stereo
