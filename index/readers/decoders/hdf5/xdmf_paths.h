// What XDMF documents name: elements of the document, datasets of other files, types.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
} // namespace tinyxml2

namespace isochron::index {

/// The first of these attributes that an element has; empty if it has none.
std::string attribute(const tinyxml2::XMLElement& element,
                      std::initializer_list<const char*> names);

/// `file.h5:/fields/rho`
struct XdmfHeavy {
    std::filesystem::path file; ///< found from the document's folder
    std::string path;
};

/// @throws Error naming the document: no such pair
XdmfHeavy heavy_of(const std::string& text, const std::filesystem::path& document);

/// The element at a path: `/Xdmf/Domain/Grid[2]/Geometry`, `/Xdmf/Domain/DataItem[@Name="x"]`.
/// @return null if there is none
const tinyxml2::XMLElement* xdmf_element(const tinyxml2::XMLDocument& document,
                                         const std::string& path);

/// The type that NumberType, in lower case, and Precision name; none: another one.
std::optional<StoredType> xdmf_type(const std::string& kind, const std::string& precision);

/// A document with the entities that it declares (`<!ENTITY name "value">`) replaced, once.
/// @throws Error naming the file, when that makes it much longer
std::string with_entities(std::string text, const std::string& file);

} // namespace isochron::index
