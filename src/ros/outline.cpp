#include "outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

namespace geocontainer_mpm::ros_bridge {
namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge edge_of(std::uint32_t a, std::uint32_t b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// Midships, or as near as the sheet comes; where it ends, just inside, so that its triangles are cut.
double place_of_section(const std::vector<Vec3>& nodes)
{
  const auto [least, most] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  const double inside = 1e-3 * (most->x() - least->x());
  return std::clamp(0.0, least->x() + inside, most->x() - inside);
}

/// The section of a surface as a graph: the edges that the plane cuts, each with those it is joined to by a triangle:
/// two, or one at the rim.
class Section {
public:
  Section(const scene::GeotextileFrame& sheet, double x) : node_(sheet.node), x_(x)
  {
    for (const scene::Triangle& triangle : sheet.triangles) {
      std::vector<Edge> cut;
      for (std::size_t k = 0; k < 3; ++k)
        if (const Edge edge = edge_of(triangle[k], triangle[(k + 1) % 3]); ahead(edge[0]) != ahead(edge[1]))
          cut.push_back(edge);
      if (cut.size() != 2)
        continue;
      joined_[cut[0]].push_back(cut[1]);
      joined_[cut[1]].push_back(cut[0]);
    }
  }

  /// Each piece as points along it, with whether its ends are joined. Rims first: what starts inside a piece that has
  /// ends would miss half of it.
  std::vector<std::pair<std::vector<Vec3>, bool>> pieces()
  {
    std::vector<std::pair<std::vector<Vec3>, bool>> all;
    for (const std::size_t neighbours : { 1u, 2u })
      for (const auto& [edge, joined] : joined_)
        if (joined.size() == neighbours && !seen_[edge])
          all.emplace_back(walk(edge), neighbours == 2);
    return all;
  }

private:
  bool ahead(std::uint32_t node) const { return node_[node].x() >= x_; }

  Vec3 crossing(const Edge& edge) const
  {
    const Vec3 &a = node_[edge[0]], &b = node_[edge[1]];
    return a + (x_ - a.x()) / (b.x() - a.x()) * (b - a);
  }

  std::vector<Vec3> walk(Edge edge)
  {
    std::vector<Vec3> points;
    for (bool goes_on = true; goes_on;) {
      seen_[edge] = true;
      points.push_back(crossing(edge));
      goes_on = false;
      for (const Edge& next : joined_[edge])
        if (!goes_on && !seen_[next]) {
          edge = next;
          goes_on = true;
        }
    }
    return points;
  }

  const std::vector<Vec3>& node_;
  double x_;
  std::map<Edge, std::vector<Edge>> joined_;
  std::map<Edge, bool> seen_;
};

double length_of(const std::vector<Vec3>& line)
{
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
    length += (line[i] - line[i - 1]).norm();
  return length;
}

}  // namespace

std::vector<Vec3> container_outline(const scene::GeotextileFrame& sheet)
{
  std::vector<Vec3> line = sheet.node;
  bool closed = sheet.closed;
  if (!sheet.triangles.empty()) {
    line.clear();
    for (auto& [points, joined] : Section(sheet, place_of_section(sheet.node)).pieces())
      if (line.empty() || length_of(points) > length_of(line)) {
        line = std::move(points);
        closed = joined;
      }
  }
  if (!closed)
    for (std::size_t i = line.size(); i-- > 2;)
      line.push_back(Vec3(line[i - 1]));
  return line;
}

std::vector<std::array<std::uint32_t, 2>> sharp_edges(const scene::BoundaryFrame& boundary)
{
  constexpr double cosine_of_flat = 0.9;
  std::vector<Vec3> normal;
  std::vector<std::pair<Edge, std::size_t>> sides;  // each edge of each triangle
  for (const scene::Triangle& triangle : boundary.triangles) {
    const Vec3 &a = boundary.position[triangle[0]], &b = boundary.position[triangle[1]],
               &c = boundary.position[triangle[2]];
    for (std::size_t k = 0; k < 3; ++k)
      sides.emplace_back(edge_of(triangle[k], triangle[(k + 1) % 3]), normal.size());
    normal.push_back((b - a).cross(c - a).normalized());
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Edge> sharp;
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    while (next < sides.size() && sides[next].first == sides[i].first)
      ++next;
    if (next - i != 2 || normal[sides[i].second].dot(normal[sides[i + 1].second]) < cosine_of_flat)
      sharp.push_back(sides[i].first);
  }
  return sharp;
}

}  // namespace geocontainer_mpm::ros_bridge
