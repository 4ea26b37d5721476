#pragma once

#include <string>
#include <string_view>

namespace curvefusion {

/// Throws Error(kBadInput) where XML is nested deeper than 32 elements, which parsers that recurse
/// must not be given, and for document types (DOCTYPE), which no GraphML needs. Other defects are
/// left to the parser, but closing tags are counted as it counts them.
void RequireShallowXml(std::string_view text, const std::string& source);

}  // namespace curvefusion
