#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace curvefusion {

/// Lets `write` fill a temporary folder inside `folder`, and when it has returned gives the files
/// of these names their place in `folder`: all earlier files of these names are replaced together,
/// or removed where there is no new one. Where anything fails, all earlier files stay; others are
/// never touched. The last name disappears first and appears last: where it is there, the set is
/// complete at any time. Throws Error(kResource) where a file cannot be moved; exceptions of
/// `write` pass through.
void WriteFilesTogether(const std::filesystem::path& folder, const std::vector<std::string>& names,
                        const std::function<void(const std::filesystem::path& temporary)>& write);

/// Ends what a killed process has begun with WriteFilesTogether: its files are moved in where it
/// was about to, otherwise the earlier ones are moved back. Removes what else it has left.
void RecoverFileSet(const std::filesystem::path& folder);

}  // namespace curvefusion
