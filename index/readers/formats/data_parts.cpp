// Joins files, and writes out patterns of their names.
#include "index/readers/formats/data_parts.h"

#include "index/error.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <regex>
#include <utility>

namespace isochron::index {
namespace {

class JoinedData final : public DataStream {
  public:
    JoinedData(std::vector<DataPart> parts, std::uint64_t bytes_each, Compression compression)
        : parts_(std::move(parts)), each_(bytes_each), compression_(compression) {}

    void read(std::uint64_t position, std::span<std::byte> out) override {
        while (!out.empty()) {
            const std::size_t part = position / each_;
            const std::uint64_t within = position % each_;
            const std::size_t count = std::min<std::uint64_t>(out.size(), each_ - within);
            open(part);
            stream_->read(parts_[part].skip + within, out.first(count));
            // The end of compressed data has their checksum.
            if (compression_ != Compression::none && within + count == each_ &&
                part + 1 < parts_.size())
                expect_none(part, stream_->rest(parts_[part].skip + each_));
            out = out.subspan(count);
            position += count;
        }
    }

    Rest rest(std::uint64_t position) override {
        Rest sum;
        const std::size_t last = parts_.size() - 1;
        for (std::size_t part = compression_ == Compression::none ? 0 : last; part <= last;
             ++part) {
            open(part);
            const std::uint64_t begin =
                position > part * each_ ? std::min(position - part * each_, each_) : 0;
            const Rest rest = stream_->rest(parts_[part].skip + begin);
            sum.bytes += rest.bytes - std::min(rest.bytes, part == last ? 0 : each_ - begin);
            sum.foreign += rest.foreign;
        }
        return sum;
    }

  private:
    void open(std::size_t part) {
        if (stream_ && part == open_)
            return;
        stream_ = open_data(parts_[part].path, parts_[part].offset, compression_);
        open_ = part;
    }

    void expect_none(std::size_t part, const Rest& rest) const {
        if (rest.bytes > 0 || rest.foreign > 0)
            throw Error("{}: more values in it than its share, {} bytes",
                        parts_[part].path.string(), each_);
    }

    std::vector<DataPart> parts_;
    std::uint64_t each_;
    Compression compression_;
    std::unique_ptr<DataStream> stream_; ///< stream of one part
    std::size_t open_ = 0;
};

/// Text before and after the number, and how many digits it has at least.
struct NamePattern {
    std::string before, after;
    int digits = 1;
};

std::optional<NamePattern> name_pattern(const std::string& text) {
    static const std::regex kPattern(R"(([^%]*)%(0?)(\d?)[diu]([^%]*))");
    std::smatch part;
    constexpr std::size_t kLongest = 4096;
    if (text.size() > kLongest || !std::regex_match(text, part, kPattern))
        return std::nullopt;
    return NamePattern{part[1], part[4],
                       part[3].length() > 0 ? std::atoi(part[3].str().c_str()) : 1};
}

} // namespace

std::unique_ptr<DataStream> open_parts(std::vector<DataPart> parts, std::uint64_t bytes_each,
                                       Compression compression) {
    return std::make_unique<JoinedData>(std::move(parts), bytes_each, compression);
}

bool is_numbered(const std::string& text) {
    return text.find('%') != text.npos;
}

std::vector<std::string> numbered_names(const std::string& pattern, const std::string& file) {
    const std::vector<std::string> words = words_of(pattern);
    const auto name = words.empty() ? std::nullopt : name_pattern(words.front());
    std::vector<std::int64_t> numbers;
    for (std::size_t i = 1; i < words.size(); ++i)
        numbers.push_back(integers_of(words[i], "a pattern of names", file).front());
    // A fourth number, of NRRD, says how many axes a file has.
    if (!name || numbers.size() < 2 || numbers.size() > 4)
        throw Error("{}: {}, expected a pattern such as slice%03d.raw 1 64 1", file,
                    excerpt(pattern));
    const std::int64_t step = numbers.size() > 2 ? numbers[2] : 1;
    const std::int64_t range = numbers[1] - numbers[0];
    constexpr std::int64_t kMost = 1 << 20;
    if (step == 0 || numbers[0] < 0 || numbers[1] < 0 || numbers[0] > kMost * kMost ||
        numbers[1] > kMost * kMost || range / step < 0 || range / step >= kMost)
        throw Error("{}: files {} to {} by {}, expected 1 to {} of them", file, numbers[0],
                    numbers[1], step, kMost);
    std::vector<std::string> names;
    for (std::int64_t i = 0; i <= range / step; ++i)
        names.push_back(fmt::format("{}{:0{}}{}", name->before, numbers[0] + i * step, name->digits,
                                    name->after));
    return names;
}

} // namespace isochron::index
