// Packed chunks are unpacked to the same bytes, by every codec and in the ways of earlier files.
#include "index/file/chunks/chunk_codec.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace isochron::index {
namespace {

using Bytes = std::vector<std::byte>;
using Size = std::array<std::uint32_t, 3>;

constexpr std::array kTypes{ValueType::u8,  ValueType::i8,  ValueType::u16, ValueType::i16,
                            ValueType::i32, ValueType::f32, ValueType::f64};

std::size_t count_of(const Size& size) {
    return std::size_t{size[0]} * size[1] * size[2];
}

/// A smooth field with some noise, in steps of `grain`.
Bytes smooth(ValueType type, const Size& size, double noise, double grain, std::mt19937& random) {
    Bytes bytes(count_of(size) * size_of(type));
    std::normal_distribution<double> deviation;
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        std::size_t at = 0;
        for (std::uint32_t z = 0; z < size[2]; ++z)
            for (std::uint32_t y = 0; y < size[1]; ++y)
                for (std::uint32_t x = 0; x < size[0]; ++x, at += sizeof(T)) {
                    const double exact = 50 + 20 * std::sin(0.2 * x + 0.1 * y) * std::cos(0.1 * z) +
                                         noise * deviation(random);
                    const T value = static_cast<T>(grain * std::round(exact / grain));
                    std::memcpy(bytes.data() + at, &value, sizeof value);
                }
    });
    return bytes;
}

Bytes noise(ValueType type, const Size& size, std::mt19937& random) {
    Bytes bytes(count_of(size) * size_of(type));
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random() & 255);
    return bytes;
}

TEST(ChunkCodec, UnpacksWhatItHasPacked) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 60; ++round) {
        const auto edge = [&] {
            return round < 30 ? 16u : 1 + static_cast<unsigned>(random() % 16);
        };
        const Size size{edge(), edge(), edge()};
        for (const ValueType type : kTypes) {
            const bool real = type == ValueType::f32 || type == ValueType::f64;
            const double grain = real ? std::ldexp(1.0, -static_cast<int>(random() % 24)) : 4.0;
            for (const Bytes& values :
                 {smooth(type, size, 0, grain, random), smooth(type, size, 2, grain, random),
                  noise(type, size, random), Bytes(count_of(size) * size_of(type))})
                for (const Codec codec : {Codec::fitting, Codec::none, Codec::lz4, Codec::zstd})
                    for (const bool wide_rows : {false, true}) {
                        Bytes packed, again(values.size());
                        ChunkPacker(codec, wide_rows).pack(type, size, values, packed);
                        ASSERT_LE(packed.size(), values.size() + 1);
                        ASSERT_TRUE(unpack_chunk(type, size, packed, again));
                        ASSERT_EQ(again, values);
                    }
        }
    }
}

TEST(ChunkCodec, StoresNoiseAsItIsAndShrinksWhatHasZerosAtTheEnd) {
    std::mt19937 random(test_seed());
    const Size size{16, 16, 16};
    const auto packed_size = [&](ValueType type, const Bytes& values) {
        Bytes packed;
        ChunkPacker(Codec::fitting).pack(type, size, values, packed);
        return packed.size();
    };
    for (const ValueType type : kTypes)
        EXPECT_EQ(packed_size(type, noise(type, size, random)), 4096 * size_of(type) + 1);
    // Whole numbers in 4 or 8 bytes: the last bits of all are zero.
    EXPECT_LT(packed_size(ValueType::f32, smooth(ValueType::f32, size, 0, 1, random)), 4096u);
    EXPECT_LT(packed_size(ValueType::f64, smooth(ValueType::f64, size, 0, 1, random)), 4096u);
}

TEST(ChunkCodec, RefusesOtherBytesOrGivesOtherValues) {
    std::mt19937 random(test_seed());
    const Size size{16, 15, 9};
    for (const ValueType type : kTypes) {
        const Bytes values = smooth(type, size, 1, type == ValueType::f32 ? 0.25 : 1, random);
        Bytes packed, again(values.size());
        ChunkPacker(Codec::fitting).pack(type, size, values, packed);
        for (int round = 0; round < 2000; ++round) { // never reads or writes outside
            Bytes damaged = packed;
            damaged[random() % damaged.size()] ^= static_cast<std::byte>(1u << random() % 8);
            if (random() % 2)
                damaged.resize(random() % (damaged.size() + 1));
            unpack_chunk(type, size, damaged, again);
        }
        // A shift by more bits than a value has.
        if (size_of(type) > 1) {
            packed[1] = std::byte{64};
            EXPECT_FALSE(unpack_chunk(type, size, packed, again));
        }
    }
}

} // namespace
} // namespace isochron::index
