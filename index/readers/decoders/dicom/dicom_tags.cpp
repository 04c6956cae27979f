// Texts and numbers of DICOM attributes.
#include "index/readers/decoders/dicom/dicom_tags.h"

#include "index/readers/formats/text_header.h"
#include "index/utf8.h"

#include <fmt/format.h>
#include <gdcmByteValue.h>
#include <gdcmDicts.h>
#include <gdcmGlobal.h>
#include <gdcmSequenceOfItems.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace isochron::index {
namespace {

/// How numbers are stored where the file itself does not say: in the older transfer syntax.
gdcm::VR::VRType implied(const gdcm::Tag& tag) {
    return gdcm::Global::GetInstance().GetDicts().GetPublicDict().GetDictEntry(tag).GetVR();
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
template <class AnyTag>
std::string bytes_of(const gdcm::DataSet& set, const AnyTag& tag) {
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

std::string DicomTags::bytes(const gdcm::PrivateTag& tag) const {
    return bytes_of(set_, tag);
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
    case gdcm::VR::US_SS:
    case gdcm::VR::AT: return binary<std::uint16_t>(bytes);
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

double DicomTags::rounding(const gdcm::Tag& tag) const {
    const std::string words = text(tag);
    std::size_t most = 0;
    for (std::size_t at = words.find('.'); at != words.npos; at = words.find('.', at + 1)) {
        const std::size_t end = words.find_first_not_of("0123456789", at + 1);
        most = std::max(most, std::min(end, words.size()) - at - 1);
    }
    return most == 0 ? 0 : 0.5 * std::pow(10.0, -static_cast<double>(most));
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

std::string keyword_of(const gdcm::Tag& tag) {
    const char* keyword =
        gdcm::Global::GetInstance().GetDicts().GetPublicDict().GetKeywordFromTag(tag);
    return keyword && *keyword ? keyword
                               : fmt::format("({:04x},{:04x})", tag.GetGroup(), tag.GetElement());
}

} // namespace isochron::index
