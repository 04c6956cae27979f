// The storage that buffer textures get.
#include "render/gl/buffer_texture.h"

#include <gtest/gtest.h>

#include <bit>

namespace isochron::render {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 27;

TEST(TexelStorage, IsEnoughAndOfTheOneKindThatShadersAreCompiledFor) {
    for (std::size_t bytes = 0; bytes < 200'000; ++bytes) {
        const std::size_t storage = texel_storage(bytes, kMost);
        ASSERT_GE(storage, bytes);
        ASSERT_LE(storage, bytes + 768);
        ASSERT_FALSE(std::has_single_bit(storage)) << bytes;
        ASSERT_NE(storage & 0xff00, 0u) << bytes;
    }
}

TEST(TexelStorage, IsNoMoreThanNeededWhereTheSizeIsOfThatKind) {
    EXPECT_EQ(texel_storage(1000, kMost), 1000u);
    EXPECT_EQ(texel_storage(1024, kMost), 1280u);
    EXPECT_EQ(texel_storage(65'536 + 16, kMost), 65'536u + 272);
}

TEST(TexelStorage, IsNoMoreThanTheGlCanHold) {
    EXPECT_EQ(texel_storage(65'536, 65'792), 65'792u);
    EXPECT_EQ(texel_storage(65'536, 65'600), 65'600u);
    EXPECT_EQ(texel_storage(65'536, 65'536), 65'536u);
    EXPECT_EQ(texel_storage(65'536, 60'000), 65'536u) << "what it is asked for it gives";
}

} // namespace
} // namespace isochron::render
