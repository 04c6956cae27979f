// Random changes of inputs.
#include "tests/fuzz/changes.h"

#include "tests/fuzz/packed_mutation.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

namespace isochron::fuzz {
namespace {

constexpr std::size_t kMostBytes = 16384;

/// Changes what was packed, for `mutate_packed`, which gives its function nothing but the bytes.
std::size_t change_unpacked(std::uint8_t* data, std::size_t size, std::size_t /*most*/) {
    static std::mt19937 random(1);
    if (size > 0)
        data[random() % size] ^= static_cast<std::uint8_t>(1u << random() % 8);
    return size;
}

void put(Input& input, std::size_t at, std::string_view bytes, bool over) {
    const auto place = input.begin() + static_cast<std::ptrdiff_t>(at);
    if (!over) {
        input.insert(place, bytes.begin(), bytes.end());
        return;
    }
    const std::size_t room = std::min(bytes.size(), input.size() - at);
    std::copy_n(bytes.begin(), room, place);
}

} // namespace

std::vector<Input> inputs_in(const std::vector<std::filesystem::path>& folders) {
    std::vector<Input> inputs;
    for (const std::filesystem::path& folder : folders) {
        if (!std::filesystem::exists(folder))
            continue;
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            files.push_back(entry.path());
        std::ranges::sort(files); // folders have no order of their own
        for (const std::filesystem::path& path : files) {
            std::ifstream file(path, std::ios::binary);
            Input input(std::istreambuf_iterator<char>(file), {});
            input.resize(std::min(input.size(), kMostBytes));
            inputs.push_back(std::move(input));
        }
    }
    return inputs;
}

std::vector<std::string> words_in(const std::filesystem::path& dictionary) {
    std::vector<std::string> words;
    std::ifstream file(dictionary);
    for (std::string line; std::getline(file, line);) {
        const std::size_t open = line.find('"'), close = line.rfind('"');
        if (open == line.npos || close <= open || line.front() == '#')
            continue;
        std::string word;
        for (std::size_t i = open + 1; i < close; ++i) {
            if (line[i] == '\\' && line[i + 1] == 'x') {
                word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
                i += 3;
            } else {
                word += line[i] == '\\' ? line[++i] : line[i];
            }
        }
        words.push_back(word);
    }
    return words;
}

std::size_t Changes::below(std::size_t end) {
    return end == 0 ? 0 : static_cast<std::size_t>(random_() % end);
}

void Changes::change(Input& input) {
    constexpr std::array<std::string_view, 12> kNumbers{
        "0",    "-1",  "1e308", "nan",        "4294967296", "18446744073709551615",
        "1e-9", "0.5", "-0",    "2147483647", "65536",      "99999999999999999999"};
    const std::size_t at = below(input.size() + 1), rest = input.size() - at;
    switch (below(8)) {
    case 0: // a bit
        if (rest > 0)
            input[at] ^= static_cast<std::uint8_t>(1u << below(8));
        break;
    case 1: { // an extreme byte
        constexpr std::array<std::uint8_t, 6> kBytes{0, 1, 0x7f, 0x80, 0xff, '\n'};
        if (rest > 0)
            input[at] = kBytes[below(kBytes.size())];
        break;
    }
    case 2: // a number, over others or before them
        put(input, at, kNumbers[below(kNumbers.size())], below(2) == 0);
        break;
    case 3: // a word of the format
        if (!words_.empty())
            put(input, at, words_[below(words_.size())], below(2) == 0);
        break;
    case 4: { // a piece is missing
        const auto begin = input.begin() + static_cast<std::ptrdiff_t>(at);
        input.erase(
            begin, begin + static_cast<std::ptrdiff_t>(below(std::min<std::size_t>(rest, 64) + 1)));
        break;
    }
    case 5: { // a piece is there twice
        const std::string piece(
            input.begin() + static_cast<std::ptrdiff_t>(at),
            input.begin() +
                static_cast<std::ptrdiff_t>(at + below(std::min<std::size_t>(rest, 256) + 1)));
        put(input, below(input.size() + 1), piece, false);
        break;
    }
    case 6: { // the end is another one's
        const Input& other = inputs_[below(inputs_.size())];
        const std::size_t from = below(other.size() + 1);
        input.resize(at);
        input.insert(input.end(), other.begin() + static_cast<std::ptrdiff_t>(from), other.end());
        break;
    }
    default: // eight bytes of a large number
        for (std::size_t i = at; i < std::min(at + 8, input.size()); ++i)
            input[i] = static_cast<std::uint8_t>(below(256));
    }
    input.resize(std::min(input.size(), kMostBytes));
}

Input Changes::next() {
    Input input = inputs_[below(inputs_.size())];
    if (below(2) == 0) {
        Input packed = input;
        packed.resize(kMostBytes);
        std::copy(input.begin(), input.end(), packed.begin());
        // The stream ends the file: the room behind it is not part of it.
        if (const auto size = mutate_packed({packed.data(), input.size()}, kMostBytes,
                                            static_cast<unsigned>(random_()), change_unpacked)) {
            packed.resize(*size);
            return packed;
        }
    }
    for (std::size_t left = 1 + below(4); left > 0; --left)
        change(input);
    return input;
}

} // namespace isochron::fuzz
