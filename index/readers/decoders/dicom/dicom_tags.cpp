// Texts and numbers of DICOM attributes.
#include "index/readers/decoders/dicom/dicom_tags.h"

#include "index/error.h"
#include "index/readers/formats/text_header.h"
#include "index/utf8.h"

#include <fmt/format.h>
#include <gdcmByteValue.h>
#include <gdcmSequenceOfItems.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace isochron::index {
namespace {

/// How numbers are stored where the file itself does not say: in the older transfer syntax.
gdcm::VR::VRType implied(const gdcm::Tag& tag) {
    static const std::array<std::pair<gdcm::Tag, gdcm::VR::VRType>, 14> kBinary{{
        {{0x0028, 0x0002}, gdcm::VR::US},
        {{0x0028, 0x0006}, gdcm::VR::US},
        {{0x0028, 0x0010}, gdcm::VR::US},
        {{0x0028, 0x0011}, gdcm::VR::US},
        {{0x0028, 0x0100}, gdcm::VR::US},
        {{0x0028, 0x0101}, gdcm::VR::US},
        {{0x0028, 0x0102}, gdcm::VR::US},
        {{0x0028, 0x0103}, gdcm::VR::US},
        {{0x0028, 0x0120}, gdcm::VR::US},
        {{0x0020, 0x930d}, gdcm::VR::FD},
        {{0x0020, 0x9153}, gdcm::VR::FD},
        {{0x0018, 0x9082}, gdcm::VR::FD},
        {{0x0018, 0x9087}, gdcm::VR::FD},
        {{0x0020, 0x9128}, gdcm::VR::UL},
    }};
    const auto known =
        std::ranges::find(kBinary, tag, [](const auto& entry) { return entry.first; });
    return known == kBinary.end() ? gdcm::VR::DS : known->second;
}

template <class T>
std::vector<double> binary(const std::string& bytes) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
        T value{};
        std::memcpy(&value, bytes.data() + at, sizeof value);
        numbers.push_back(static_cast<double>(value));
    }
    return numbers;
}

/// The bytes of an element, as they are.
std::string bytes_of(const gdcm::DataSet& set, const gdcm::Tag& tag) {
    if (!set.FindDataElement(tag))
        return {};
    const gdcm::ByteValue* value = set.GetDataElement(tag).GetByteValue();
    return value && value->GetPointer() ? std::string(value->GetPointer(), value->GetLength())
                                        : std::string();
}

gdcm::SmartPointer<gdcm::SequenceOfItems> sequence_of(const gdcm::DataSet& set,
                                                      const gdcm::Tag& tag) {
    if (!set.FindDataElement(tag))
        return nullptr;
    return set.GetDataElement(tag).GetValueAsSQ();
}

} // namespace

std::string DicomTags::text(const gdcm::Tag& tag) const {
    std::string text = bytes_of(set_, tag);
    std::ranges::replace(text, '\0', ' ');
    return as_utf8(std::string(trimmed(text)));
}

std::vector<double> DicomTags::numbers(const gdcm::Tag& tag) const {
    const std::string bytes = bytes_of(set_, tag);
    if (bytes.empty())
        return {};
    gdcm::VR::VRType kind = set_.GetDataElement(tag).GetVR();
    if (kind == gdcm::VR::INVALID || kind == gdcm::VR::UN)
        kind = implied(tag);
    switch (kind) {
    case gdcm::VR::US:
    case gdcm::VR::US_SS: return binary<std::uint16_t>(bytes);
    case gdcm::VR::SS: return binary<std::int16_t>(bytes);
    case gdcm::VR::UL: return binary<std::uint32_t>(bytes);
    case gdcm::VR::SL: return binary<std::int32_t>(bytes);
    case gdcm::VR::FL: return binary<float>(bytes);
    case gdcm::VR::FD: return binary<double>(bytes);
    default: break;
    }
    std::string words = text(tag);
    std::ranges::replace(words, '\\', ' ');
    return numbers_of(words, fmt::format("({:04x},{:04x})", tag.GetGroup(), tag.GetElement()),
                      file_);
}

std::optional<double> DicomTags::number(const gdcm::Tag& tag) const {
    const auto found = numbers(tag);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

DicomTags DicomTags::within(const gdcm::Tag& sequence, std::size_t item) const {
    const auto items = sequence_of(set_, sequence);
    if (!items || item >= items->GetNumberOfItems())
        return {gdcm::DataSet(), file_};
    return {items->GetItem(item + 1).GetNestedDataSet(), file_}; // counted from 1
}

std::size_t DicomTags::items(const gdcm::Tag& sequence) const {
    const auto items = sequence_of(set_, sequence);
    return items ? items->GetNumberOfItems() : 0;
}

} // namespace isochron::index
