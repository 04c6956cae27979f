// What a site answers: its page, ranges of its files, and nothing else.
#include "app/serve/site.h"

#include "index/error.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

namespace isochron::app {
namespace {

using testing::HasSubstr;
using Ranges = std::vector<ByteRange>;

TEST(RangeRequest, IsReadAsTheStandardSays) {
    const std::vector<std::pair<std::string, std::optional<Ranges>>> cases{
        {"bytes=0-99", Ranges{{0, 100}}},
        {"bytes=900-", Ranges{{900, 1000}}},
        {"bytes=-10", Ranges{{990, 1000}}},
        {"bytes=-5000", Ranges{{0, 1000}}},
        {"bytes=990-5000", Ranges{{990, 1000}}},
        {" bytes=0-0, 5-6 ,-1", Ranges{{0, 1}, {5, 7}, {999, 1000}}},
        {"bytes=1000-", Ranges{}},
        {"bytes=1000-1001,0-0", Ranges{{0, 1}}},
        {"bytes=-0", Ranges{}},
        {"", std::nullopt},
        {"lines=0-1", std::nullopt},
        {"bytes=", std::nullopt},
        {"bytes=-", std::nullopt},
        {"bytes=5-4", std::nullopt},
        {"bytes=a-b", std::nullopt},
        {"bytes=0-1,", std::nullopt},
        {"bytes=0x1-5", std::nullopt},
        {"bytes=18446744073709551616-", std::nullopt},
        {"bytes=18446744073709551615-18446744073709551615", Ranges{}},
    };
    for (const auto& [header, wanted] : cases)
        EXPECT_EQ(ranges_of(header, 1000), wanted) << header;
    std::string many = "bytes=0-0";
    for (std::size_t i = 1; i < kMostRanges; ++i)
        many += ",0-0";
    EXPECT_EQ(ranges_of(many, 10)->size(), kMostRanges);
    EXPECT_EQ(ranges_of(many + ",0-0", 10), std::nullopt);
    EXPECT_EQ(ranges_of("bytes=0-0", 0), Ranges{});
}

TEST(RangeRequest, NeverReachesBeyondTheFile) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 2000; ++round) {
        std::string header = "bytes=";
        for (unsigned i = 0; i < 12; ++i)
            header += "0123456789-,- "[random() % 14];
        const std::uint64_t bytes = random() % 200;
        const auto ranges = ranges_of(header, bytes);
        for (const ByteRange& range : ranges.value_or(Ranges{})) {
            EXPECT_LT(range.begin, range.end) << header;
            EXPECT_LE(range.end, bytes) << header;
        }
    }
}

class SiteTest : public testing::Test {
  protected:
    SiteTest() { folder_.write("run 42.isochron", "0123456789"); }
    Site site(std::string token = {}, std::vector<std::string> hosts = {}) {
        return Site({{folder_.path() / "run 42.isochron"}, std::move(token), std::move(hosts)});
    }
    static SiteAnswer get(const Site& site, std::string_view path,
                          std::map<std::string, std::string, std::less<>> headers = {},
                          std::string_view method = "GET") {
        return site.answer({method, path, [&](std::string_view name) -> std::string_view {
                                const auto found = headers.find(name);
                                return found == headers.end() ? std::string_view() : found->second;
                            }});
    }
    static std::string header(const SiteAnswer& answer, std::string_view name) {
        for (const auto& [key, value] : answer.headers)
            if (key == name)
                return value;
        return {};
    }
    /// The body, as a server sends it.
    std::string body(const SiteAnswer& answer) {
        std::string text = answer.text;
        text.append(reinterpret_cast<const char*>(answer.bytes.data()), answer.bytes.size());
        const std::string file = folder_.read("run 42.isochron");
        for (const auto& [words, range] : answer.pieces)
            text += words + file.substr(range.begin, range.end - range.begin);
        EXPECT_EQ(text.size(), answer.length);
        return text;
    }

    test_support::TestFolder folder_;
};

constexpr const char* kFile = "/run%2042.isochron";

TEST_F(SiteTest, HasItsPageAndItsList) {
    const Site one = site();
    EXPECT_THAT(body(get(one, "/")), HasSubstr("<title>Isochron</title>"));
    EXPECT_EQ(header(get(one, "/assets/isochron.wasm"), "Content-Type"), "application/wasm");
    EXPECT_THAT(body(get(one, "/site.json")), HasSubstr("\"run 42.isochron\""));
    EXPECT_THAT(body(get(one, "/site.json")), testing::Not(HasSubstr(folder_.path().string())));
}

TEST_F(SiteTest, SendsRanges) {
    const Site one = site();
    EXPECT_EQ(body(get(one, kFile)), "0123456789");
    const SiteAnswer part = get(one, kFile, {{"range", "bytes=2-4"}});
    EXPECT_EQ(part.status, 206u);
    EXPECT_EQ(body(part), "234");
    EXPECT_EQ(header(part, "Content-Range"), "bytes 2-4/10");
    const SiteAnswer beyond = get(one, kFile, {{"range", "bytes=10-"}});
    EXPECT_EQ(beyond.status, 416u);
    EXPECT_EQ(header(beyond, "Content-Range"), "bytes */10");
    const SiteAnswer two = get(one, kFile, {{"range", "bytes=0-1,8-"}});
    EXPECT_EQ(two.status, 206u);
    const std::string type = header(two, "Content-Type"), start = "multipart/byteranges; boundary=";
    ASSERT_TRUE(type.starts_with(start));
    const std::string line = "\r\n--" + type.substr(start.size());
    const std::string kind = "\r\nContent-Type: application/octet-stream\r\nContent-Range: bytes ";
    EXPECT_EQ(body(two), line + kind + "0-1/10\r\n\r\n01" + line + kind + "8-9/10\r\n\r\n89" +
                             line + "--\r\n");
}

TEST_F(SiteTest, NeverMixesTwoContents) {
    const Site one = site();
    const std::string tag = header(get(one, kFile), "ETag");
    EXPECT_EQ(get(one, kFile, {{"range", "bytes=0-1"}, {"if-range", tag}}).status, 206u);
    EXPECT_EQ(get(one, kFile, {{"if-match", tag}}).status, 200u);
    folder_.write("run 42.isochron", "abcdefghijk");
    EXPECT_NE(header(get(one, kFile), "ETag"), tag);
    EXPECT_EQ(get(one, kFile, {{"range", "bytes=0-1"}, {"if-range", tag}}).status, 200u);
    EXPECT_EQ(get(one, kFile, {{"range", "bytes=0-1"}, {"if-match", tag}}).status, 412u);
    std::filesystem::remove(folder_.path() / "run 42.isochron");
    EXPECT_EQ(get(one, kFile).status, 404u);
}

TEST_F(SiteTest, SendsNothingElse) {
    folder_.write("secret", "x");
    const Site one = site("word", {"127.0.0.1:80"});
    const std::map<std::string, std::string, std::less<>> known{{"host", "127.0.0.1:80"},
                                                                {"authorization", "Bearer word"}};
    EXPECT_EQ(get(one, kFile, known).status, 200u);
    for (const std::string path :
         {"/secret", "/../secret", "/%2e%2e/secret", "/assets/../../secret", "//etc/passwd", "/%00",
          "/run%2042.isochron/", "/site.json/x"})
        EXPECT_EQ(get(one, path, known).status, 404u) << path;
    for (const std::string path : {"", "run", "/%", "/%zz", "/%2"})
        EXPECT_EQ(get(one, path, known).status, 400u) << path;
    for (const std::string word : {"", "Bearer", "Bearer wor", "Bearer words", "word"})
        for (const std::string& path : {std::string(kFile), std::string("/site.json")})
            EXPECT_EQ(get(one, path, {{"host", "127.0.0.1:80"}, {"authorization", word}}).status,
                      401u);
    EXPECT_EQ(get(one, "/", {{"host", "127.0.0.1:80"}}).status, 200u) << "the page is no secret";
    for (const std::string host : {"", "evil.example:80", "127.0.0.1:81", "127.0.0.1"})
        EXPECT_EQ(get(one, kFile, {{"host", host}, {"authorization", "Bearer word"}}).status, 403u);
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "get"})
        EXPECT_EQ(get(one, kFile, known, method).status, 405u) << method;
}

TEST_F(SiteTest, HasAStoryBesideItsFilesAsItIs) {
    folder_.write("tour.isochron-story", "{}");
    SiteParts parts{.files = {folder_.path() / "run 42.isochron"},
                    .token = "word",
                    .story = folder_.path() / "tour.isochron-story"};
    parts.written = [](const auto&) { return ServedFile{5, "\"x\""}; }; // the index, as it grows
    const Site one{std::move(parts)};
    const std::map<std::string, std::string, std::less<>> known{{"authorization", "Bearer word"}};
    const SiteAnswer story = get(one, "/tour.isochron-story", known);
    EXPECT_EQ(story.status, 200u);
    EXPECT_EQ(story.length, 2u);
    EXPECT_EQ(get(one, kFile, known).length, 5u);
    EXPECT_EQ(get(one, "/tour.isochron-story").status, 401u);
    EXPECT_THAT(body(get(one, "/site.json", known)),
                HasSubstr("\"story\": \"tour.isochron-story\""));
}

TEST_F(SiteTest, RefusesFilesThatItCannotTellApart) {
    std::filesystem::create_directory(folder_.path() / "other");
    folder_.write("other/run 42.isochron", "x");
    EXPECT_THROW(
        Site({{folder_.path() / "run 42.isochron", folder_.path() / "other/run 42.isochron"},
              {},
              {}}),
        index::Error);
    EXPECT_THROW(Site({{folder_.path() / "gone.isochron"}, {}, {}}), index::Error);
}

} // namespace
} // namespace isochron::app
