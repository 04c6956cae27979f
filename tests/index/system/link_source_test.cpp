// Answers of web servers, made by chance: the bytes that were asked for, or one line.
#include "index/system/links/link_source.h"

#include "index/error.h"
#include "index/system/links/range_answer.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <random>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace isochron::index {
namespace {

TEST(ContentRange, IsOneThatLiesWithinItsTotal) {
    EXPECT_EQ(content_range("bytes 0-7/8")->range, (LinkRange{0, 8}));
    EXPECT_EQ(content_range(" Bytes 5-5/8 ")->total, 8u);
    for (const char* none : {"", "bytes", "bytes */8", "bytes 0-7/*", "bytes 0-8/8", "bytes 7-0/8",
                             "bytes -1-7/8", "bytes 0-7", "bytes 0-7/99999999999999999999",
                             "items 0-7/8", "bytes 0x0-7/8", "bytes 18446744073709551615-0/8"})
        EXPECT_FALSE(content_range(none)) << none;
}

TEST(MultipartAnswer, EveryMutationGivesPartsWithinTheBody) {
    std::mt19937 random(test_seed());
    const auto any = [&](std::size_t below) {
        return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
    };
    for (int i = 0; i < 20000; ++i) {
        std::string body;
        for (std::size_t part = 0; part < 1 + any(4); ++part)
            body += fmt::format("\r\n--b\r\nContent-Range: bytes {}-{}/100\r\n\r\n{}", part * 10,
                                part * 10 + 4, std::string(5, 'x'));
        body += "\r\n--b--\r\n";
        for (std::size_t change = any(6); change > 0; --change)
            switch (any(3)) {
            case 0: body[any(body.size())] = static_cast<char>(any(256)); break;
            case 1: body.resize(1 + any(body.size())); break;
            default: body.insert(any(body.size()), body.substr(any(body.size()), any(40)));
            }
        for (const AnswerPart& part : parts_of(body, "b")) {
            ASSERT_EQ(part.bytes.size(), part.where.range.bytes());
            ASSERT_GE(part.bytes.data(), body.data());
            ASSERT_LE(part.bytes.data() + part.bytes.size(), body.data() + body.size());
        }
        boundary_of(body);
        strong_tag(body);
    }
}

/// Answers honestly but for what chance changes in heads, states and lengths.
class ByChance final : public HttpTransport {
  public:
    ByChance(std::string file, std::uint32_t seed, double faults)
        : file_(std::move(file)), random_(seed), faults_(faults) {}

    void send(HttpRequest request, std::function<void(HttpAnswer)> done) override {
        HttpAnswer answer = answer_of(request);
        std::thread([answer = std::move(answer), done = std::move(done)] {
            done(answer);
        }).detach();
    }

  private:
    HttpAnswer answer_of(const HttpRequest& request) {
        const std::lock_guard lock(mutex_);
        HttpAnswer answer{.status = 206, .fields = {{"etag", "\"t\""}}, .body = {}, .failure = {}};
        std::vector<LinkRange> ranges;
        for (const std::string& header : request.headers)
            if (header.starts_with("Range: bytes="))
                for (std::size_t at = header.find('='); at != header.npos;
                     at = header.find(',', at + 1)) {
                    char* end = nullptr;
                    const std::uint64_t first = std::strtoull(header.c_str() + at + 1, &end, 10);
                    ranges.push_back(
                        {first, std::min<std::uint64_t>(std::strtoull(end + 1, nullptr, 10) + 1,
                                                        file_.size())});
                }
        const auto head = [&](const LinkRange& range) {
            return fmt::format("bytes {}-{}/{}", range.begin + wrong(1), range.end - 1 + wrong(1),
                               file_.size() + wrong(1));
        };
        if (ranges.size() == 1) {
            answer.fields.emplace_back("content-range", head(ranges[0]));
            answer.body = file_.substr(ranges[0].begin, ranges[0].bytes());
        } else {
            answer.fields.emplace_back("content-type", "multipart/byteranges; boundary=b");
            for (const LinkRange& range : ranges)
                if (wrong(1) == 0)
                    answer.body +=
                        fmt::format("\r\n--b\r\nContent-Range: {}\r\n\r\n{}", head(range),
                                    file_.substr(range.begin, range.bytes()));
            answer.body += "\r\n--b--\r\n";
        }
        if (wrong(1))
            answer.body.resize(answer.body.size() / 2);
        if (wrong(1))
            answer.status = std::array{0, 200, 204, 304, 404, 412, 416, 500}[random_() % 8];
        if (wrong(1))
            answer.fields[0].second = "\"u\"";
        if (wrong(1))
            answer.failure = "chance";
        return answer;
    }
    /// Rarely `by`, else 0.
    std::uint64_t wrong(std::uint64_t by) {
        return std::uniform_real_distribution<double>(0, 1)(random_) < faults_ ? by : 0;
    }

    const std::string file_;
    std::mutex mutex_;
    std::mt19937 random_;
    const double faults_;
};

TEST(LinkSource, GivesTheBytesOfTheFileOrOneLine) {
    std::mt19937 random(test_seed());
    std::string file(3'000'001, '\0');
    for (char& c : file)
        c = static_cast<char>(random());
    int right = 0, refused = 0;
    for (int i = 0; i < 300; ++i) {
        const double faults = i % 3 == 0 ? 0 : 0.02;
        const auto transport = std::make_shared<ByChance>(file, random(), faults);
        try {
            const auto source = open_link("http://h/a.isochron", transport, false);
            if (source->size() != file.size()) { // what an index says itself
                ASSERT_GT(faults, 0);
                continue;
            }
            for (int n = 0; n < 10; ++n) {
                const std::uint64_t offset = random() % file.size();
                std::vector<std::byte> out(
                    std::min<std::size_t>(random() % 300'000, file.size() - offset));
                for (int ahead = 0; ahead < 20; ++ahead)
                    source->expect(random() % file.size(), random() % 20'000);
                source->read(offset, out);
                ASSERT_EQ(std::memcmp(out.data(), file.data() + offset, out.size()), 0);
                ++right;
            }
            std::byte beyond[4];
            EXPECT_THROW(source->read(file.size() - 2, beyond), Error);
        } catch (const Error& error) {
            ASSERT_GT(faults, 0) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            ++refused;
        }
    }
    EXPECT_GT(right, 1000);
    EXPECT_GT(refused, 20);
}

TEST(LinkSource, SaysInAForkedProcessThatItMustBeOpenedAgain) {
    const auto transport = std::make_shared<ByChance>(std::string(1'000'000, 'x'), 1, 0);
    const auto source = open_link("http://h/a.isochron", transport, false);
    const pid_t child = ::fork();
    if (child == 0) {
        int status = 1;
        try {
            std::byte one[1];
            source->expect(500'000, 1);
            source->read(500'000, one);
        } catch (const Error& error) {
            status = std::string(error.what()).find("forked: open it again") == std::string::npos;
        }
        ::_exit(status);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    std::byte one[1];
    source->read(500'000, one); // the process that has opened it goes on
    EXPECT_EQ(one[0], std::byte{'x'});
}

} // namespace
} // namespace isochron::index
