// Reads a file on a web server by ranges of its bytes.
#pragma once

#include "index/system/byte_source.h"
#include "index/system/links/http_transport.h"

#include <functional>
#include <memory>
#include <string>

namespace isochron::index {

/// The file of another machine, which may replace it while it is open.
class RemoteSource : public ByteSource {
  public:
    /// Whether another content holds all that this one held.
    using Same = std::function<bool(std::unique_ptr<ByteSource> now)>;
    /// Says where reading goes on with what replaces the file; without it, that is an Error.
    virtual void accept_where(Same same) const = 0;
    /// Whether it may be another one by now.
    virtual bool may_have_changed() const = 0;
};

/// The source as one of another machine; null: it is of this one.
const RemoteSource* remote_of(const ByteSource& source);

/// Opens the file of a link, or the first index of the page that it leads to. What was read is kept in
/// memory, and on disk where the server names the content by a strong ETag.
/// @param address as `address_of` gives it
/// @throws Error in one line: no such file, no server, no answer to ranges, ...
std::unique_ptr<ByteSource> open_link(const std::string& address);
/// @param keep whether what is read is kept on disk
std::unique_ptr<ByteSource> open_link(const std::string& address,
                                      std::shared_ptr<HttpTransport> transport, bool keep);

} // namespace isochron::index
