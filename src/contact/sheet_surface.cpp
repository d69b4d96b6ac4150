#include "geocontainer_mpm/contact/sheet_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geocontainer_mpm::contact {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

template <int Dim>
std::array<int, Dim> cell_of(const Vec<Dim>& x, const mpm::Grid<Dim>& grid)
{
  std::array<int, Dim> cell;
  for (int d = 0; d < Dim; ++d)
    cell[static_cast<std::size_t>(d)] =
        std::clamp(static_cast<int>(std::floor((x[d] - grid.origin()[d]) * grid.inverse_dx())), 0,
                   grid.counts()[static_cast<std::size_t>(d)] - 1);
  return cell;
}

/// Calls `visit(cell)` for all cells between two, these included, the last index fastest.
template <int Dim, class Visitor>
void for_cells(const std::array<int, Dim>& low, const std::array<int, Dim>& high, Visitor&& visit)
{
  std::array<int, Dim> cell = low;
  for (;;) {
    visit(cell);
    std::size_t d = Dim - 1;
    while (++cell[d] > high[d]) {
      cell[d] = low[d];
      if (d-- == 0)
        return;
    }
  }
}

}  // namespace

template <int Dim>
void SheetSurface<Dim>::lay_out(const ClosedSheet<Dim>& sheet, double reach, const mpm::Grid<Dim>& grid)
{
  facets_.lay(sheet, side_, grid);
  reach_ = reach;
  for (const std::size_t cell : cells_)
    first_[cell] = none;
  cells_.clear();
  entries_.clear();
  first_.resize(grid.size(), none);
  const Vec<Dim> margin = Vec<Dim>::Constant(reach), to_middle = Vec<Dim>::Constant(0.5 * grid.dx());
  for (std::size_t s = 0; s < facets_.size(); ++s) {
    if (facets_.is_degenerate(s))
      continue;
    for_cells<Dim>(cell_of<Dim>(facets_.lower(s) - margin, grid), cell_of<Dim>(facets_.upper(s) + margin, grid),
                   [&](const std::array<int, Dim>& cell) {
                     if (!facets_.may_reach(s, grid.coordinate(cell) + to_middle, 0.5 * grid.dx() + reach))
                       return;
                     std::uint32_t& first = first_[grid.index(cell)];
                     if (first == none)
                       cells_.push_back(grid.index(cell));
                     entries_.push_back({ static_cast<std::uint32_t>(s), first });
                     first = static_cast<std::uint32_t>(entries_.size() - 1);
                   });
  }
}

template <int Dim>
std::optional<SheetFoot<Dim>> SheetSurface<Dim>::nearest(const Vec<Dim>& point, const mpm::Grid<Dim>& grid) const
{
  SheetFoot<Dim> foot;
  double best = reach_ * reach_;
  foot.seen = { std::numeric_limits<double>::infinity(), Vec<Dim>::Zero() };
  for (std::uint32_t e = first_[grid.index(cell_of<Dim>(point, grid))]; e != none; e = entries_[e].next)
    facets_.look(entries_[e].facet, point, best, foot);
  if (!(foot.seen.distance < reach_))
    return std::nullopt;
  const auto is_through = [&] { return (facets_.winding(point) == 0) == (side_ == SheetSide::inside); };
  if (foot.seen.distance < 0.0 && !is_through())
    foot.seen = { -foot.seen.distance, -foot.seen.normal };
  return foot;
}

template class SheetSurface<2>;
template class SheetSurface<3>;

}  // namespace geocontainer_mpm::contact
