// The session that `explore` keeps, and the one that it goes on with.
#include "app/commands/kept_session.h"

#include "app/version.h"
#include "interaction/error.h"

#include <fmt/format.h>

#include <charconv>

namespace isochron::app {

std::string data_hash_of(const index::IndexFile& file) {
    return fmt::format("{:016x}", file.content_hash());
}

std::string held_hash(const index::IndexFile& file, const std::string& hash) {
    std::uint64_t number = 0;
    const char* const end = hash.data() + hash.size();
    const auto read = std::from_chars(hash.data(), end, number, 16);
    return read.ptr == end && read.ec == std::errc() && file.has_had(number) ? hash
                                                                             : data_hash_of(file);
}

std::optional<SavedSession> earlier_session(const std::optional<std::filesystem::path>& path,
                                            bool resume) {
    const bool there = path && std::filesystem::exists(*path);
    if (resume && !there)
        throw interaction::Error(fmt::format("--resume: no session on these data is kept{}",
                                             path ? " in " + path->string() : ""));
    if (resume)
        return read_session(*path);
    if (there)
        fmt::print(stderr, "isochron: --resume goes on with the session in {}\n", path->string());
    return std::nullopt;
}

void keep_session(LiveLoop& live, const std::optional<std::filesystem::path>& path,
                  const std::string& data, const index::IndexFile& file, const Session& session,
                  const std::optional<SavedSession>& earlier) {
    if (earlier)
        live.stand(earlier->head);
    if (path)
        live.keep_session(*path,
                          {std::string(kProgram), std::filesystem::absolute(data).string(),
                           data_hash_of(file), session.state().as_commands(), live.standing()},
                          earlier.has_value());
}

} // namespace isochron::app
