// `isochron serve`: what it prints opens its files, and what it writes is a site.
#include "tests/app/commands/command_line.h"
#include "tests/support/child_process.h"

#include <arpa/inet.h>
#include <csignal>
#include <fstream>
#include <netinet/in.h>
#include <regex>
#include <sys/socket.h>
#include <unistd.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// The answer of a server on this machine to a request, whole.
std::string asked(int port, const std::string& request) {
    const int to = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_port = htons(static_cast<std::uint16_t>(port));
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string answer;
    if (connect(to, reinterpret_cast<sockaddr*>(&where), sizeof where) == 0 &&
        write(to, request.data(), request.size()) == static_cast<ssize_t>(request.size())) {
        char block[4096];
        for (ssize_t count; (count = read(to, block, sizeof block)) > 0;)
            answer.append(block, static_cast<std::size_t>(count));
    }
    close(to);
    return answer;
}

class ServeCommand : public CommandLine {
  protected:
    ServeCommand() { EXPECT_EQ(isochron(build_of("t*.raw")).status, 0); }
};

/// A server that runs until it is ended.
class Serving {
  public:
    /// @param option empty: none
    explicit Serving(const fs::path& file, const char* option = nullptr) {
        int said[2];
        EXPECT_EQ(pipe(said), 0);
        process_ = fork();
        if (process_ == 0) {
            dup2(said[1], STDOUT_FILENO);
            close(said[0]);
            const std::string program = test_support::binary_root() + "/isochron";
            execl(program.c_str(), program.c_str(), "serve", file.c_str(), option, nullptr);
            _exit(127);
        }
        close(said[1]);
        for (char c; read(said[0], &c, 1) == 1 && c != '\n';)
            link += c;
        close(said[0]);
        std::smatch parts;
        EXPECT_TRUE(std::regex_match(
            link, parts, std::regex(R"(http://127\.0\.0\.1:(\d+)/#token=([0-9a-f]{32}))")))
            << link;
        port = std::atoi(parts[1].str().c_str());
        token = fmt::format("Authorization: Bearer {}\r\n", parts[2].str());
    }
    ~Serving() { end(); }
    /// @return whether it ended by itself when it was asked to
    bool end() {
        if (process_ <= 0)
            return true;
        kill(process_, SIGTERM);
        int status = 0;
        const pid_t ended = waitpid(std::exchange(process_, 0), &status, 0);
        return ended > 0 && WIFEXITED(status);
    }
    std::string get(const std::string& path, const std::string& more) const {
        return asked(port, fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: "
                                       "close\r\n{}\r\n",
                                       path, port, more));
    }

    std::string link, token;
    int port = 0;

  private:
    pid_t process_ = -1;
};

TEST_F(ServeCommand, SendsRangesToWhoeverHasTheLinkUntilItIsEnded) {
    Serving server(folder.path() / "a.isochron");
    const int port = server.port;
    const std::string& token = server.token;
    const auto get = [&](const std::string& path, const std::string& more) {
        return server.get(path, more);
    };
    const std::string file = folder.read("a.isochron");
    const std::string part = get("/a.isochron", token + "Range: bytes=0-7\r\n");
    EXPECT_THAT(part, StartsWith("HTTP/1.1 206"));
    EXPECT_TRUE(part.ends_with("\r\n\r\nISOCHRON")) << part;
    const std::string whole = get("/a.isochron", token);
    EXPECT_TRUE(whole.ends_with(file));
    const std::string two = get("/a.isochron", token + "Range: bytes=0-2,4-7\r\n");
    EXPECT_THAT(two, HasSubstr("\r\n\r\nISO\r\n--"));
    EXPECT_THAT(two, HasSubstr("\r\n\r\nHRON\r\n--"));
    EXPECT_THAT(get("/a.isochron", ""), StartsWith("HTTP/1.1 401"));
    EXPECT_THAT(get("/t0.raw", token), StartsWith("HTTP/1.1 404"));
    EXPECT_THAT(get("/", ""), HasSubstr("<title>Isochron</title>"));
    EXPECT_THAT(asked(port, "GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
                StartsWith("HTTP/1.1 403"));
    // A head that does not end, and one that is too long, end the connection and not the server.
    EXPECT_THAT(asked(port, "GET /" + std::string(100000, 'a') + " HTTP/1.1\r\n\r\n"),
                testing::Not(StartsWith("HTTP/1.1 2")));
    EXPECT_THAT(get("/site.json", token), HasSubstr("a.isochron"));
    EXPECT_TRUE(server.end());
}

TEST_F(ServeCommand, ItsLinkOpensTheIndexInTheProgram) {
    const Serving server(folder.path() / "a.isochron");
    setenv("XDG_CACHE_HOME", (folder.path() / "cache").c_str(), 1);
    const ChildResult found =
        isochron({"query", server.link, "--isovalue", "0.5", "--step", "1", "-o", "ids.bin"});
    ASSERT_EQ(found.status, 0) << found.err;
    const std::string ids = folder.read("ids.bin");
    std::vector<std::uint32_t> numbers(ids.size() / 4);
    std::memcpy(numbers.data(), ids.data(), ids.size());
    EXPECT_EQ(numbers, active(1, 0.5));
    EXPECT_THAT(found.out + found.err, testing::Not(HasSubstr(server.token.substr(22, 32))));
    expect_failure(isochron({"query", server.link.substr(0, server.link.find('#')), "--isovalue",
                             "0", "--step", "0"}),
                   1, "401");
}

TEST_F(ServeCommand, FollowsAnIndexThatGrowsStateByState) {
    setenv("XDG_CACHE_HOME", (folder.path() / "cache").c_str(), 1);
    ASSERT_EQ(isochron({"build", "t0.raw", "t1.raw", "--dims", "14", "11", "9", "--type", "f32",
                        "-o", "g.isochron"})
                  .status,
              0);
    const Serving server(folder.path() / "g.isochron", "--follow");
    const auto tag = [&] {
        const std::string head = server.get("/g.isochron", server.token + "Range: bytes=0-7\r\n");
        const std::size_t at = head.find("ETag: "), total = head.find("Content-Range: ");
        EXPECT_NE(at, head.npos) << head;
        return head.substr(at, head.find('\r', at) - at) +
               head.substr(total, head.find('\r', total) - total);
    };
    const std::string first = tag();
    {
        std::ofstream more(folder.path() / "g.isochron", std::ios::binary | std::ios::app);
        more << "what an append has written so far";
    }
    EXPECT_EQ(tag(), first) << "as long as no header names it";
    EXPECT_THAT(server.get("/site.json", server.token), HasSubstr("\"follow\": true"));
    const auto at_step = [&](const char* step) {
        return isochron({"query", server.link, "--isovalue", "0.5", "--step", step, "-o", "ids.bin",
                         "--force"});
    };
    expect_failure(at_step("2"), 1, "expected 0 to 1");
    ASSERT_EQ(isochron({"build", "t0.raw", "t1.raw", "t2.raw", "--dims", "14", "11", "9", "--type",
                        "f32", "-o", "g.isochron", "--append"})
                  .status,
              0);
    EXPECT_NE(tag(), first);
    ASSERT_EQ(at_step("2").status, 0);
    EXPECT_EQ(folder.read("ids.bin").size(), 4 * active(2, 0.5).size());
}

TEST_F(ServeCommand, WritesASiteIntoAFolderOfItsOwn) {
    const ChildResult wrote = isochron({"serve", "a.isochron", "--write-site", "site"});
    ASSERT_EQ(wrote.status, 0) << wrote.err;
    EXPECT_EQ(folder.read("site/a.isochron"), folder.read("a.isochron"));
    EXPECT_THAT(folder.read("site/index.html"), HasSubstr("<title>Isochron</title>"));
    EXPECT_THAT(folder.read("site/site.json"), HasSubstr("a.isochron"));
    EXPECT_EQ(isochron({"serve", "a.isochron", "--write-site", "site"}).status, 0) << "its own";
    fs::create_directory(folder.path() / "foreign");
    folder.write("foreign/letter", "x");
    const ChildResult refused = isochron({"serve", "a.isochron", "--write-site", "foreign"});
    EXPECT_NE(refused.status, 0);
    EXPECT_THAT(refused.err, HasSubstr("nothing is written"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "foreign"), {}), 1);
}

TEST_F(ServeCommand, PutsAStoryBesideTheIndexAndRefusesWhatThePageWould) {
    folder.write("a b.isochron-story", R"({"format": "isochron keys", "version": 1, "keys": )"
                                       R"([{"time": 0, "text": "a", "step": 1}]})");
    const ChildResult wrote =
        isochron({"serve", "a.isochron", "--story", "a b.isochron-story", "--write-site", "site"});
    ASSERT_EQ(wrote.status, 0) << wrote.err;
    EXPECT_EQ(folder.read("site/a b.isochron-story"), folder.read("a b.isochron-story"));
    EXPECT_THAT(folder.read("site/site.json"), HasSubstr("\"story\": \"a b.isochron-story\""));
    folder.write("session.isochron-story", R"({"format": "isochron session", "version": 1})");
    folder.write("silent.isochron-story",
                 R"({"format": "isochron keys", "version": 1, "keys": [{"time": 0}]})");
    folder.write("site.json", "{}");
    for (const auto& [name, said] : std::vector<std::pair<std::string, std::string>>{
             {"session.isochron-story", "a session, which names folders of this machine"},
             {"silent.isochron-story", "no story: expected a key with a \"text\""},
             {"gone.isochron-story", "gone.isochron-story"},
             {"site.json", "expected a file NAME.isochron-story"}})
        expect_failure(isochron({"serve", "a.isochron", "--story", name, "--write-site", "no"}),
                       name == "site.json" ? 2 : 1, said);
    EXPECT_FALSE(fs::exists(folder.path() / "no"));
}

TEST_F(ServeCommand, RefusesWhatItCannotServe) {
    for (const auto& [arguments, said] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"serve", "t0.raw"}, "t0.raw"},
             {{"serve", "gone.isochron"}, "gone.isochron"},
             {{"serve", "a.isochron", "--address", "not.an.address"}, "--address"},
             {{"serve", "a.isochron", "--port", "70000"}, "--port"},
             {{"serve", "a.isochron", "--certificate", "t0.raw"}, "--key"},
             {{"serve", "a.isochron", "--certificate", "t0.raw", "--key", "t0.raw"}, "PEM"}}) {
        const ChildResult refused = isochron(arguments);
        EXPECT_NE(refused.status, 0);
        EXPECT_THAT(refused.err, HasSubstr(said));
    }
}

} // namespace
} // namespace isochron::app
