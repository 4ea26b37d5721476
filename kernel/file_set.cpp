#include "kernel/file_set.h"

#include <system_error>

#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/partial_name.h"
#include "kernel/unfinished_path.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr const char* kSet = "result";
// The earlier files while they are moved out, and once all of them are.
constexpr const char* kLeaving = "leaving";
constexpr const char* kReplaced = "replaced";

void MoveAll(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(from)) {
    if (!entry.is_directory()) files.push_back(entry.path());
  }
  for (const fs::path& file : files) fs::rename(file, to / file.filename());
}

bool HoldsEarlierFiles(const fs::path& temporary) {
  std::error_code ignored;
  for (const char* name : {kLeaving, kReplaced}) {
    if (fs::exists(temporary / name, ignored) && !fs::is_empty(temporary / name, ignored)) {
      return true;
    }
  }
  return false;
}

Error CannotBeMoved(const fs::path& folder, const fs::filesystem_error& error) {
  return {ErrorKind::kResource,
          folder.string() + ": results cannot be moved there (" + error.code().message() + ")"};
}

// Earlier files leave; throws filesystem_error.
void MoveOut(const fs::path& folder, const std::vector<std::string>& names,
             const fs::path& temporary) {
  fs::create_directory(temporary / kLeaving);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    if (fs::exists(fs::symlink_status(folder / *name))) {
      fs::rename(folder / *name, temporary / kLeaving / *name);
    }
  }
}

void MoveIn(const fs::path& folder, const std::vector<std::string>& names,
            const fs::path& temporary) {
  fs::rename(temporary / kLeaving, temporary / kReplaced);
  for (const std::string& name : names) {
    if (fs::exists(temporary / name)) fs::rename(temporary / name, folder / name);
  }
}

// Puts earlier files back as far as that is possible.
void Undo(const fs::path& folder, const std::vector<std::string>& names,
          const fs::path& temporary) {
  std::error_code ignored;
  const bool all_left = fs::exists(temporary / kReplaced, ignored);
  const fs::path earlier = temporary / (all_left ? kReplaced : kLeaving);
  for (const std::string& name : names) {
    if (all_left && !fs::exists(temporary / name, ignored)) fs::remove(folder / name, ignored);
    if (fs::exists(earlier / name, ignored)) fs::rename(earlier / name, folder / name, ignored);
  }
}

void Replace(const fs::path& folder, const std::vector<std::string>& names,
             const fs::path& temporary) {
  try {
    MoveOut(folder, names, temporary);
    MoveIn(folder, names, temporary);
  } catch (const fs::filesystem_error& error) {
    Undo(folder, names, temporary);
    throw CannotBeMoved(folder, error);
  }
}

void Recover(const fs::path& folder, const fs::path& temporary) {
  if (fs::exists(temporary / kReplaced)) {
    MoveAll(temporary, folder);
  } else if (fs::exists(temporary / kLeaving)) {
    MoveAll(temporary / kLeaving, folder);
  }
}

}  // namespace

void WriteFilesTogether(const fs::path& folder, const std::vector<std::string>& names,
                        const std::function<void(const fs::path& temporary)>& write) {
  const fs::path temporary = PartialFolderPath(folder / kSet);
  std::error_code failure;
  const auto clean = [&] {
    // What could not be put back waits there for RecoverFileSet.
    if (!HoldsEarlierFiles(temporary)) fs::remove_all(temporary, failure);
  };
  clean();
  fs::create_directory(temporary, failure);
  if (failure) {
    throw Error(ErrorKind::kResource,
                folder.string() + ": results cannot be written there (" + failure.message() + ")");
  }
  try {
    {
      // Not while it holds earlier files.
      const UnfinishedPath unfinished(temporary);
      write(temporary);
    }
    Replace(folder, names, temporary);
  } catch (const Error& error) {
    clean();
    throw WithPathReplaced(error, temporary, folder);
  } catch (...) {
    clean();
    throw;
  }
  fs::remove_all(temporary, failure);
}

void RecoverFileSet(const fs::path& folder) {
  std::vector<fs::path> stale;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(std::string(kSet) + ".") && IsStalePartial(name)) {
      stale.push_back(entry->path());
    }
  }
  try {
    for (const fs::path& temporary : stale) Recover(folder, temporary);
  } catch (const fs::filesystem_error& error) {
    throw CannotBeMoved(folder, error);
  }
  RemoveStalePartialsIn(folder);
}

}  // namespace curvefusion
