#include "frame_parts.h"

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
  return boundary.name == "hull_port" || boundary.name == "hull_starboard";
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

void Segments::add(std::int64_t first_row, std::int64_t rows, bool closed)
{
  const std::int64_t pieces = closed ? rows : rows - 1;
  for (std::int64_t i = 0; i < pieces; ++i)
    pairs.insert(pairs.end(), { static_cast<std::int32_t>(first_row + i),
                                static_cast<std::int32_t>(first_row + (i + 1 < rows ? i + 1 : 0)) });
  first.push_back(total);
  count.push_back(pieces);
  total += pieces;
}

}  // namespace geocontainer_mpm::record
