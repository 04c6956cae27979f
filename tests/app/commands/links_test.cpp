// Indices by links: what the program finds through a web server is what it finds in the file, whatever the server
// does; or it ends in one line.
#include "app/explore/explored_data.h"
#include "app/explore/story_file.h"
#include "index/error.h"
#include "tests/app/commands/command_line.h"
#include "tests/support/child_process.h"
#include "tests/support/web_server.h"

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using test_support::Asked;
using test_support::WebServer;
using testing::HasSubstr;
using testing::Not;

std::string tag_of(const std::string& bytes) {
    return fmt::format("\"{:x}\"", std::hash<std::string>()(bytes));
}

/// What an honest server answers; `most` ranges at once.
std::string ranges_of_file(const Asked& asked, const std::string& bytes, const std::string& tag,
                           std::size_t most = 1000) {
    const std::string etag = tag.empty() ? "" : fmt::format("ETag: {}\r\n", tag);
    if (const std::string wanted = asked.header("if-match"); !wanted.empty() && wanted != tag)
        return "HTTP/1.1 412 Precondition Failed\r\nContent-Length: 0\r\n\r\n";
    if (asked.ranges.empty() || asked.ranges.size() > most)
        return fmt::format("HTTP/1.1 200 OK\r\n{}Content-Length: {}\r\n\r\n{}", etag, bytes.size(),
                           bytes);
    const auto part = [&](std::size_t i) {
        const auto [first, last] = asked.ranges[i];
        return std::pair(fmt::format("Content-Range: bytes {}-{}/{}\r\n", first,
                                     std::min(last, bytes.size() - 1), bytes.size()),
                         bytes.substr(first, last - first + 1));
    };
    if (bytes.empty())
        return "HTTP/1.1 416 Range Not Satisfiable\r\nContent-Range: bytes */0\r\nContent-Length: "
               "0\r\n\r\n";
    if (asked.ranges.size() == 1)
        return fmt::format("HTTP/1.1 206 Partial Content\r\n{}{}Content-Length: {}\r\n\r\n{}", etag,
                           part(0).first, part(0).second.size(), part(0).second);
    std::string body;
    for (std::size_t i = 0; i < asked.ranges.size(); ++i)
        body += fmt::format("\r\n--XyZ\r\nContent-Type: application/octet-stream\r\n{}\r\n{}",
                            part(i).first, part(i).second);
    body += "\r\n--XyZ--\r\n";
    return fmt::format("HTTP/1.1 206 Partial Content\r\n{}Content-Type: multipart/byteranges; "
                       "boundary=XyZ\r\nContent-Length: "
                       "{}\r\n\r\n{}",
                       etag, body.size(), body);
}

/// A file of some MiB whose surfaces lie in a part of its chunks.
class Links : public CommandLine {
  protected:
    static constexpr std::size_t kEdge = 216; // a step of which chunks are read that are needed
    Links() {
        setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
        static const std::string made = make(); // once, as each test reads it alone
        bytes = made;
        folder.write("a.isochron", bytes);
        local = ids_of("a.isochron");
        EXPECT_GT(local.size(), 4000u);
    }

    /// @return the index, whose file of values is gone
    std::string make() {
        std::string values;
        for (std::size_t z = 0; z < kEdge; ++z)
            for (std::size_t y = 0; y < kEdge; ++y) {
                const double wave = 60 * std::sin(0.07 * double(y)) * std::cos(0.06 * double(z));
                for (std::size_t x = 0; x < kEdge; ++x)
                    values += static_cast<char>(128 + wave * std::sin(0.05 * double(x)) +
                                                static_cast<double>((x * 7 + y * 5 + z * 3) % 11));
            }
        folder.write("big.raw", values);
        const std::string n = std::to_string(kEdge);
        EXPECT_EQ(
            isochron({"build", "big.raw", "--dims", n, n, n, "--type", "u8", "-o", "a.isochron"})
                .status,
            0);
        fs::remove(folder.path() / "big.raw");
        return folder.read("a.isochron");
    }

    std::vector<std::string> query_of(const std::string& index) {
        return {"query",    index, "--isovalue", "185.5",   "--step", "0",
                "--repeat", "0",   "-o",         "ids.bin", "--force"};
    }
    std::string ids_of(const std::string& index, const ChildOptions& how = {}) {
        const ChildResult found = isochron(query_of(index), how);
        EXPECT_EQ(found.status, 0) << index << ": " << found.err;
        EXPECT_THAT(found.out + found.err, Not(HasSubstr("s3cret")));
        return found.status == 0 ? folder.read("ids.bin") : "";
    }

    TestFolder cache;
    std::string bytes, local;
};

TEST_F(Links, FindWhatTheFileHasWhateverAnHonestServerDoes) {
    std::mutex mutex;
    std::set<std::string> seen;
    const WebServer server([&](const Asked& asked) -> std::string {
        const std::string way = asked.path.substr(1, asked.path.find('/', 1) - 1);
        const bool first_time = [&] {
            const std::lock_guard lock(mutex);
            return seen.insert(way + asked.header("range")).second;
        }();
        if (way == "several")
            return ranges_of_file(asked, bytes, tag_of(bytes));
        if (way == "single")
            return ranges_of_file(asked, bytes, tag_of(bytes), 1);
        if (way == "first" || way == "untagged" || way == "weak") {
            Asked one = asked;
            if (way == "first" && one.ranges.size() > 1)
                one.ranges.resize(1);
            return ranges_of_file(one, bytes,
                                  way == "weak"       ? "W/\"1\""
                                  : way == "untagged" ? ""
                                                      : tag_of(bytes));
        }
        if (way == "busy" && first_time)
            return "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\n\r\n";
        if (way == "cut" && first_time) {
            const std::string whole = ranges_of_file(asked, bytes, tag_of(bytes));
            return whole.substr(0, whole.size() - 200) + std::string(WebServer::kCut);
        }
        if (way == "slow")
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (way == "redirect")
            return "HTTP/1.1 302 Found\r\nLocation: /several/a.isochron\r\nContent-Length: "
                   "0\r\n\r\n";
        if (way == "token" && asked.header("authorization") != "Bearer s3cret")
            return "HTTP/1.1 401 Unauthorized\r\nContent-Length: 0\r\n\r\n";
        if (asked.path == "/page/site.json")
            return "HTTP/1.1 200 OK\r\nContent-Length: 26\r\n\r\n{\"files\":[\"a b.isochron\"]}";
        if (way == "page" && asked.path != "/page/a%20b.isochron")
            return "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n";
        return ranges_of_file(asked, bytes, tag_of(bytes));
    });
    for (const std::string way :
         {"several/a.isochron", "single/a.isochron", "first/a.isochron", "untagged/a.isochron",
          "weak/a.isochron", "busy/a.isochron", "cut/a.isochron", "slow/a.isochron",
          "redirect/a.isochron", "token/a.isochron#token=s3cret&isovalue=3",
          "token/#file=a.isochron&token=s3cret", "page/"})
        EXPECT_TRUE(ids_of(server.address() + way) == local) << way;
    EXPECT_EQ(ids_of(server.address() + "token/b.isochron",
                     {.environment = {"ISOCHRON_AUTHORIZATION=127.0.0.1 Bearer s3cret"}}),
              local);
}

TEST_F(Links, EndInOneLineWhereTheServerIsNoneOrLies) {
    std::atomic<int> count = 0;
    const std::string vti =
        "<?xml version=\"1.0\"?><VTKFile type=\"ImageData\">" + std::string(9000, ' ');
    const WebServer server([&](const Asked& asked) -> std::string {
        const std::string way = asked.path.substr(1, asked.path.find('/', 1) - 1);
        const int number = count++;
        std::string honest = ranges_of_file(asked, bytes, tag_of(bytes));
        const auto with = [&](const std::string& from, const std::string& to) {
            const std::size_t at = honest.find(from);
            return at == honest.npos ? honest : honest.replace(at, from.size(), to);
        };
        const std::string total = fmt::format("/{}\r\n", bytes.size());
        if (way == "whole")
            return ranges_of_file(asked, bytes, tag_of(bytes), 0);
        if (way == "missing")
            return "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n";
        if (way == "larger")
            return number > 3 ? with(total, fmt::format("/{}\r\n", bytes.size() + 1)) : honest;
        if (way == "huge")
            return with(total, "/99999999999999999999999\r\n");
        if (way == "shifted")
            return number > 3 ? with("Content-Range: bytes ", "Content-Range: bytes 1") : honest;
        if (way == "long")
            return with("Content-Length: ", "X-Length: ") + std::string(1 << 20, 'x');
        if (way == "changed")
            return number > 3 ? ranges_of_file(asked, std::string(bytes.size(), 'x'), "\"other\"")
                              : honest;
        if (way == "swapped") { // no tag says that it is another file
            std::string other = bytes;
            other[200] ^= 1;
            return ranges_of_file(asked, number > 3 ? other : bytes, "");
        }
        if (way == "elsewhere")
            return "HTTP/1.1 302 Found\r\nLocation: file:///etc/hostname\r\nContent-Length: "
                   "0\r\n\r\n";
        if (way == "circle")
            return "HTTP/1.1 302 Found\r\nLocation: /circle/a.isochron\r\nContent-Length: "
                   "0\r\n\r\n";
        if (way == "silent")
            std::this_thread::sleep_for(std::chrono::seconds(3));
        if (way == "half")
            return ranges_of_file(asked, bytes.substr(0, bytes.size() / 2), "\"half\"");
        if (way == "empty")
            return ranges_of_file(asked, "", "\"none\"");
        if (way == "foreign")
            return ranges_of_file(asked, vti, "\"vti\"");
        if (way == "damaged") {
            std::string other = bytes;
            for (std::size_t at = 80000; at < other.size(); at += 5000)
                other[at] ^= 1;
            return ranges_of_file(asked, other, "\"damaged\"");
        }
        return "nonsense\r\n\r\n";
    });
    for (const auto& [way, said] : std::vector<std::pair<std::string, std::string>>{
             {"whole/a.isochron", "sends the whole file where a range of it is asked for"},
             {"missing/a.isochron", "there is no such file (404)"},
             {"larger/a.isochron", "another one than when it was opened"},
             {"huge/a.isochron", "does not send the bytes that it was asked for"},
             {"shifted/a.isochron", "does not send the bytes that it was asked for"},
             {"long/a.isochron", "sends more than it was asked for"},
             {"changed/a.isochron", "another one than when it was opened"},
             {"swapped/a.isochron", "another one than when it was opened"},
             {"elsewhere/a.isochron", "redirects to an address of another kind"},
             {"circle/a.isochron", "redirects again and again"},
             {"silent/a.isochron", "nothing came for 1 s"},
             {"half/a.isochron", "truncated"},
             {"empty/a.isochron", "it is empty"},
             {"foreign/a.vti", "links lead to indices alone"},
             {"damaged/a.isochron", "damaged"},
             {"missing/", "no page of indices"},
             {"whole/a.isochron#token=a%0d%0ab", "the token behind # is none"}}) {
        count = 0;
        const ChildResult refused = isochron(query_of(server.address() + way),
                                             {.environment = {"ISOCHRON_LINK_PATIENCE=1"}});
        expect_failure(refused, 1, said);
        EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
    }
    expect_failure(isochron(query_of("http://127.0.0.1:9/a.isochron")), 1,
                   "http://127.0.0.1:9/a.isochron: ");
    expect_failure(isochron(query_of("http://me:s3cret@127.0.0.1:9/a.isochron")), 1,
                   "user's name or password");
    expect_failure(isochron({"build", server.address() + "foreign/a.vti", "-o", "b.isochron"}), 1,
                   "download it");
}

TEST_F(Links, AreAskedForLittleAndOnlyOnce) {
    std::atomic<std::size_t> sent = 0, requests = 0;
    const WebServer server([&](const Asked& asked) {
        const std::string answer = ranges_of_file(asked, bytes, tag_of(bytes));
        sent += answer.size();
        ++requests;
        return answer;
    });
    const std::string link = server.address() + "a.isochron";
    EXPECT_TRUE(ids_of(link) == local);
    EXPECT_LT(sent, bytes.size() * 3 / 4);
    EXPECT_LT(requests, 60u);
    sent = 0;
    EXPECT_TRUE(ids_of(link) == local);
    EXPECT_LT(sent, 300u << 10) << "the beginning, and nothing else";
    // What is damaged on this disk is fetched anew.
    for (const auto& entry : fs::recursive_directory_iterator(cache.path()))
        if (entry.path().filename() == "blocks") {
            std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
            for (std::size_t at = 5; at < fs::file_size(entry.path()); at += 1000) {
                file.seekp(static_cast<std::streamoff>(at));
                file.put('x');
            }
        }
    EXPECT_TRUE(ids_of(link) == local);
    EXPECT_GT(sent, 500u << 10);
    const auto kept = [&] {
        std::uintmax_t all = 0;
        for (const auto& entry : fs::recursive_directory_iterator(cache.path()))
            if (entry.is_regular_file() && entry.path().filename() == "blocks") {
                struct stat found {};
                EXPECT_EQ(stat(entry.path().c_str(), &found), 0);
                all += static_cast<std::uintmax_t>(found.st_blocks) * 512;
            }
        return all;
    };
    EXPECT_GT(kept(), 1u << 20);
    EXPECT_EQ(ids_of(server.address() + "b.isochron", {.environment = {"ISOCHRON_LINK_CACHE=1"}}),
              local);
    EXPECT_LE(kept(), 1u << 20) << "the budget holds for all files";
    EXPECT_EQ(
        ids_of(server.address() + "c.isochron", {.environment = {"XDG_CACHE_HOME=/proc/nowhere"}}),
        local);
}

TEST_F(Links, EndSoonAfterCtrlC) {
    std::atomic<int> count = 0;
    const WebServer server([&](const Asked& asked) {
        if (count++ > 3)
            std::this_thread::sleep_for(std::chrono::seconds(5));
        return ranges_of_file(asked, bytes, tag_of(bytes));
    });
    std::vector<std::string> query = query_of(server.address() + "a.isochron");
    query.push_back("--verbose");
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_NE(isochron(query, {.interrupt_after = "opened"}).status, 0);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(4));
}

TEST(LinkedStory, IsToldFromTheKeyOfTheLinkAndRefusedBeforeAWindowOpens) {
    const std::string story = R"({"format": "isochron keys", "version": 1, "keys": [)"
                              R"({"time": 0, "text": "One."}, {"time": 2, "text": "Two."}]})";
    const WebServer server([&](const Asked& asked) {
        return asked.path == "/a%20tour.isochron-story"
                   ? ranges_of_file(asked, story, tag_of(story))
                   : "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n";
    });
    const auto asked_by = [&](const std::string& words) {
        ExploreOptions options;
        options.sources.files = {server.address() + "a.isochron#" + words};
        return with_index(options);
    };
    const ExploreOptions told = asked_by("isovalue=3&story=a%20tour.isochron-story&told=2");
    EXPECT_EQ(told.story, server.address() + "a%20tour.isochron-story");
    EXPECT_EQ(told.told, 2u);
    EXPECT_EQ(read_story(*told.story).keys.size(), 2u);
    for (const char* const words :
         {"isovalue=3&story=a%20tour.isochron-story&told=0", "story=a%20tour.isochron-story",
          "told=1", "told=-1&story=a%20tour.isochron-story", "told=1&story=..%2Fa%20tour"})
        EXPECT_FALSE(asked_by(words).story) << words;
    try {
        asked_by("story=gone.isochron-story&told=1");
        FAIL();
    } catch (const index::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("gone.isochron-story"));
    }
}

TEST_F(Links, AllCommandsThatReadAnIndexTakeThem) {
    const WebServer server(
        [&](const Asked& asked) { return ranges_of_file(asked, bytes, tag_of(bytes)); });
    const std::string link = server.address() + "a.isochron";
    const auto same = [&](std::vector<std::string> words) {
        std::replace(words.begin(), words.end(), std::string("@"), std::string("a.isochron"));
        const ChildResult file = isochron(words);
        std::replace(words.begin(), words.end(), std::string("a.isochron"), link);
        ChildResult through = isochron(words);
        EXPECT_EQ(file.status, 0) << file.err;
        EXPECT_EQ(through.status, 0) << through.err;
        for (std::size_t at; (at = through.out.find(link)) != through.out.npos;)
            through.out.replace(at, link.size(), "a.isochron");
        return file.out == through.out ? std::string("same") : file.out + "\n---\n" + through.out;
    };
    EXPECT_EQ(same({"info", "@"}), "same");
    EXPECT_EQ(same({"measure", "@", "--isovalue", "185.5"}), "same");
    ASSERT_EQ(isochron({"export", "a.isochron", "--isovalue", "185.5", "--out", "a.stl"}).status,
              0);
    ASSERT_EQ(isochron({"export", link, "--isovalue", "185.5", "--out", "b.stl"}).status, 0);
    EXPECT_EQ(folder.read("a.stl"), folder.read("b.stl"));
    EXPECT_EQ(isochron({"verify", link}).status, 0);
}

} // namespace
} // namespace isochron::app
