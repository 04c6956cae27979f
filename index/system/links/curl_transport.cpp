// Asks web servers by libcurl, on a thread of its own.
#include "index/error.h"
#include "index/lower_case.h"
#include "index/system/links/http_transport.h"

#include <curl/curl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <list>
#include <mutex>
#include <string_view>
#include <thread>

#include <unistd.h>

namespace isochron::index {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostHead = 64 << 10; ///< [byte] of one answer
constexpr long kConnections = 8;            ///< to a server

/// One request that is under way.
struct Asked {
    HttpRequest request;
    std::function<void(HttpAnswer)> done;
    Clock::time_point begins;
    HttpAnswer answer;
    std::size_t head = 0;
    CURL* handle = nullptr;
    curl_slist* headers = nullptr;

    ~Asked() {
        curl_easy_cleanup(handle);
        curl_slist_free_all(headers);
    }
};

std::size_t take_head(char* text, std::size_t, std::size_t bytes, void* to) {
    Asked& asked = *static_cast<Asked*>(to);
    std::string_view line(text, bytes);
    if ((asked.head += bytes) > kMostHead)
        return 0;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())))
        line.remove_suffix(1);
    if (line.starts_with("HTTP/")) { // also after a redirect
        asked.answer.fields.clear();
        return bytes;
    }
    const std::size_t colon = line.find(':');
    if (colon == line.npos)
        return bytes;
    const std::string name = lower_case(line.substr(0, colon));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(" \t", colon + 1)));
    asked.answer.fields.emplace_back(name, line);
    return bytes;
}

std::size_t take_body(char* bytes, std::size_t, std::size_t count, void* to) {
    Asked& asked = *static_cast<Asked*>(to);
    long status = 0;
    curl_easy_getinfo(asked.handle, CURLINFO_RESPONSE_CODE, &status);
    if (status != asked.request.wanted || asked.answer.body.size() + count > asked.request.most)
        return 0; // the whole file may come
    asked.answer.body.append(bytes, count);
    return count;
}

/// Sets an option that this code gives its right type.
template <class T>
void set(CURL* handle, CURLoption option, T value) {
    curl_easy_setopt(handle, option, value);
}

class CurlTransport final : public HttpTransport {
  public:
    CurlTransport() {
        if (curl_global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK || !(multi_ = curl_multi_init()))
            throw Error("libcurl cannot be used");
        curl_multi_setopt(multi_, CURLMOPT_MAX_HOST_CONNECTIONS, kConnections);
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    ~CurlTransport() override {
        thread_.request_stop();
        curl_multi_wakeup(multi_);
        thread_.join();
        for (Asked& asked : asked_)
            if (asked.handle)
                curl_multi_remove_handle(multi_, asked.handle);
        asked_.clear();
        curl_multi_cleanup(multi_);
    }

    void send(HttpRequest request, std::function<void(HttpAnswer)> done) override {
        const Clock::time_point begins = Clock::now() + request.after;
        {
            const std::lock_guard lock(mutex_);
            fresh_.emplace_back();
            fresh_.back().request = std::move(request);
            fresh_.back().done = std::move(done);
            fresh_.back().begins = begins;
        }
        curl_multi_wakeup(multi_);
    }

  private:
    void run(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            {
                const std::lock_guard lock(mutex_);
                asked_.splice(asked_.end(), fresh_);
            }
            int wait = 1000; // [ms]
            for (auto at = asked_.begin(); at != asked_.end();) {
                const auto asked = at++;
                if (asked->handle)
                    continue;
                const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
                    asked->begins - Clock::now());
                if (left.count() > 0)
                    wait = std::min<int>(wait, static_cast<int>(left.count()) + 1);
                else
                    begin(asked);
            }
            int running = 0;
            curl_multi_perform(multi_, &running);
            if (!take_ended())
                curl_multi_poll(multi_, nullptr, 0, wait, nullptr);
        }
    }

    void begin(std::list<Asked>::iterator asked) {
        asked->handle = curl_easy_init();
        if (!asked->handle)
            return end(asked, CURLE_OUT_OF_MEMORY);
        CURL* const handle = asked->handle;
        const HttpRequest& request = asked->request;
        for (const std::string& header : request.headers)
            asked->headers = curl_slist_append(asked->headers, header.c_str());
        set(handle, CURLOPT_URL, request.address.c_str());
        set(handle, CURLOPT_HTTPHEADER, asked->headers);
        set(handle, CURLOPT_HEADERFUNCTION, &take_head);
        set(handle, CURLOPT_HEADERDATA, static_cast<void*>(&*asked));
        set(handle, CURLOPT_WRITEFUNCTION, &take_body);
        set(handle, CURLOPT_WRITEDATA, static_cast<void*>(&*asked));
        set(handle, CURLOPT_PRIVATE, static_cast<void*>(&*asked));
        set(handle, CURLOPT_NOSIGNAL, 1L);
        set(handle, CURLOPT_USERAGENT, "isochron");
        set(handle, CURLOPT_FOLLOWLOCATION, 1L);
        set(handle, CURLOPT_MAXREDIRS, 5L);
        const bool safe = request.address.size() > 4 && (request.address[4] | 0x20) == 's';
        set(handle, CURLOPT_PROTOCOLS_STR, "http,https");
        set(handle, CURLOPT_REDIR_PROTOCOLS_STR, safe ? "https" : "http,https");
        set(handle, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_2TLS));
        set(handle, CURLOPT_PIPEWAIT, 1L);
        set(handle, CURLOPT_CONNECTTIMEOUT_MS,
            static_cast<long>(std::min<std::int64_t>(15'000, request.patience.count())));
        set(handle, CURLOPT_LOW_SPEED_LIMIT, 1L);
        set(handle, CURLOPT_LOW_SPEED_TIME,
            std::max(1L, static_cast<long>(request.patience.count() / 1000)));
        for (const char* name :
             {"CURL_CA_BUNDLE", "SSL_CERT_FILE"}) // as curl and OpenSSL read them
            if (const char* const file = std::getenv(name); file && *file) {
                set(handle, CURLOPT_CAINFO, file);
                break;
            }
        curl_multi_add_handle(multi_, handle);
    }

    bool take_ended() {
        bool any = false;
        int left = 0;
        while (const CURLMsg* const message = curl_multi_info_read(multi_, &left)) {
            if (message->msg != CURLMSG_DONE)
                continue;
            const CURLcode result = message->data.result;
            void* which = nullptr;
            curl_easy_getinfo(message->easy_handle, CURLINFO_PRIVATE, &which);
            const auto asked =
                std::ranges::find_if(asked_, [&](const Asked& one) { return &one == which; });
            curl_multi_remove_handle(multi_, message->easy_handle);
            end(asked, result);
            any = true;
        }
        return any;
    }

    void end(std::list<Asked>::iterator asked, CURLcode result) {
        HttpAnswer& answer = asked->answer;
        long status = 0;
        if (asked->handle)
            curl_easy_getinfo(asked->handle, CURLINFO_RESPONSE_CODE, &status);
        answer.status = static_cast<int>(status);
        const bool other = status != 0 && status != asked->request.wanted;
        if (result == CURLE_UNSUPPORTED_PROTOCOL)
            answer.failure = "it redirects to an address of another kind than http and https, or "
                             "from https to http";
        else if (result == CURLE_TOO_MANY_REDIRECTS)
            answer.failure = "it redirects again and again";
        else if (result == CURLE_WRITE_ERROR && !other)
            answer.failure = "it sends more than it was asked for";
        else if (result == CURLE_OPERATION_TIMEDOUT)
            answer.failure =
                fmt::format("nothing came for {} s", asked->request.patience.count() / 1000);
        else if (result == CURLE_PARTIAL_FILE)
            answer.failure = "the connection was cut";
        else if (result != CURLE_OK && !(other && result == CURLE_WRITE_ERROR))
            answer.failure = curl_easy_strerror(result);
        answer.may_pass = result == CURLE_COULDNT_CONNECT || result == CURLE_PARTIAL_FILE ||
                          result == CURLE_RECV_ERROR || result == CURLE_SEND_ERROR ||
                          result == CURLE_GOT_NOTHING || result == CURLE_HTTP2 ||
                          result == CURLE_HTTP2_STREAM || result == CURLE_SSL_CONNECT_ERROR;
        const auto done = std::move(asked->done);
        HttpAnswer given = std::move(answer);
        asked_.erase(asked);
        done(std::move(given));
    }

    CURLM* multi_ = nullptr;
    std::mutex mutex_;
    std::list<Asked> fresh_; ///< guarded by the mutex
    std::list<Asked> asked_; ///< the thread's
    std::jthread thread_;
};

/// A forked process has none of its parent's threads: it makes a transport of its own.
struct TransportOfProcess {
    std::mutex mutex;
    pid_t owner = 0;
    CurlTransport* transport = nullptr; ///< another process's is left alone
    ~TransportOfProcess() {
        if (owner == ::getpid())
            delete transport;
    }
};

std::shared_ptr<HttpTransport> curl_transport() {
    static TransportOfProcess of;
    const std::lock_guard lock(of.mutex);
    if (of.owner != ::getpid()) {
        of.transport = new CurlTransport();
        of.owner = ::getpid();
    }
    // It owns nothing: who asked last may end on the transport's own thread, which cannot wait for itself.
    return {std::shared_ptr<void>(), of.transport};
}

} // namespace
} // namespace isochron::index

extern "C" __attribute__((visibility("default")))
const isochron::index::LinksModule isochron_links_module{&isochron::index::curl_transport};
