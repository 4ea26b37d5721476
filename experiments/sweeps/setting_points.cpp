#include "experiments/sweeps/setting_points.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "kernel/error.h"

namespace curvefusion {

namespace {

enum class Kind { kNumber, kWholeNumber, kTruth };

class KindCollector : public OptionVisitor {
 public:
  void BeginSection(const char* name) override { section_ = name; }
  void Visit(const OptionInfo& info, double&) override { Add(info, Kind::kNumber); }
  void Visit(const OptionInfo& info, int&) override { Add(info, Kind::kWholeNumber); }
  void Visit(const OptionInfo& info, bool&) override { Add(info, Kind::kTruth); }

  // Names that do not exist are numbers: whoever reads the assignments refuses them, and says more.
  Kind Of(const std::string& name) const {
    const auto found = kinds_.find(name);
    return found == kinds_.end() ? Kind::kNumber : found->second;
  }

 private:
  void Add(const OptionInfo& info, Kind kind) {
    kinds_[fmt::format("{}.{}", section_, info.name)] = kind;
  }

  std::string section_;
  std::map<std::string, Kind> kinds_;
};

void CheckRange(const SettingRange& range, Kind kind) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::kUsage, fmt::format("the range of {}, {} to {}: {}", range.name,
                                               range.from, range.to, why));
  };
  if (kind == Kind::kTruth) refuse("the setting is true or false; name both in [grid]");
  if (!(range.from < range.to)) refuse("it must begin below its end");
  if (range.log && !(range.from > 0)) refuse("a logarithmic one must begin above 0");
}

double ValueAt(const SettingRange& range, double share) {
  if (range.log) return range.from * std::pow(range.to / range.from, share);
  return range.from + share * (range.to - range.from);
}

std::string ValueText(double value, Kind kind) {
  return kind == Kind::kWholeNumber ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

}  // namespace

std::vector<SettingPoint> GridPoints(
    const std::vector<std::pair<std::string, std::vector<std::string>>>& values) {
  std::vector<SettingPoint> points = {{}};
  for (const auto& [name, choices] : values) {
    std::vector<SettingPoint> finer;
    for (const SettingPoint& point : points) {
      for (const std::string& value : choices) {
        finer.push_back(point);
        finer.back().push_back(name + "=" + value);
      }
    }
    points = std::move(finer);
  }
  return points;
}

std::vector<SettingPoint> SampledPoints(const std::vector<SettingRange>& ranges,
                                        const SampleOptions& options, Profile profile) {
  KindCollector kinds;
  Config config = ProfileConfig(profile);
  VisitOptions(config, kinds);
  for (const SettingRange& range : ranges) CheckRange(range, kinds.Of(range.name));
  std::vector<SettingPoint> points;
  for (const auto& sample : UnitSamples(options.sampling, options.points,
                                        static_cast<int>(ranges.size()), options.seed)) {
    SettingPoint& point = points.emplace_back();
    for (size_t d = 0; d < ranges.size(); ++d) {
      const Kind kind = kinds.Of(ranges[d].name);
      point.push_back(ranges[d].name + "=" + ValueText(ValueAt(ranges[d], sample[d]), kind));
    }
  }
  return points;
}

}  // namespace curvefusion
