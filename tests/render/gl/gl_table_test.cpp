// The table of entry points, its owners of objects, and shaders that must compile.
#include "render/gl/shader.h"
#include "stereo/multiplex.h"
#include "tests/support/drawing/gl_test.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace isochron::render {
namespace {

TEST(Gl, AMissingEntryPointIsNamed) {
    static int something = 0;
    try {
        Gl([](const char* name) -> void* {
            return std::strcmp(name, "glTextureBuffer") == 0 ? nullptr : &something;
        });
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("glTextureBuffer"), std::string::npos);
    }
}

int deleted_buffers = 0;
void APIENTRY count_deleted(GLsizei count, const GLuint*) {
    deleted_buffers += count;
}
void APIENTRY give_name(GLsizei, GLuint* name) {
    *name = 7;
}

TEST(GlObjects, AreDeletedOnceHoweverTheyMove) {
    static int nothing = 0;
    Gl gl([](const char*) -> void* { return &nothing; });
    gl.CreateBuffers = give_name;
    gl.DeleteBuffers = count_deleted;
    deleted_buffers = 0;
    {
        Buffer first(gl);
        Buffer second(std::move(first));
        Buffer third(gl);
        third = std::move(second);
        EXPECT_EQ(third.name(), 7u);
    }
    EXPECT_EQ(deleted_buffers, 2);
}

class Shaders : public GlTest {};

TEST_P(Shaders, EveryFileCompilesAndLinksAloneOrWithOneOfTheOtherStage) {
    const std::string prelude = stereo::Multiplex::shader_prelude() + "#define LAYERS 2\n";
    for (const ShaderSource& file : shader_files()) {
        if (file.name.ends_with(".glsl"))
            continue; // a part of others
        if (file.name.ends_with(".comp")) {
            EXPECT_NO_THROW(link_program(gl_, {file})) << file.name;
            continue;
        }
        bool links = false;
        std::string complaints;
        for (const ShaderSource& other : shader_files()) {
            if (links || other.name.ends_with(".glsl") || other.name.ends_with(".comp") ||
                other.name.ends_with(".frag") == file.name.ends_with(".frag"))
                continue;
            try {
                link_program(gl_, {file, other}, prelude);
                links = true;
            } catch (const Error& error) {
                complaints += std::string(error.what()) + '\n';
            }
        }
        EXPECT_TRUE(links) << file.name << ":\n" << complaints;
    }
}

TEST_P(Shaders, ABrokenOneStopsWithItsNameAndLog) {
    try {
        link_program(gl_, {{"broken.vert", "#version 450 core\nvoid main() { nonsense = 1; }\n"}});
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("broken.vert: ")) << message;
        EXPECT_NE(message.find("nonsense"), std::string::npos) << message;
    }
}

TEST_P(Shaders, ABrokenOneSaysWhichNumbersItsFilesHave) {
    const auto is_srgb = [](const ShaderSource& file) { return file.name == "srgb.glsl"; };
    const auto number = std::ranges::find_if(shader_files(), is_srgb) - shader_files().begin();
    try {
        link_program(gl_, {{"broken.frag", "#version 450 core\n#include \"srgb.glsl\"\n"
                                           "void main() { nonsense = 1; }\n"}});
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string message = error.what();
        const std::string own = std::to_string(shader_files().size());
        EXPECT_NE(message.find(own + " is broken.frag"), std::string::npos) << message;
        EXPECT_NE(message.find(std::to_string(number) + " is srgb.glsl"), std::string::npos)
            << message;
    }
}

TEST_P(Shaders, StagesThatDoNotFitStopWithBothNames) {
    try {
        link_program(gl_,
                     {{"a.vert", "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n"},
                      {"b.frag", "#version 450 core\nin vec3 lost; out vec4 c;\n"
                                 "void main() { c = vec4(lost, 1); }\n"}});
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with("a.vert, b.frag: ")) << message;
        EXPECT_NE(message.find("lost"), std::string::npos) << message;
    }
}

INSTANTIATE_TEST_SUITE_P(, Shaders, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
