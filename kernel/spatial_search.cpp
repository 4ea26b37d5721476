#include "kernel/spatial_search.h"

#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <boost/iterator/counting_iterator.hpp>
#include <iterator>

namespace curvefusion {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

// Lets the tree store indices and look the points up.
struct PointOfIndex {
  using value_type = Point;
  using reference = const Point&;
  using key_type = int;
  using category = boost::lvalue_property_map_tag;
  const Point* points = nullptr;
  const Point& operator[](int i) const { return points[i]; }
  friend const Point& get(const PointOfIndex& map, int i) { return map.points[i]; }
};

using BaseTraits = CGAL::Search_traits_3<Kernel>;
using Traits = CGAL::Search_traits_adapter<int, PointOfIndex, BaseTraits>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
using Tree = Search::Tree;
using Sphere = CGAL::Fuzzy_sphere<Traits>;

}  // namespace

struct PointIndex::Impl {
  std::vector<Point> points;
  PointOfIndex map;
  std::unique_ptr<Tree> tree;
};

PointIndex::PointIndex(const std::vector<Vec3>& points) : impl_(std::make_unique<Impl>()) {
  impl_->points.reserve(points.size());
  for (const Vec3& p : points) impl_->points.emplace_back(p.x(), p.y(), p.z());
  impl_->map.points = impl_->points.data();
  impl_->tree =
      std::make_unique<Tree>(boost::counting_iterator<int>(0),
                             boost::counting_iterator<int>(static_cast<int>(points.size())),
                             Tree::Splitter(), Traits(impl_->map));
  if (!points.empty()) impl_->tree->build();
}

PointIndex::~PointIndex() = default;
PointIndex::PointIndex(PointIndex&&) noexcept = default;
PointIndex& PointIndex::operator=(PointIndex&&) noexcept = default;

size_t PointIndex::size() const { return impl_->points.size(); }

void PointIndex::WithinRadius(const Vec3& p, double radius, std::vector<int>& found) const {
  found.clear();
  if (impl_->points.empty()) return;
  const Sphere sphere(Point(p.x(), p.y(), p.z()), radius, 0.0, Traits(impl_->map));
  impl_->tree->search(std::back_inserter(found), sphere);
  std::sort(found.begin(), found.end());
}

int PointIndex::Nearest(const Vec3& p) const {
  if (impl_->points.empty()) return -1;
  const Search search(*impl_->tree, Point(p.x(), p.y(), p.z()), 1, 0.0, true,
                      Search::Distance(impl_->map));
  return search.begin()->first;
}

std::vector<int> PointIndex::NearestK(const Vec3& p, int k) const {
  std::vector<int> indices;
  if (impl_->points.empty()) return indices;
  const Search search(*impl_->tree, Point(p.x(), p.y(), p.z()), static_cast<unsigned>(k), 0.0, true,
                      Search::Distance(impl_->map));
  std::vector<std::pair<double, int>> by_distance;
  for (const auto& [index, squared_distance] : search)
    by_distance.emplace_back(squared_distance, index);
  std::sort(by_distance.begin(), by_distance.end());
  for (const auto& entry : by_distance) indices.push_back(entry.second);
  return indices;
}

}  // namespace curvefusion
