#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

#include "kernel/error.h"

namespace curvefusion {

/// Lets `write` produce a file under a temporary name beside `path` and gives it its final name
/// only when `write` has returned: a killed run leaves nothing half-written under a final name, and
/// the next one removes its temporary (kernel/partial_name.h). The temporary keeps the extension of
/// `path`, so that writers which look at it work. Throws Error(kResource) where the file cannot be
/// written; exceptions of `write` pass through and the temporary is removed; where an Error names
/// the temporary, it names `path` instead.
void WriteFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for writers to a stream (opened in binary mode); stream errors become Error(kResource).
void WriteStreamAtomically(const std::filesystem::path& path,
                           const std::function<void(std::ostream& stream)>& write);

/// The same for bytes that are there already.
void WriteBytesAtomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for a whole folder: `write` fills a temporary one beside `folder`, which gets its name
/// when `write` has returned. Makes the folders above. Throws Error(kUsage) where `folder` is there
/// already and is not an empty folder, before `write` is called or after it; Error(kResource) where
/// it cannot be made.
void WriteFolderAtomically(
    const std::filesystem::path& folder,
    const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same error with another path in its message.
Error WithPathReplaced(const Error& error, const std::filesystem::path& path,
                       const std::filesystem::path& replacement);

}  // namespace curvefusion
