// The shader files that are compiled into the library.
#include "render/gl/shader.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace isochron::render {
namespace {

TEST(ShaderFiles, EveryFileInTheFolderIsEmbeddedAsItIs) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(test_support::source_root() + "/render/shaders")) {
        ++files;
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        EXPECT_EQ(shader_file(entry.path().filename().string()).text, text) << entry.path();
    }
    EXPECT_EQ(files, shader_files().size());
}

TEST(ShaderFiles, AnUnknownNameIsAnErrorThatNamesIt) {
    try {
        shader_file("nothing.vert");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("nothing.vert"), std::string::npos);
    }
}

} // namespace
} // namespace isochron::render
