// Opens, describes and decodes files on request.
#include "index/readers/decoders/reader_service.h"

#include "index/json_mistake.h"

#include "index/error.h"
#include "index/readers/process/readable_places.h"
#include "index/system/shared_memory.h"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <new>
#include <optional>

namespace isochron::index {
namespace {

class Service {
  public:
    Service(std::span<const Decoder> decoders, const OtherFiles& others, TakeDenied denied)
        : decoders_(decoders), others_(others), denied_(denied) {}

    /// The reply to a request, if it has one.
    std::optional<ReaderReply> answer(const ReaderRequest& request, Descriptor attached) {
        attached_ = std::move(attached);
        return std::visit([this](const auto& asked) { return answer_to(asked); }, request);
    }

  private:
    std::optional<ReaderReply> answer_to(const OpenFile& open) {
        files_.erase(open.number);
        path_ = open.path;
        const auto decoder = std::ranges::find(decoders_, open.format, &Decoder::format);
        if (decoder == decoders_.end())
            throw Error("asked for a format of another reader");
        return attempt([&]() -> ReaderReply {
            auto file = decoder->open(open.path, open.options);
            Described described{file->info(), file->steps(), file->slices_at_once(),
                                file->decoded_bytes()};
            files_[open.number] = std::move(file);
            return described;
        });
    }

    std::optional<ReaderReply> answer_to(const UseMemory& use) {
        memory_.reset();
        memory_ = std::make_unique<SharedMemory>(std::move(attached_), use.bytes);
        return std::nullopt;
    }

    std::optional<ReaderReply> answer_to(const ReadSlab& slab) {
        const auto open = files_.find(slab.file);
        if (open == files_.end())
            throw Error("asked for a slab of no file");
        DecodedFile& file = *open->second;
        const SeriesInfo& info = file.info();
        const Grid& grid = info.grid;
        const std::uint64_t slice = info.step_bytes() / grid.vertices[2];
        const std::uint64_t bytes = slab.slices.count * slice;
        const auto shared = memory_ ? memory_->bytes() : std::span<std::byte>{};
        if (slab.step >= file.steps() ||
            std::uint64_t{slab.slices.first} + slab.slices.count > grid.vertices[2] ||
            slab.offset > shared.size() || bytes > shared.size() - slab.offset)
            throw Error("asked for a slab that there is not, or to where there is no memory");
        return attempt([&]() -> ReaderReply {
            file.read(slab.step, slab.slices, shared.subspan(slab.offset, bytes));
            return SlabRead{};
        });
    }

    std::optional<ReaderReply> answer_to(const ReadCollection& collection) {
        files_.clear();
        path_ = collection.path;
        if (!others_.collection)
            throw Error("asked for a collection, which are for another reader");
        return attempt([&]() -> ReaderReply { return Collected{others_.collection(collection.path)}; });
    }

    std::optional<ReaderReply> answer_to(const ReadPicture& asked) {
        path_ = asked.path;
        pixels_.clear();
        if (!others_.picture)
            throw Error("asked for a picture, which are for another reader");
        return attempt([&]() -> ReaderReply {
            DecodedPicture found = others_.picture(asked.path, asked.pixels);
            pixels_ = std::move(found.rgba);
            return PictureRead{std::move(found.note), found.width, found.height};
        });
    }

    std::optional<ReaderReply> answer_to(const TakePicture& /*asked*/) {
        const auto shared = memory_ ? memory_->bytes() : std::span<std::byte>{};
        if (pixels_.empty() || pixels_.size() > shared.size())
            throw Error("asked for pixels that there are not, or to where there is no memory");
        std::ranges::copy(std::as_bytes(std::span(pixels_)), shared.begin());
        return SlabRead{};
    }

    std::optional<ReaderReply> answer_to(const ReadModel& asked) {
        path_ = asked.path;
        model_ = {};
        if (!others_.model)
            throw Error("asked for a model, which are for another reader");
        return attempt([&]() -> ReaderReply {
            model_ = others_.model(asked.path);
            return ModelRead{model_.origin, model_.points.size(), model_.corners.size()};
        });
    }

    std::optional<ReaderReply> answer_to(const TakeModel& /*asked*/) {
        auto shared = memory_ ? memory_->bytes() : std::span<std::byte>{};
        for (const auto& part : {std::as_bytes(std::span(model_.points)),
                                 std::as_bytes(std::span(model_.normals)),
                                 std::as_bytes(std::span(model_.corners))}) {
            if (part.empty() || part.size() > shared.size())
                throw Error("asked for a model that there is not, or to where there is no memory");
            std::ranges::copy(part, shared.begin());
            shared = shared.subspan(part.size());
        }
        model_ = {};
        return SlabRead{};
    }

    std::optional<ReaderReply> answer_to(const CloseFile& close) {
        files_.erase(close.file);
        return Closed{};
    }

    template <class Work>
    ReaderReply attempt(const Work& work) const {
        if (denied_)
            denied_();
        ReaderReply reply = tried(work);
        // Some libraries take what they cannot open for empty, so that the values would be wrong.
        const std::filesystem::path denied = denied_ ? denied_() : std::filesystem::path();
        return denied.empty() ? reply : Refused{in_one_line(leads_out(path_, denied))};
    }

    template <class Work>
    ReaderReply tried(const Work& work) const {
        try {
            return work();
        } catch (const Error& error) {
            return Refused{in_one_line(error.what())};
        } catch (const std::bad_alloc&) {
            struct rlimit limit {};
            ::getrlimit(RLIMIT_DATA, &limit);
            return Refused{fmt::format("{}: cannot be read: out of memory (at most {:.1f} GB for "
                                       "its reader)",
                                       path_.string(), static_cast<double>(limit.rlim_cur) / 1e9)};
        } catch (const nlohmann::json::exception& mistake) {
            return Refused{in_one_line(
                fmt::format("{}: cannot be read: {}", path_.string(), json_mistake(mistake)))};
        } catch (const std::exception& other) {
            return Refused{
                in_one_line(fmt::format("{}: cannot be read: {}", path_.string(), other.what()))};
        }
    }

    std::span<const Decoder> decoders_;
    OtherFiles others_;
    TakeDenied denied_;
    std::filesystem::path path_; ///< the last file that was requested
    std::map<std::uint64_t, std::unique_ptr<DecodedFile>> files_; ///< by number
    std::unique_ptr<SharedMemory> memory_;
    std::vector<std::uint8_t> pixels_; ///< pixels of the last picture
    TriangleMesh model_;               ///< the last one
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

void serve(MessageSocket& socket, std::span<const Decoder> decoders, const OtherFiles& others,
           TakeDenied denied) {
    if (!socket.send(encoded(ReaderReply(Ready{kReaderVersion}))))
        return;
    Service service(decoders, others, denied);
    while (auto message = socket.receive()) {
        const auto reply =
            service.answer(request_from(message->bytes), std::move(message->attached));
        if (reply && !socket.send(encoded(*reply)))
            return;
    }
}
} // namespace isochron::index
