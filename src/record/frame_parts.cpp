#include "frame_parts.h"

#include <algorithm>

namespace geocontainer_mpm::record {

namespace {

template <typename Part, typename Keep>
std::vector<const Part*> select(const std::vector<Part>& all, Keep keep)
{
  std::vector<const Part*> kept;
  for (const Part& part : all)
    if (keep(part))
      kept.push_back(&part);
  return kept;
}

bool is_hull(const scene::BoundaryFrame& boundary)
{
  return boundary.name.compare(0, 5, "hull_") == 0;  // a name that no surface may have
}

}  // namespace

std::vector<const scene::SoilFrame*> soil_of(const scene::Frame& frame)
{
  return select(frame.soil, [](const scene::SoilFrame& body) { return !body.position.empty(); });
}

std::vector<const scene::GeotextileFrame*> geotextile_of(const scene::Frame& frame)
{
  return select(frame.geotextile, [](const scene::GeotextileFrame& sheet) { return !sheet.node.empty(); });
}

std::vector<const scene::BoundaryFrame*> hull_of(const scene::Frame& frame)
{
  return select(frame.boundary,
                [](const scene::BoundaryFrame& part) { return is_hull(part) && !part.position.empty(); });
}

std::vector<const scene::BoundaryFrame*> surfaces_of(const scene::Frame& frame)
{
  return select(frame.boundary,
                [](const scene::BoundaryFrame& part) { return !is_hull(part) && !part.position.empty(); });
}

std::vector<std::int32_t> part_of_row(const Parts& parts)
{
  std::vector<std::int32_t> result;
  for (std::size_t part = 0; part < parts.count.size(); ++part)
    result.insert(result.end(), static_cast<std::size_t>(parts.count[part]), static_cast<std::int32_t>(part));
  return result;
}

void Pieces::add_line(std::int64_t first_row, std::int64_t size, bool closed)
{
  const std::int64_t pieces = closed ? size : size - 1;
  for (std::int64_t i = 0; i < pieces; ++i) {
    const auto from = static_cast<std::int32_t>(first_row + i);
    const auto to = static_cast<std::int32_t>(first_row + (i + 1 < size ? i + 1 : 0));
    rows.insert(rows.end(), { from, to });
    if (corners == 3)
      rows.push_back(to);
  }
  add_part(static_cast<std::size_t>(pieces));
}

void Pieces::add_triangles(std::int64_t first_row, const std::vector<scene::Triangle>& triangles)
{
  for (const scene::Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle)
      rows.push_back(static_cast<std::int32_t>(first_row + corner));
  add_part(triangles.size());
}

void Pieces::add_part(std::size_t pieces)
{
  first.push_back(total);
  count.push_back(static_cast<std::int64_t>(pieces));
  total += count.back();
}

bool has_directions(const std::vector<const scene::GeotextileFrame*>& sheets)
{
  return std::all_of(sheets.begin(), sheets.end(), [](const scene::GeotextileFrame* sheet) {
    const std::size_t pieces = sheet->tension.size();
    return sheet->warp_tension.size() == pieces && sheet->weft_tension.size() == pieces;
  });
}

}  // namespace geocontainer_mpm::record
