// The attributes of a DICOM data set, by their tags.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gdcmDataSet.h>
#include <gdcmPrivateTag.h>
#include <gdcmTag.h>

namespace isochron::index {

/// A data set that stays alive while this does, or none.
class DicomTags {
  public:
    DicomTags(const gdcm::DataSet& set, std::string file) : set_(set), file_(std::move(file)) {}

    bool empty() const { return set_.IsEmpty(); }
    /// Without blanks at its ends; empty when it is not there.
    std::string text(const gdcm::Tag& tag) const;
    /// The value of a private attribute, as it is stored; empty when it is not there.
    std::string bytes(const gdcm::PrivateTag& tag) const;
    /// All its numbers, as text or binary; none when it is not there.
    /// @throws Error naming the file and the tag: no numbers
    std::vector<double> numbers(const gdcm::Tag& tag) const;
    std::optional<double> number(const gdcm::Tag& tag) const;
    /// How far its numbers, which are text, may be off because their last digit is rounded. 0: they
    /// are whole.
    double rounding(const gdcm::Tag& tag) const;
    /// The data set of an item of a sequence, counted from 0; an empty one when it is not there.
    DicomTags within(const gdcm::Tag& sequence, std::size_t item) const;
    std::size_t items(const gdcm::Tag& sequence) const;

  private:
    gdcm::DataSet set_;
    std::string file_;
};

/// Stands for no tag.
inline const gdcm::Tag kNoTag(0, 0);

/// The keyword of an attribute in the standard, `TriggerTime`, or its numbers.
std::string keyword_of(const gdcm::Tag& tag);

/// Looks in the data set of a frame, then in the data set that all frames share, then at the root.
class FrameTags {
  public:
    /// @param groups the sequence with an item for each frame
    FrameTags(const DicomTags& root, const gdcm::Tag& groups, std::uint32_t frame) {
        const gdcm::Tag kDiffusion(0x0018, 0x9117), kDirection(0x0018, 0x9076);
        for (const DicomTags& place :
             {root.within(groups, frame), root.within(gdcm::Tag(0x5200, 0x9229), 0), root}) {
            if (!place.empty())
                places_.push_back(place);
            if (const DicomTags inner = place.within(kDiffusion, 0).within(kDirection, 0);
                !inner.empty())
                places_.push_back(inner);
        }
    }

    /// Numbers of an attribute that stands at the root, or, in files of many frames, in a group.
    std::vector<double> numbers(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        return first<std::vector<double>>(group,
                                          [&](const DicomTags& set) { return set.numbers(tag); });
    }
    std::optional<double> number(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        const auto found = numbers(group, tag);
        return found.empty() ? std::nullopt : std::optional(found.front());
    }
    std::string text(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        return first<std::string>(group, [&](const DicomTags& set) { return set.text(tag); });
    }
    /// As `DicomTags::rounding`.
    double rounding(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        double rounding = 0;
        first<std::string>(group, [&](const DicomTags& set) {
            rounding = set.rounding(tag);
            return set.text(tag);
        });
        return rounding;
    }

  private:
    template <class Value, class Get>
    Value first(const gdcm::Tag& group, const Get& get) const {
        for (const DicomTags& place : places_) {
            if (group != kNoTag)
                if (Value found = get(place.within(group, 0)); !found.empty())
                    return found;
            if (Value found = get(place); !found.empty())
                return found;
        }
        return {};
    }

    std::vector<DicomTags> places_;
};

} // namespace isochron::index
