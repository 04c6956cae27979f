// Requests and replies as bytes: the number of the message's type, then its fields.
#include "index/readers/process/reader_messages.h"

#include "index/readers/process/message_bytes.h"
#include "version_number.h"

#include <type_traits>

namespace isochron::index {

template <>
constexpr ValueType kLastValue<ValueType> = ValueType::f64;
template <>
constexpr Anatomy kLastValue<Anatomy> = Anatomy::enu;
template <>
constexpr DayMonth kLastValue<DayMonth> = DayMonth::month_first;

namespace {

// The fields of every message, listed once for reading and writing.

template <class Bytes, class T>
concept Of = std::is_same_v<std::remove_const_t<Bytes>, T>;

void each_field(auto& bytes, Of<Grid> auto& grid) {
    bytes(grid.vertices, grid.origin, grid.spacing, grid.direction);
    for (auto& positions : grid.positions) {
        std::vector<double> distances = positions.distances();
        bytes(distances);
        if constexpr (!std::is_const_v<std::remove_reference_t<decltype(positions)>>)
            if (!distances.empty())
                positions = AxisPositions(std::move(distances));
    }
}
void each_field(auto& bytes, Of<SeriesInfo> auto& info) {
    bytes(info.array, info.value_unit, info.length_unit, info.time_unit, info.anatomy, info.type,
          info.scaling.slope, info.scaling.intercept, info.times, info.sources, info.notes,
          info.axis_names, info.arrays);
    each_field(bytes, info.grid);
}
void each_field(auto& bytes, Of<ReadOptions> auto& options) {
    bytes(options.array, options.component, options.dims, options.type, options.big_endian,
          options.allow_surplus, options.extra_axis_is_time, options.times_from_names,
          options.header_bytes, options.spacing, options.origin, options.time_step,
          options.length_unit, options.time_unit, options.value_unit, options.slices,
          options.any_array, options.resample, options.keep_first, options.crop, options.stride,
          options.steps, options.member, options.dates);
}

void each_field(auto& bytes, Of<OpenFile> auto& open) {
    bytes(open.format, open.path, open.number);
    each_field(bytes, open.options);
}
void each_field(auto& bytes, Of<UseMemory> auto& use) {
    bytes(use.bytes);
}
void each_field(auto& bytes, Of<ReadSlab> auto& slab) {
    bytes(slab.step, slab.slices.first, slab.slices.count, slab.offset, slab.file);
}
void each_field(auto& bytes, Of<ReadCollection> auto& collection) {
    bytes(collection.path);
}
void each_field(auto& bytes, Of<CloseFile> auto& close) {
    bytes(close.file);
}

void each_field(auto& bytes, Of<ReadPicture> auto& picture) {
    bytes(picture.path, picture.pixels);
}
void each_field(auto&, Of<TakePicture> auto&) {}
void each_field(auto& bytes, Of<ReadModel> auto& model) {
    bytes(model.path);
}
void each_field(auto&, Of<TakeModel> auto&) {}

void each_field(auto& bytes, Of<Ready> auto& ready) {
    bytes(ready.version);
}
void each_field(auto& bytes, Of<Described> auto& described) {
    bytes(described.steps, described.slices_at_once, described.decoded_bytes);
    each_field(bytes, described.info);
}
void each_field(auto&, Of<SlabRead> auto&) {}
void each_field(auto& bytes, Of<Collected> auto& collected) {
    bytes(collected.files);
}
void each_field(auto&, Of<Closed> auto&) {}
void each_field(auto& bytes, Of<Refused> auto& refused) {
    bytes(refused.message);
}

void each_field(auto& bytes, Of<PictureRead> auto& picture) {
    bytes(picture.note, picture.width, picture.height);
}

void each_field(auto& bytes, Of<ModelRead> auto& model) {
    bytes(model.origin, model.points, model.corners);
}

template <class... Kinds>
std::vector<std::byte> bytes_of_kind(const std::variant<Kinds...>& message) {
    MessageWriter bytes;
    bytes(static_cast<std::uint8_t>(message.index()));
    std::visit([&](const auto& kind) { each_field(bytes, kind); }, message);
    return bytes.take();
}

template <class Message, std::size_t kKind = 0>
Message message_of_kind(std::uint8_t number, MessageReader& bytes) {
    if constexpr (kKind < std::variant_size_v<Message>) {
        if (number != kKind)
            return message_of_kind<Message, kKind + 1>(number, bytes);
        Message message(std::in_place_index<kKind>);
        each_field(bytes, std::get<kKind>(message));
        bytes.expect_end();
        return message;
    } else {
        throw Error("a message of kind {}, expected 0 to {}", number, kKind - 1);
    }
}

template <class Message>
Message message_from(std::span<const std::byte> bytes) {
    MessageReader reader(bytes);
    std::uint8_t number = 0;
    reader(number);
    return message_of_kind<Message>(number, reader);
}

} // namespace

const std::string kReaderVersion = ISOCHRON_VERSION " 9";

std::vector<std::byte> encoded(const LeftReadable& readable) {
    MessageWriter bytes;
    bytes(readable.places);
    return bytes.take();
}

std::vector<std::byte> encoded(const ReaderRequest& request) {
    return bytes_of_kind(request);
}

std::vector<std::byte> encoded(const ReaderReply& reply) {
    return bytes_of_kind(reply);
}

LeftReadable readable_from(std::span<const std::byte> bytes) {
    LeftReadable readable;
    MessageReader reader(bytes);
    reader(readable.places);
    reader.expect_end();
    return readable;
}

ReaderRequest request_from(std::span<const std::byte> bytes) {
    return message_from<ReaderRequest>(bytes);
}

ReaderReply reply_from(std::span<const std::byte> bytes) {
    return message_from<ReaderReply>(bytes);
}

} // namespace isochron::index
