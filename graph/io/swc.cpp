#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "graph/io/graph_formats.h"
#include "graph/io/indexed_curves.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

// SWC (Cannon et al. 1998).
constexpr double kMicrometre = 1e-6;
constexpr int kNoParent = -1;
constexpr int kUndefinedType = 0;

// Writes a graph as a forest of samples, each after its parent; samples count from 1.
class SwcWriter {
 public:
  explicit SwcWriter(const SkeletonGraph& graph) : graph_(graph), curves_(CurvesOf(graph)) {
    const std::vector<NodeId> nodes = graph.Nodes();
    for (size_t i = 0; i < nodes.size(); ++i) vertex_of_[nodes[i]] = static_cast<int>(i);
    const std::vector<EdgeId> edges = graph.Edges();
    for (size_t i = 0; i < edges.size(); ++i) curve_of_[edges[i]] = static_cast<int>(i);
  }

  void Write() {
    for (const NodeId root : graph_.Nodes()) {
      if (sample_of_.count(root) != 0) continue;
      sample_of_[root] = AddSample(vertex_of_.at(root), kNoParent);
      std::deque<NodeId> queue = {root};
      for (; !queue.empty(); queue.pop_front())
        for (const EdgeId edge : graph_.IncidentEdges(queue.front()))
          if (written_.insert(edge).second) AddEdge(edge, queue.front(), queue);
    }
  }

  const std::string& text() const { return text_; }
  const FormatLosses& cuts() const { return cuts_; }

 private:
  int AddSample(int vertex, int parent) {
    const Vec3 p = curves_.vertices[vertex] / kMicrometre;
    const double radius = curves_.radii.empty() ? 0 : curves_.radii[vertex] / kMicrometre;
    text_ += fmt::format("{} {} {} {} {} {} {}\n", ++samples_, kUndefinedType, p.x(), p.y(), p.z(),
                         radius, parent);
    return samples_;
  }

  // The samples of an edge from `node` to its other end, which is queued where it is new.
  void AddEdge(EdgeId id, NodeId node, std::deque<NodeId>& queue) {
    const SkeletonEdge& edge = graph_.edge(id);
    std::vector<int> curve = curves_.curves[curve_of_.at(id)];
    if (edge.nodes[0] != node) std::reverse(curve.begin(), curve.end());
    const NodeId other = graph_.OtherEnd(id, node);
    int parent = sample_of_.at(node);
    for (size_t i = 1; i + 1 < curve.size(); ++i) parent = AddSample(curve[i], parent);
    const int last = AddSample(curve.back(), parent);
    if (sample_of_.emplace(other, last).second) {
      queue.push_back(other);
      return;
    }
    text_ += fmt::format("# sample {} closes a loop: it is the same place as sample {}\n", last,
                         sample_of_.at(other));
    const Vec3 p = graph_.position(other) / kMillimetre;
    cuts_.push_back(
        fmt::format("edge {} would close a cycle; it is cut at node {}, at ({:.3f}, {:.3f}, "
                    "{:.3f}) mm, and ends there in sample {}",
                    id, other, p.x(), p.y(), p.z(), last));
  }

  const SkeletonGraph& graph_;
  const IndexedCurves curves_;
  std::map<NodeId, int> vertex_of_;
  std::map<EdgeId, int> curve_of_;
  std::map<NodeId, int> sample_of_;
  std::set<EdgeId> written_;
  int samples_ = 0;
  std::string text_ = "# Curves of CurveFusion, micrometres: sample type x y z radius parent\n";
  FormatLosses cuts_;
};

class SwcReader {
 public:
  SwcReader(std::string_view text, const std::string& source) : lines_(text), source_(source) {}

  IndexedCurves Read() {
    for (std::string_view line; lines_.Next(line);) {
      line = line.substr(0, line.find('#'));
      const std::string_view first = NextWord(line);
      if (!first.empty()) AddSample(first, line);
    }
    return std::move(curves_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: line {}: {}", source_, lines_.number(), what));
  }

  double Number(std::string_view& words, const char* what) const {
    const std::string_view word = NextWord(words);
    const std::optional<double> value = ParseNumber(word);
    if (!value || !std::isfinite(*value))
      Fail(fmt::format("{} is '{}', not a finite number", what, word));
    return *value;
  }

  int64_t Integer(std::string_view word, const char* what) const {
    const std::optional<int64_t> value = ParseInteger(word);
    if (!value) Fail(fmt::format("{} is '{}', not a whole number", what, word));
    return *value;
  }

  void AddSample(std::string_view first, std::string_view words) {
    const int64_t id = Integer(first, "the sample");
    Number(words, "the type");
    Vec3 position;
    for (double& coordinate : position) coordinate = Number(words, "a coordinate") * kMicrometre;
    const double radius = Number(words, "the radius") * kMicrometre;
    if (radius < 0) Fail(fmt::format("sample {} has a negative radius", id));
    const int64_t parent = Integer(NextWord(words), "the parent");
    const int vertex = static_cast<int>(curves_.vertices.size());
    if (!vertex_of_.emplace(id, vertex).second) Fail(fmt::format("sample {} is there twice", id));
    curves_.vertices.push_back(position);
    curves_.radii.push_back(radius);
    if (parent != kNoParent) Connect(id, vertex, parent);
  }

  void Connect(int64_t id, int vertex, int64_t parent) {
    const auto found = vertex_of_.find(parent);
    if (found == vertex_of_.end() || parent == id)
      Fail(fmt::format("sample {} has the parent {}, which is not among the samples before it", id,
                       parent));
    if (curves_.vertices[found->second] == curves_.vertices[vertex])
      Fail(fmt::format("sample {} lies where its parent {} lies", id, parent));
    curves_.curves.push_back({found->second, vertex});
  }

  LineScanner lines_;
  const std::string& source_;
  std::map<int64_t, int> vertex_of_;
  IndexedCurves curves_;
};

}  // namespace

FormatLosses WriteSwc(const std::filesystem::path& path, const SkeletonGraph& graph) {
  SwcWriter writer(graph);
  writer.Write();
  WriteBytesAtomically(path, writer.text());
  FormatLosses losses = writer.cuts();
  const FormatLosses others = LossesOfIndexedCurves(graph, true);
  losses.insert(losses.end(), others.begin(), others.end());
  return losses;
}

SkeletonGraph ReadSwc(const std::string& text, const std::string& source) {
  return GraphOf(SwcReader(text, source).Read(), source);
}

}  // namespace curvefusion
