#pragma once
/// How the named parts of a frame (bodies, sheets, boundaries) are laid end to end in shared arrays. Used by the HDF5
/// file and by its XDMF sidecar, so that the two agree.

#include <cstdint>
#include <string>
#include <vector>

#include "geocontainer_mpm/scene/frame.h"

namespace geocontainer_mpm::record {

/// Rows [first, first + count) of the shared arrays belong to the part of that name.
struct Parts {
  std::vector<std::string> name;
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> count;
  std::int64_t total = 0;
};

template <typename Part>
Parts parts_of(const std::vector<const Part*>& parts, std::vector<Vec3> Part::*field)
{
  Parts result;
  for (const Part* part : parts) {
    result.name.push_back(part->name);
    result.first.push_back(result.total);
    result.count.push_back(static_cast<std::int64_t>((part->*field).size()));
    result.total += result.count.back();
  }
  return result;
}

/// The parts of a frame that hold anything.
std::vector<const scene::SoilFrame*> soil_of(const scene::Frame& frame);
std::vector<const scene::GeotextileFrame*> geotextile_of(const scene::Frame& frame);
std::vector<const scene::BoundaryFrame*> hull_of(const scene::Frame& frame);      ///< the two halves, which move
std::vector<const scene::BoundaryFrame*> surfaces_of(const scene::Frame& frame);  ///< the bed and what else stands

/// For each row the index of its part.
std::vector<std::int32_t> part_of_row(const Parts& parts);

/// What parts are made of between rows of the shared arrays: the straight pieces of a line, also from its last row to
/// its first where it is closed, or triangles. Pieces [first, first + count) belong to the part of that index. Among
/// triangles a line's piece is one whose last two corners are the same row, so that all have as many.
struct Pieces {
  int corners = 2;
  std::vector<std::int32_t> rows;  ///< at the corners, piece by piece
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> count;
  std::int64_t total = 0;

  void add_line(std::int64_t first_row, std::int64_t size, bool closed);
  void add_triangles(std::int64_t first_row, const std::vector<scene::Triangle>& triangles);

private:
  void add_part(std::size_t pieces);
};

/// Of sheets and boundaries.
template <typename Part>
Pieces pieces_of(const std::vector<const Part*>& all, const Parts& parts)
{
  Pieces pieces;
  for (const Part* part : all)
    if (!part->triangles.empty())
      pieces.corners = 3;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i]->triangles.empty())
      pieces.add_line(parts.first[i], parts.count[i], all[i]->closed);
    else
      pieces.add_triangles(parts.first[i], all[i]->triangles);
  return pieces;
}

/// Whether every piece of all sheets has a tension along warp and weft.
bool has_directions(const std::vector<const scene::GeotextileFrame*>& sheets);

}  // namespace geocontainer_mpm::record
