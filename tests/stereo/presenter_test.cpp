// The contents of a window's buffers, by a table of entry points that only counts.
#include "stereo/presenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace isochron::stereo {
namespace {

/// Everything that happened, in order; entry points are plain functions, so it is global.
std::vector<std::string>& story() {
    static std::vector<std::string> told;
    return told;
}

class ToldContext final : public GlContext {
  public:
    ToldContext(std::string name, bool stereo) : name_(std::move(name)), stereo_(stereo) {}
    void make_current() override { story().push_back(name_); }
    render::GlLoader loader() const override { return {}; }
    glm::ivec2 framebuffer_size() const override { return {64, 32}; }
    bool has_window() const override { return true; }
    bool has_stereo_buffers() const override { return stereo_; }
    void present() override { story().push_back("swap"); }
    bool should_close() const override { return false; }
    std::vector<interaction::WindowEvent> poll_events() override { return {}; }
    std::string description() const override { return name_; }

  private:
    std::string name_;
    bool stereo_;
};

/// Entry points that do nothing, but for those whose order matters.
render::Gl counting_gl() {
    const render::GlLoader nothing = [](const char*) { return reinterpret_cast<void*>(+[] {}); };
    render::Gl gl(nothing);
    gl.CreateFramebuffers = [](GLsizei, GLuint* names) { *names = 7; };
    gl.DeleteFramebuffers = [](GLsizei, const GLuint*) { story().push_back("delete"); };
    gl.CreateTextures = [](GLenum, GLsizei, GLuint* names) {
        static GLuint next = 0;
        *names = ++next;
    };
    gl.DeleteTextures = [](GLsizei, const GLuint*) {};
    gl.GetIntegerv = [](GLenum name, GLint* value) {
        value[0] = 16384;
        if (name == GL_MAX_VIEWPORT_DIMS)
            value[1] = value[0];
    };
    gl.TextureStorage2D = [](GLuint, GLsizei, GLenum, GLsizei, GLsizei) {};
    gl.TextureParameteri = [](GLuint, GLenum, GLint) {};
    gl.CheckNamedFramebufferStatus = [](GLuint, GLenum) -> GLenum {
        return GL_FRAMEBUFFER_COMPLETE;
    };
    gl.Disable = [](GLenum) {};
    gl.Flush = [] { story().push_back("flush"); };
    gl.FenceSync = [](GLenum, GLbitfield) -> GLsync {
        story().push_back("fence");
        return nullptr;
    };
    gl.WaitSync = [](GLsync, GLbitfield, GLuint64) { story().push_back("wait"); };
    gl.DeleteSync = [](GLsync) {};
    gl.NamedFramebufferTexture = [](GLuint, GLenum attachment, GLuint texture, GLint) {
        if (attachment == GL_COLOR_ATTACHMENT0)
            story().push_back("texture " + std::to_string(texture));
    };
    gl.BindFramebuffer = [](GLenum, GLuint) {};
    gl.DrawBuffer = [](GLenum buffer) {
        story().emplace_back(buffer == GL_BACK_LEFT    ? "left"
                             : buffer == GL_BACK_RIGHT ? "right"
                                                       : "back");
    };
    gl.BlitNamedFramebuffer = [](GLuint, GLuint, GLint, GLint, GLint, GLint, GLint, GLint, GLint,
                                 GLint, GLbitfield, GLenum) { story().push_back("blit"); };
    return gl;
}

class PresenterTest : public testing::Test {
  protected:
    PresenterTest() { story().clear(); }
    std::string texture(const render::RenderTarget& target) const {
        return "texture " + std::to_string(target.color_texture());
    }
    const render::Gl gl_ = counting_gl();
    render::RenderTarget left_{gl_, {64, 32}}, right_{gl_, {64, 32}};
};

TEST_F(PresenterTest, AQuadBufferedWindowGetsEachEyesPictureInItsBuffer) {
    ToldContext window("window", true);
    Presenter presenter(gl_, window, window);
    story().clear();
    presenter.present(left_, &right_);
    EXPECT_THAT(story(), testing::ElementsAre(texture(left_), "left", "blit", texture(right_),
                                              "right", "blit", "swap"));
}

TEST_F(PresenterTest, OtherWindowsGetOnePictureInAllTheirBuffers) {
    ToldContext plain("window", false), stereo("window", true);
    for (ToldContext* window : {&plain, &stereo}) {
        Presenter presenter(gl_, *window, *window);
        story().clear();
        presenter.present(left_, nullptr);
        EXPECT_THAT(story(), testing::ElementsAre(texture(left_), "back", "blit", "swap"));
    }
    Presenter presenter(gl_, plain, plain);
    story().clear();
    presenter.present(left_, &right_);
    EXPECT_THAT(story(), testing::ElementsAre(texture(left_), "back", "blit", "swap"))
        << "a window without a right buffer shows the left eye's picture";
}

TEST_F(PresenterTest, AnotherContextsWindowWaitsForTheDrawingAndTheDrawingForIt) {
    ToldContext drawing("drawing", false), window("window", false);
    {
        Presenter presenter(gl_, drawing, window);
        story().clear();
        presenter.present(left_, nullptr);
        EXPECT_THAT(story(),
                    testing::ElementsAre("fence", "flush", "window", "wait", texture(left_), "back",
                                         "blit", "swap", "fence", "flush", "drawing", "wait"));
        story().clear();
    }
    EXPECT_THAT(story(), testing::ElementsAre("fence", "flush", "window", "wait", "delete", "fence",
                                              "flush", "drawing", "wait"))
        << "the window's framebuffer goes in the window's context";
}

} // namespace
} // namespace isochron::stereo
