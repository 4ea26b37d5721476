#include "fusion/shards/shard_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fusion/shards/scan_fingerprint.h"
#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOneProgram =
    "make all shards and the result with one program, on machines of one kind";
constexpr int kMostListed = 10;  // of missing shards; chosen: a message stays short

[[noreturn]] void Refuse(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

std::vector<fs::path> FilesOf(const std::vector<fs::path>& paths) {
  if (paths.size() != 1 || !fs::is_directory(paths[0])) return paths;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(paths[0])) {
    const fs::path& file = entry.path();
    const bool is_partial = file.filename().string().find(".partial-") != std::string::npos;
    if (file.extension() == ".cfshard" && !is_partial) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  if (!files.empty()) return files;
  Refuse(paths[0].string() +
         ": holds no shard (*.cfshard); name the folder or the files that `reconstruct --shard` "
         "has written");
}

// `shards` are ordered by number.
void RequireNoneTwice(const std::vector<Shard>& shards) {
  const Shard& first = shards.front();
  for (size_t i = 1; i < shards.size(); ++i) {
    const Shard& shard = shards[i];
    if (shard.header.shard.count != first.header.shard.count) {
      Refuse(fmt::format("{} is shard {} and {} is shard {}; name the shards of one kind alone",
                         first.file.string(), ShardText(first.header.shard), shard.file.string(),
                         ShardText(shard.header.shard)));
    }
    if (shard.header.shard == shards[i - 1].header.shard) {
      Refuse(fmt::format("{} and {} are both shard {}; name it once", shards[i - 1].file.string(),
                         shard.file.string(), ShardText(shard.header.shard)));
    }
  }
}

void RequireNoneMissing(const std::vector<Shard>& shards) {
  const int count = shards.front().header.shard.count;
  std::string missing;
  int left = count - static_cast<int>(shards.size());
  size_t next = 0;
  for (int number = 1, listed = 0; number <= count && listed < std::min(left, kMostListed);
       ++number) {
    if (next < shards.size() && shards[next].header.shard.number == number) {
      ++next;
    } else {
      missing += fmt::format("{}{}/{}", listed++ == 0 ? "" : ", ", number, count);
    }
  }
  if (left == 0) return;
  Refuse(
      fmt::format("{} of {} shards are missing: {}{}; make each with `reconstruct --shard {}`, "
                  "or name its file too",
                  left, count, missing, left > kMostListed ? " and others" : "",
                  missing.substr(0, missing.find(','))));
}

std::string OtherPoses(const ChangedLine& change) {
  return fmt::format("{} = {} was found for it, here it is {}; {}", change.name, change.before,
                     change.now, kOneProgram);
}

void RequireAgreement(const std::vector<Shard>& shards) {
  const Shard& first = shards.front();
  int bundle = 0, frame = 0;
  for (const Shard& shard : shards) {
    const ShardHeader& header = shard.header;
    if (const auto change = FirstChange(header.prepared, first.header.prepared)) {
      Refuse(fmt::format("{}: {} (in {})", shard.file.string(), OtherPoses(*change),
                         first.file.string()));
    }
    if (!IsSame(shard.learned, first.learned)) {
      Refuse(fmt::format("{}: has learned other surfaces and colours of the scan than {}; {}",
                         shard.file.string(), first.file.string(), kOneProgram));
    }
    if (header.bundles.first != bundle || header.first_frame != frame) {
      Refuse(fmt::format("{}: begins with frame {}, but the shard before it ends with frame {}; {}",
                         shard.file.string(), header.first_frame, frame, kOneProgram));
    }
    bundle = header.bundles.last;
    frame = header.last_frame;
  }
}

}  // namespace

ShardHeader ShardOf(const Sequence& sequence, const BestOptions& options, ShardNumber shard) {
  const auto bundles = SplitIntoBundles(sequence.frame_count(), options.segmentation.bundle.frames);
  const int count = static_cast<int>(bundles.size());
  if (shard.count > count) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--shard {}/{}: a shard has at least one bundle, and {} frames are {} "
                            "(of {} frames); N can be at most {}",
                            shard.number, shard.count, sequence.frame_count(), count,
                            options.segmentation.bundle.frames, count));
  }
  // Where shard `number` ends: at the bundle whose begin is nearest to its share of the frames,
  // with a bundle at least for each of the others.
  const auto end_of = [&](int number) {
    const double frame = static_cast<double>(sequence.frame_count()) * number / shard.count;
    const auto nearer = [&](const auto& a, const auto& b) {
      return std::abs(a.first - frame) < std::abs(b.first - frame);
    };
    const auto nearest = std::min_element(bundles.begin(), bundles.end(), nearer);
    return std::clamp(static_cast<int>(nearest - bundles.begin()), number,
                      count - shard.count + number);
  };
  ShardHeader header;
  header.shard = shard;
  header.bundles = {shard.number == 1 ? 0 : end_of(shard.number - 1),
                    shard.number == shard.count ? count : end_of(shard.number)};
  header.first_frame = bundles[static_cast<size_t>(header.bundles.first)].first;
  header.last_frame = bundles[static_cast<size_t>(header.bundles.last) - 1].second;
  return header;
}

std::string ForeignText(const ShardIdentity& shard, const ShardIdentity& wanted) {
  if (shard.method != wanted.method) {
    return fmt::format("was made by version {} of the method, this program has {}; {}",
                       shard.method, wanted.method, kOneProgram);
  }
  if (const auto change = FirstChange(shard.settings, wanted.settings)) {
    return fmt::format(
        "was made with {} = {}, here it is {}; give all shards and the result the "
        "same settings",
        change->name, change->before, change->now);
  }
  if (const auto change = FirstChange(shard.scan, wanted.scan)) {
    return fmt::format(
        "was made of another scan: {} = {}, here it is {}; name the scan that it "
        "was made of, or make it again",
        change->name, change->before, change->now);
  }
  return {};
}

std::vector<Shard> OpenShards(const std::vector<fs::path>& paths, const ShardIdentity& identity) {
  std::vector<Shard> shards;
  for (const fs::path& file : FilesOf(paths)) {
    shards.push_back(OpenShard(file));
    const std::string foreign = ForeignText(shards.back().header.identity, identity);
    if (!foreign.empty()) Refuse(file.string() + ": " + foreign);
  }
  std::stable_sort(shards.begin(), shards.end(), [](const Shard& a, const Shard& b) {
    return a.header.shard.number < b.header.shard.number;
  });
  RequireNoneTwice(shards);
  RequireNoneMissing(shards);
  RequireAgreement(shards);
  return shards;
}

BundleSource BundlesOf(const std::vector<Shard>& shards, const Sequence& sequence) {
  const Shard& first = shards.front();
  if (const auto change = FirstChange(first.header.prepared, ScanFingerprint(sequence))) {
    Refuse(first.file.string() + ": " + OtherPoses(*change));
  }
  if (shards.back().header.last_frame != sequence.frame_count()) {
    Refuse(fmt::format("{}: ends with frame {}, the scan with frame {}; {}",
                       shards.back().file.string(), shards.back().header.last_frame,
                       sequence.frame_count(), kOneProgram));
  }
  return [&shards](const BundleSink& sink) {
    sink.on_learned(shards.front().learned);
    for (const Shard& shard : shards) ReadBundles(shard, sink.on_bundle);
  };
}

}  // namespace curvefusion
