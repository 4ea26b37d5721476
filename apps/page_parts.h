#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace curvefusion {

/// A text that pages are made of: HTML, a style, a script.
struct PagePart {
  std::string_view name;  ///< such as "viewer.js"
  std::string_view text;
};

/// All of them, put into this program when it is built (cmake/WritePageParts.cmake).
const std::vector<PagePart>& PageParts();

/// The part of this name with every {{NAME}} in it replaced: {{data}} by `data`, others by the
/// parts of these names, as they are.
std::string AssemblePage(std::string_view name, std::string_view data);

}  // namespace curvefusion
