// The attributes of a DICOM data set, by their tags.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <gdcmDataSet.h>
#include <gdcmTag.h>

namespace isochron::index {

/// A data set that stays alive while this does, or none.
class DicomTags {
  public:
    DicomTags(const gdcm::DataSet& set, std::string file) : set_(set), file_(std::move(file)) {}

    bool empty() const { return set_.IsEmpty(); }
    /// Without blanks at its ends; empty when it is not there.
    std::string text(const gdcm::Tag& tag) const;
    /// All its numbers, as text or binary; none when it is not there.
    /// @throws Error naming the file and the tag: no numbers
    std::vector<double> numbers(const gdcm::Tag& tag) const;
    std::optional<double> number(const gdcm::Tag& tag) const;
    /// The data set of an item of a sequence, counted from 0; an empty one when it is not there.
    DicomTags within(const gdcm::Tag& sequence, std::size_t item) const;
    std::size_t items(const gdcm::Tag& sequence) const;

  private:
    gdcm::DataSet set_;
    std::string file_;
};

} // namespace isochron::index
