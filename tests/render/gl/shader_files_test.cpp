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
    const std::filesystem::path folder(test_support::source_root() + "/render/shaders");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file())
            continue;
        ++files;
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        const ShaderSource& embedded = shader_file(entry.path().filename().string());
        EXPECT_EQ(embedded.text, text) << entry.path();
        EXPECT_EQ(embedded.path, std::filesystem::relative(entry.path(), folder).string());
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
