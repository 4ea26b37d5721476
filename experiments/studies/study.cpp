#include "experiments/studies/study.h"

#include <algorithm>
#include <cctype>

#include "experiments/simulation/families/scan_draw.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

namespace {

constexpr int kSeeds = 3;
// Of train, validation and test: apart by more than the 99 seeds that may be asked for.
constexpr uint64_t kFirstSeeds[] = {1, 201, 101};

// Where a name stands among the known ones. Throws Error(kUsage) naming the nearest for another.
size_t PlaceOf(const std::string& name, const std::vector<std::string>& known, const char* kind) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<size_t>(found - known.begin());
  throw Error(ErrorKind::kUsage, std::string("there is no ") + kind + " " + name +
                                     "; did you mean " + NearestName(name, known) + "?");
}

// The names asked for. Throws Error(kUsage) for the first that is not known.
std::vector<std::string> KnownNames(const std::vector<std::string>& asked,
                                    const std::vector<std::string>& known, const char* kind) {
  for (const std::string& name : asked) PlaceOf(name, known, kind);
  return asked;
}

// The same path in so many frames.
void ThinOut(int frames, SimulationOptions& scan) {
  scan.motion.frame_rate *= static_cast<double>(frames) / scan.frames;
  scan.frames = frames;
}

}  // namespace

std::vector<std::string> SplitNames() { return {"train", "validation", "test"}; }

std::string SplitName(Split split) { return SplitNames()[static_cast<size_t>(split)]; }

Split SplitNamed(const std::string& name) {
  return static_cast<Split>(PlaceOf(name, SplitNames(), "split"));
}

std::vector<uint64_t> SeedsOf(const StudyRequest& request) {
  const int count = request.seeds > 0 ? request.seeds : request.quick ? 1 : kSeeds;
  const uint64_t first = kFirstSeeds[static_cast<size_t>(request.split)];
  std::vector<uint64_t> seeds;
  for (int i = 0; i < count; ++i) seeds.push_back(first + static_cast<uint64_t>(i));
  return seeds;
}

std::vector<std::string> ObjectsOf(const StudyRequest& request) {
  if (request.objects.empty()) {
    if (request.quick) return {"cat", "deco"};
    return {"dish", "cage", "cat", "deco", "hanger", "rack", "chair", "wine"};
  }
  return KnownNames(request.objects, ObjectNames(), "object");
}

std::vector<std::string> FamiliesOf(const StudyRequest& request) {
  if (request.objects.empty()) {
    if (request.quick) return {"cage", "tree", "cables", "furnished", "room"};
    return FamilyNames();
  }
  return KnownNames(request.objects, FamilyNames(), "family");
}

SimulationOptions FamilyScan(const StudyRequest& request, const std::string& family,
                             uint64_t seed) {
  SimulationOptions scan = DrawScan(family, seed, request.sensor);
  if (request.quick) ThinOut(std::min(scan.frames, FrameCounts().quick), scan);
  return scan;
}

SimulationOptions ObjectScan(const StudyRequest& request, const std::string& object, uint64_t seed,
                             const FrameCounts& frames) {
  SimulationOptions scan;
  scan.object = object;
  scan.seed = seed;
  scan.frames = frames.full;
  if (request.quick) ThinOut(frames.quick, scan);
  return scan;
}

Config CaseConfig(const StudyRequest& request, Profile profile,
                  const std::vector<std::string>& more) {
  ConfigSources sources{profile, {}, request.assignments};
  sources.assignments.insert(sources.assignments.end(), more.begin(), more.end());
  return ReadConfig(sources);
}

std::string LabelOf(const Labels& labels, const std::string& name) {
  for (const auto& [label, value] : labels) {
    if (label == name) return value;
  }
  return "";
}

std::string CaseName(const StudyCase& study_case) {
  std::string name;
  for (const auto& [label, value] : study_case.labels) name += value + "_";
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  }
  return name + "s" + std::to_string(study_case.seed);
}

}  // namespace curvefusion
