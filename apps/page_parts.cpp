#include "apps/page_parts.h"

#include <algorithm>
#include <cassert>

namespace curvefusion {

namespace {

constexpr std::string_view kOpen = "{{";
constexpr std::string_view kClose = "}}";

std::string_view TextOf(std::string_view name) {
  const std::vector<PagePart>& parts = PageParts();
  const auto part = std::find_if(parts.begin(), parts.end(),
                                 [&](const PagePart& candidate) { return candidate.name == name; });
  assert(part != parts.end());
  return part->text;
}

}  // namespace

std::string AssemblePage(std::string_view name, std::string_view data) {
  std::string page;
  std::string_view rest = TextOf(name);
  for (size_t open = rest.find(kOpen); open != std::string_view::npos; open = rest.find(kOpen)) {
    page += rest.substr(0, open);
    rest.remove_prefix(open + kOpen.size());
    const size_t close = rest.find(kClose);
    const std::string_view wanted = rest.substr(0, close);
    page += wanted == "data" ? data : TextOf(wanted);
    rest.remove_prefix(close + kClose.size());
  }
  page += rest;
  return page;
}

}  // namespace curvefusion
