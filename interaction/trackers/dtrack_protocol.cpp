// Reads the datagrams of DTrack.
#include "interaction/trackers/dtrack_protocol.h"

#include <charconv>
#include <cmath>
#include <span>

namespace isochron::interaction {
namespace {

constexpr double kMillimeter = 1e-3;     ///< [m]
constexpr double kMostBlocks = 1024;     ///< blocks in one line
constexpr std::size_t kMostNumbers = 64; ///< numbers in one block; the longest known has 12

void skip_blanks(std::string_view& text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
}

/// The next finite number of `text`.
std::optional<double> take_number(std::string_view& text) {
    skip_blanks(text);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value))
        return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::optional<double> take_whole(std::string_view& text, double low, double high) {
    const auto value = take_number(text);
    if (!value || *value != std::floor(*value) || *value < low || *value > high)
        return std::nullopt;
    return value;
}

using Block = std::vector<double>;

/// The numbers between the next `[` and `]`.
std::optional<Block> take_block(std::string_view& text) {
    skip_blanks(text);
    if (text.empty() || text.front() != '[')
        return std::nullopt;
    text.remove_prefix(1);
    Block numbers;
    for (skip_blanks(text); !text.empty() && text.front() != ']'; skip_blanks(text)) {
        const auto number = take_number(text);
        if (!number || numbers.size() == kMostNumbers)
            return std::nullopt;
        numbers.push_back(*number);
    }
    if (text.empty())
        return std::nullopt;
    text.remove_prefix(1);
    return numbers;
}

std::optional<int> id_of(const Block& block) {
    const bool whole = !block.empty() && block[0] == std::floor(block[0]);
    if (!whole || block[0] < 0 || block[0] > 65535)
        return std::nullopt;
    return static_cast<int>(block[0]);
}

/// A position of 3 numbers (6 in old formats, which add angles), and the rotation's 9 numbers.
bool read_pose(const Block& position, const Block& rotation, DTrackBody& body) {
    if ((position.size() != 3 && position.size() != 6) || rotation.size() != 9)
        return false;
    body.position = kMillimeter * glm::dvec3(position[0], position[1], position[2]);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            body.rotation[column][row] = rotation[3 * column + row];
    return true;
}

/// `[id qu][x y z ..][b0..b8]`: qu is -1 while it is not tracked. In `6di` the first block is
/// `[id st er]`, with st 0 while it is not tracked.
std::optional<DTrackBody> body_from(std::span<const Block> blocks, bool hybrid) {
    const auto id = id_of(blocks[0]);
    DTrackBody body;
    if (!id || blocks[0].size() < 2 || !read_pose(blocks[1], blocks[2], body))
        return std::nullopt;
    body.id = *id;
    body.tracked = hybrid ? blocks[0][1] > 0 : blocks[0][1] >= 0;
    return body;
}

/// Joins words of 32 button bits each; buttons beyond the first 64 are ignored.
std::optional<std::uint64_t> bits_from(std::span<const double> words) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] < 0 || words[i] > 4294967295.0 || words[i] != std::floor(words[i]))
            return std::nullopt;
        if (i < 2)
            bits |= static_cast<std::uint64_t>(words[i]) << 32 * i;
    }
    return bits;
}

/// `[id qu nbt nct][x y z][b0..b8][bt .. ct0 ct1 ..]`: 32 buttons in each word.
std::optional<DTrackFlystick> flystick_from(std::span<const Block> blocks) {
    const auto body = body_from(blocks, false);
    if (!body || blocks[0].size() != 4)
        return std::nullopt;
    const double buttons = blocks[0][2], controllers = blocks[0][3];
    if (buttons < 0 || buttons > 1024 || controllers < 0 || controllers > kMostNumbers)
        return std::nullopt;
    const auto words = static_cast<std::size_t>(std::ceil(buttons / 32));
    if (static_cast<double>(blocks[3].size()) != static_cast<double>(words) + controllers)
        return std::nullopt;
    const auto bits = bits_from(std::span(blocks[3]).first(words));
    if (!bits)
        return std::nullopt;
    DTrackFlystick flystick{*body, *bits, {}};
    for (std::size_t i = words; i < blocks[3].size(); ++i)
        flystick.controllers.push_back(static_cast<float>(blocks[3][i]));
    return flystick;
}

/// `[id qu bt][x y z angles][b0..b8]`.
std::optional<DTrackFlystick> old_flystick_from(std::span<const Block> blocks) {
    const auto body = body_from(blocks, false);
    if (!body || blocks[0].size() != 3)
        return std::nullopt;
    const auto bits = bits_from(std::span(blocks[0]).subspan(2));
    return bits ? std::optional(DTrackFlystick{*body, *bits, {}}) : std::nullopt;
}

std::optional<DTrackMarker> marker_from(std::span<const Block> blocks) {
    const auto id = id_of(blocks[0]);
    if (!id || blocks[1].size() != 3)
        return std::nullopt;
    return DTrackMarker{*id, kMillimeter * glm::dvec3(blocks[1][0], blocks[1][1], blocks[1][2])};
}

/// Reads the things of one line: their number, then `blocks` blocks for each.
template <typename Thing, typename Read>
bool read_things(std::string_view line, std::size_t blocks, std::vector<Thing>& into, Read read) {
    const auto count = take_whole(line, 0, kMostBlocks);
    if (!count)
        return false;
    std::vector<Thing> things;
    std::vector<Block> thing(blocks);
    for (auto left = static_cast<std::size_t>(*count); left > 0; --left) {
        for (Block& block : thing) {
            auto taken = take_block(line);
            if (!taken)
                return false;
            block = std::move(*taken);
        }
        const auto one = read(std::span<const Block>(thing));
        if (!one)
            return false;
        things.push_back(*one);
    }
    skip_blanks(line);
    if (!line.empty())
        return false;
    into.insert(into.end(), things.begin(), things.end());
    return true;
}

bool read_time(std::string_view line, DTrackFrame& frame) {
    const auto seconds = take_number(line);
    if (seconds)
        frame.time = Seconds(*seconds);
    return seconds.has_value();
}

bool read_calibrated(std::string_view line, DTrackFrame& frame) {
    const auto count = take_whole(line, 0, 65535);
    if (count)
        frame.calibrated_bodies = static_cast<int>(*count);
    return count.has_value();
}

/// The line gives the number of Flysticks that are defined, then the number of those in the line.
bool read_flysticks(std::string_view line, DTrackFrame& frame) {
    return take_whole(line, 0, kMostBlocks) && read_things(line, 4, frame.flysticks, flystick_from);
}

/// @return false when the line is malformed
bool read_line(std::string_view word, std::string_view rest, DTrackFrame& frame) {
    const auto body = [](std::span<const Block> blocks) { return body_from(blocks, false); };
    const auto hybrid = [](std::span<const Block> blocks) { return body_from(blocks, true); };
    if (word == "ts")
        return read_time(rest, frame);
    if (word == "6dcal")
        return read_calibrated(rest, frame);
    if (word == "6d")
        return read_things(rest, 3, frame.bodies, body);
    if (word == "6di")
        return read_things(rest, 3, frame.bodies, hybrid);
    if (word == "6df2")
        return read_flysticks(rest, frame);
    if (word == "6df")
        return read_things(rest, 3, frame.flysticks, old_flystick_from);
    if (word == "3d")
        return read_things(rest, 2, frame.markers, marker_from);
    return true;
}

std::string_view take_word(std::string_view& line) {
    skip_blanks(line);
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    while (!text.empty() && (text.front() == '\r' || text.front() == '\n'))
        text.remove_prefix(1);
    return line;
}

} // namespace

std::optional<DTrackFrame> parse_dtrack(std::string_view datagram) {
    // Some senders end the datagram with a zero byte.
    datagram = datagram.substr(0, datagram.find('\0'));
    std::string_view first = take_line(datagram);
    if (take_word(first) != "fr")
        return std::nullopt;
    const auto counter = take_whole(first, 0, 4294967295.0);
    if (!counter)
        return std::nullopt;
    DTrackFrame frame;
    frame.counter = static_cast<std::uint32_t>(*counter);
    while (!datagram.empty()) {
        std::string_view line = take_line(datagram);
        const std::string_view word = take_word(line);
        if (!read_line(word, line, frame))
            ++frame.malformed_lines;
    }
    return frame;
}

} // namespace isochron::interaction
