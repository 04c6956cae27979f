// Opens, describes and decodes files on request.
#include "index/decoders/reader_service.h"

#include "index/decoders/reader_limits.h"
#include "index/error.h"
#include "index/system/shared_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <optional>

namespace isochron::index {
namespace {

class Service {
  public:
    Service(std::span<const Decoder> decoders, ReadCollectionFile collection)
        : decoders_(decoders), collection_(collection) {}

    /// The reply to a request, if it has one.
    std::optional<ReaderReply> answer(const ReaderRequest& request, Descriptor attached) {
        attached_ = std::move(attached);
        return std::visit([this](const auto& asked) { return answer_to(asked); }, request);
    }

  private:
    std::optional<ReaderReply> answer_to(const OpenFile& open) {
        file_.reset();
        path_ = open.path;
        limits_.emplace(open.path, open.most_memory);
        const auto decoder = std::ranges::find(decoders_, open.format, &Decoder::format);
        if (decoder == decoders_.end())
            throw Error("asked for a format of another reader");
        return attempt([&]() -> ReaderReply {
            file_ = decoder->open(open.path, open.options);
            limits_->expect(file_->decoded_bytes());
            return Described{file_->info(), file_->steps(), file_->slices_at_once()};
        });
    }

    std::optional<ReaderReply> answer_to(const UseMemory& use) {
        memory_.reset();
        memory_ = std::make_unique<SharedMemory>(std::move(attached_), use.bytes);
        return std::nullopt;
    }

    std::optional<ReaderReply> answer_to(const ReadSlab& slab) {
        if (!file_)
            throw Error("asked for a slab of no file");
        const SeriesInfo& info = file_->info();
        const Grid& grid = info.grid;
        const std::uint64_t slice = info.step_bytes() / grid.vertices[2];
        const std::uint64_t bytes = slab.slices.count * slice;
        const auto shared = memory_ ? memory_->bytes() : std::span<std::byte>{};
        if (slab.step >= file_->steps() ||
            std::uint64_t{slab.slices.first} + slab.slices.count > grid.vertices[2] ||
            slab.offset > shared.size() || bytes > shared.size() - slab.offset)
            throw Error("asked for a slab that there is not, or to where there is no memory");
        limits_->renew_time();
        return attempt([&]() -> ReaderReply {
            file_->read(slab.step, slab.slices, shared.subspan(slab.offset, bytes));
            return SlabRead{};
        });
    }

    std::optional<ReaderReply> answer_to(const ReadCollection& collection) {
        file_.reset();
        path_ = collection.path;
        limits_.emplace(collection.path, 0);
        if (!collection_)
            throw Error("asked for a collection, which are for another reader");
        return attempt([&]() -> ReaderReply { return Collected{collection_(collection.path)}; });
    }

    std::optional<ReaderReply> answer_to(const CloseFile&) {
        file_.reset();
        return Closed{};
    }

    template <class Work>
    ReaderReply attempt(const Work& work) const {
        try {
            return work();
        } catch (const Error& error) {
            return Refused{in_one_line(error.what())};
        } catch (const std::bad_alloc&) {
            return Refused{fmt::format("{}: cannot be read: out of memory ({})", path_.string(),
                                       limits_->text())};
        } catch (const std::exception& other) {
            return Refused{
                in_one_line(fmt::format("{}: cannot be read: {}", path_.string(), other.what()))};
        }
    }

    std::span<const Decoder> decoders_;
    ReadCollectionFile collection_;
    std::filesystem::path path_; ///< of the last file that was requested
    std::unique_ptr<DecodedFile> file_;
    std::optional<ReaderBudget> limits_; ///< of that file
    std::unique_ptr<SharedMemory> memory_;
    Descriptor attached_;
};

} // namespace

std::uint32_t slices_worth_asking(const SeriesInfo& info) {
    constexpr std::uint64_t kBytes = 1 << 20;
    const std::uint64_t slice = info.step_bytes() / info.grid.vertices[2];
    return static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(kBytes / slice, 1, info.grid.vertices[2]));
}

std::string in_one_line(std::string message) {
    std::ranges::replace_if(
        message, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    return message;
}

void serve(MessageSocket& socket, std::span<const Decoder> decoders,
           ReadCollectionFile collection) {
    if (!socket.send(encoded(ReaderReply(Ready{kReaderVersion}))))
        return;
    Service service(decoders, collection);
    while (auto message = socket.receive()) {
        const auto reply =
            service.answer(request_from(message->bytes), std::move(message->attached));
        if (reply && !socket.send(encoded(*reply)))
            return;
    }
}
} // namespace isochron::index
