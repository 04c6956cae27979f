// Packed rows are unpacked to the same numbers, and other bytes are refused.
#include "index/file/chunks/packed_rows.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace isochron::index {
namespace {

using Bytes = std::vector<std::byte>;

Bytes rows_of(const Bytes& numbers) {
    Bytes packed;
    pack_rows(numbers, packed);
    return packed;
}

/// A copy whose memory ends with its bytes, so that AddressSanitizer sees what is read beyond them.
Bytes exact(std::span<const std::byte> bytes) {
    return Bytes(bytes.begin(), bytes.end());
}

/// What the header says, bit by bit.
Bytes slow_rows_of(const Bytes& numbers) {
    const std::size_t rows = (numbers.size() + 15) / 16;
    Bytes packed((rows + 1) / 2, std::byte{0});
    for (std::size_t row = 0; row < rows; ++row) {
        std::array<unsigned, 16> fold{};
        unsigned bits = 0;
        for (std::size_t i = 0; i < 16 && row * 16 + i < numbers.size(); ++i) {
            const auto d = static_cast<std::int8_t>(numbers[row * 16 + i]);
            fold[i] = static_cast<unsigned>(d < 0 ? -2 * d - 1 : 2 * d);
            while (fold[i] >> bits)
                ++bits;
        }
        packed[row / 2] |= static_cast<std::byte>(row % 2 ? bits << 4 : bits);
        for (unsigned bit = 0; bit < bits; ++bit)
            for (std::size_t half = 0; half < 2; ++half) {
                unsigned byte = 0;
                for (std::size_t i = 0; i < 8; ++i)
                    byte |= (fold[half * 8 + i] >> bit & 1) << i;
                packed.push_back(static_cast<std::byte>(byte));
            }
    }
    return packed;
}

TEST(PackedRows, AreWhatTheirDescriptionSaysForEveryWidthAndLength) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 400; ++round) {
        Bytes numbers(round < 40 ? round + 1 : 1 + random() % 4200);
        const auto widest = static_cast<unsigned>(random() % 9);
        for (std::byte& number : numbers)
            number = static_cast<std::byte>(random() % (1u << random() % (widest + 1)) -
                                            (random() % 2 ? 0 : (1u << widest) / 2));
        const Bytes packed = rows_of(numbers);
        ASSERT_EQ(packed, slow_rows_of(numbers)) << numbers.size();
        Bytes again(numbers.size());
        ASSERT_TRUE(unpack_rows(exact(packed), again));
        ASSERT_EQ(again, numbers);
    }
}

/// What the header says of numbers of several bytes, bit by bit.
/// @param numbers the first bytes of all, then all second bytes, and so on
Bytes slow_word_rows_of(const Bytes& numbers, std::size_t word) {
    const std::size_t count = numbers.size() / word, rows = (count + 15) / 16;
    Bytes widths, planes;
    for (std::size_t row = 0; row < rows; ++row) {
        std::array<std::uint64_t, 16> of{};
        unsigned bits = 0;
        for (std::size_t i = 0; i < 16 && row * 16 + i < count; ++i) {
            for (std::size_t byte = 0; byte < word; ++byte)
                of[i] |= std::to_integer<std::uint64_t>(numbers[byte * count + row * 16 + i])
                         << 8 * byte;
            while (bits < 64 && of[i] >> bits)
                ++bits;
        }
        widths.push_back(static_cast<std::byte>(bits));
        const unsigned whole = bits / 8;
        for (unsigned byte = 0; byte < whole; ++byte)
            for (std::size_t i = 0; i < 16; ++i)
                planes.push_back(static_cast<std::byte>(of[i] >> 8 * byte & 255));
        for (unsigned bit = 8 * whole; bit < bits; ++bit)
            for (std::size_t half = 0; half < 2; ++half) {
                unsigned byte = 0;
                for (std::size_t i = 0; i < 8; ++i)
                    byte |= static_cast<unsigned>(of[half * 8 + i] >> bit & 1) << i;
                planes.push_back(static_cast<std::byte>(byte));
            }
    }
    widths.insert(widths.end(), planes.begin(), planes.end());
    return widths;
}

TEST(PackedRows, OfSeveralBytesAreWhatTheirDescriptionSays) {
    std::mt19937_64 random(test_seed());
    for (int round = 0; round < 400; ++round)
        for (const std::size_t word : {2u, 4u, 8u}) {
            const std::size_t count = round < 40 ? round + 1 : 1 + random() % 4200;
            const auto widest = random() % (8 * word + 1);
            Bytes numbers(count * word);
            for (std::size_t i = 0; i < count; ++i) {
                const auto bits = random() % (widest + 1);
                const std::uint64_t number = bits == 0 ? 0 : random() >> (64 - bits);
                for (std::size_t byte = 0; byte < word; ++byte)
                    numbers[byte * count + i] = static_cast<std::byte>(number >> 8 * byte & 255);
            }
            Bytes packed;
            pack_word_rows(numbers, word, packed);
            ASSERT_EQ(packed, slow_word_rows_of(numbers, word)) << count << ' ' << word;
            Bytes again(numbers.size());
            ASSERT_TRUE(unpack_word_rows(exact(packed), word, again));
            ASSERT_EQ(again, numbers);
            ASSERT_FALSE(
                unpack_word_rows(exact(std::span(packed).first(packed.size() - 1)), word, again));
            packed.push_back(std::byte{0});
            ASSERT_FALSE(unpack_word_rows(exact(packed), word, again));
            packed.pop_back();
            packed[0] = static_cast<std::byte>(8 * word + 1);
            ASSERT_FALSE(unpack_word_rows(exact(packed), word, again));
        }
}

TEST(PackedRows, OfAnotherLengthAreRefused) {
    const Bytes numbers(33, std::byte{0x83});
    Bytes packed = rows_of(numbers), out(33);
    ASSERT_TRUE(unpack_rows(exact(packed), out));
    for (std::size_t size = 0; size < packed.size(); ++size)
        EXPECT_FALSE(unpack_rows(exact(std::span(packed).first(size)), out)) << size;
    packed.push_back(std::byte{0});
    EXPECT_FALSE(unpack_rows(exact(packed), out));
    packed.pop_back();
    packed[1] |= std::byte{0x10};
    EXPECT_FALSE(unpack_rows(exact(packed), out)) << "a width of no row";
    packed[1] = std::byte{9};
    EXPECT_FALSE(unpack_rows(exact(packed), out)) << "nine bits of a byte";
}

} // namespace
} // namespace isochron::index
