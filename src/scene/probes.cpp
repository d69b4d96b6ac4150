#include "geocontainer_mpm/scene/probes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::scene {
namespace {

constexpr double pi = 3.14159265358979323846;
template <int Dim>
constexpr std::array<const char*, material::stress_size<Dim>> stress_names{};
template <>
constexpr std::array<const char*, 4> stress_names<2>{ "stress_yy", "stress_zz", "stress_yz", "stress_xx" };
template <>
constexpr std::array<const char*, 6> stress_names<3>{ "stress_xx", "stress_yy", "stress_zz",
                                                      "stress_xy", "stress_xz", "stress_yz" };
template <int Dim>
using Stress = std::array<double, material::stress_size<Dim>>;

double cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

template <class Items>
std::size_t index_of(const Items& items, const std::string& name)
{
  std::size_t i = 0;
  for (const auto& item : items) {
    if (item.name == name)
      return i;
    ++i;
  }
  return i;
}

template <int Dim>
std::size_t boundary_index(const Model<Dim>& model, const std::string& name)
{
  std::size_t b = 0;
  while (b < model.boundaries().size() && model.boundaries()[b].name() != name)
    ++b;
  return b;
}

/// Weight that falls linearly to zero over one cell in every direction.
template <int Dim>
double hat(const Vec<Dim>& apart, double cell_size)
{
  double weight = 1.0;
  for (int d = 0; d < Dim; ++d)
    weight *= std::max(0.0, 1.0 - std::abs(apart[d]) / cell_size);
  return weight;
}

template <int Dim>
struct Extent {
  Vec<Dim> lower = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  void add(const Vec<Dim>& x)
  {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
};

}  // namespace

/// Columns are made by the first sample and filled by all.
template <int Dim>
struct Probes<Dim>::Row {
  ProbeFrame& series;
  std::size_t column = 0;

  void put(const std::string& name, const char* unit, double value)
  {
    if (column == series.columns.size())
      series.columns.push_back({ name, unit, {} });
    series.columns[column++].values.push_back(value);
  }
  void put(const std::string& name, const std::string& suffix, const char* unit, const Vec<Dim>& value)
  {
    if constexpr (Dim == 3)
      put(name + "_x_" + suffix, unit, value[0]);
    put(name + "_y_" + suffix, unit, value[y_axis<Dim>]);
    put(name + "_z_" + suffix, unit, value[z_axis<Dim>]);
  }
  void put(const Extent<Dim>& extent)
  {
    put("lower", "m", "m", extent.lower);
    put("upper", "m", "m", extent.upper);
  }
  void put_stress(const Stress<Dim>& stress)
  {
    for (std::size_t k = 0; k < stress.size(); ++k)
      put(fmt::format("{}_pa", stress_names<Dim>[k]), "Pa", stress[k]);
  }
};

template <int Dim>
Probes<Dim>::Probes(const SceneDescription& scene, Model<Dim>& model) : cell_size_(scene.grid.cell_size_m)
{
  for (const auto& [name, probe] : scene.probes) {
    Target target;
    target.probe = probe;
    ProbeFrame series;
    series.name = name;
    if (probe.point) {
      series.kind = "point";
      const std::size_t body = index_of(model.bodies(), probe.point->body);
      const mpm::Particles<Dim>& particles = model.bodies()[body].particles;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t p = 0; p < particles.size(); ++p)
        nearest = std::min(nearest, (particles.position_of(p) - in_space<Dim>(probe.point->at_m)).norm());
      if (nearest > cell_size_)
        throw InputError(
            scene.source, "probes." + name + ".point.at_m",
            fmt::format("[{}, {}]", probe.point->at_m[0], probe.point->at_m[1]),
            fmt::format("must lie in {}, whose nearest particle is {:.3g} m away", probe.point->body, nearest));
      target.index = model.add_tracer(body, in_space<Dim>(probe.point->at_m));
    } else if (probe.body) {
      series.kind = "body";
      target.index = index_of(model.bodies(), *probe.body);
    } else if (probe.section) {
      series.kind = "section";
    } else if (probe.geotextile) {
      series.kind = "geotextile";
      target.index = index_of(model.sheets(), probe.geotextile->geotextile);
      const mpm::Particles<Dim>& nodes = model.sheets()[target.index].sheet.nodes();
      if (probe.geotextile->at_m) {
        const Vec<Dim> at = in_space<Dim>(*probe.geotextile->at_m);
        for (std::size_t i = 1; i < nodes.size(); ++i)
          if ((nodes.position_of(i) - at).norm() < (nodes.position_of(target.node) - at).norm())
            target.node = i;
      }
    } else if (probe.surface) {
      series.kind = "surface";
      target.index = boundary_index(model, *probe.surface);
    } else {
      series.kind = "manufactured";
      target.index = index_of(model.bodies(), probe.manufactured.value());
    }
    targets_.push_back(std::move(target));
    series_.push_back(std::move(series));
  }
}

template <int Dim>
void Probes<Dim>::sample(const Model<Dim>& model, double time_s, const std::vector<double>& angle_rad)
{
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    Target& target = targets_[i];
    series_[i].time_s.push_back(time_s);
    Row row{ series_[i] };
    if (target.probe.point)
      sample_point(target, model, row);
    else if (target.probe.body)
      sample_body(target, model, row);
    else if (target.probe.section)
      sample_section(target, model, row);
    else if (target.probe.geotextile)
      sample_geotextile(target, model, row);
    else if (target.probe.surface)
      sample_surface(target, model, angle_rad[target.index], time_s, row);
    else
      sample_manufactured(target, model, time_s, row);
    target.last_s = time_s;
  }
}

template <int Dim>
void Probes<Dim>::close_frame()
{
  frame_begin_ = frame_end_;
  frame_end_ = series_.empty() ? 0 : series_.front().time_s.size();
}

template <int Dim>
std::vector<ProbeFrame> Probes<Dim>::of_frame() const
{
  const auto rows = [this](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(frame_begin_),
                               all.begin() + static_cast<std::ptrdiff_t>(frame_end_));
  };
  std::vector<ProbeFrame> parts;
  for (const ProbeFrame& series : series_) {
    ProbeFrame part{ series.name, series.kind, rows(series.time_s), {} };
    for (const ProbeFrame::Column& column : series.columns)
      part.columns.push_back({ column.name, column.unit, rows(column.values) });
    parts.push_back(std::move(part));
  }
  return parts;
}

template <int Dim>
void Probes<Dim>::sample_point(const Target& target, const Model<Dim>& model, Row& row) const
{
  const Tracer<Dim>& tracer = model.state().tracers[target.index];
  row.put("displacement", "m", "m", tracer.position - in_space<Dim>(target.probe.point->at_m));
  row.put("velocity", "m_per_s", "m/s", tracer.velocity);
  const mpm::Particles<Dim>& particles = model.bodies()[tracer.body].particles;
  Stress<Dim> stress{};
  double weight = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double w = particles.volume[p] * hat<Dim>(particles.position_of(p) - tracer.position, cell_size_);
    weight += w;
    for (std::size_t k = 0; k < stress.size(); ++k)
      stress[k] += w * particles.stress[k][p];
  }
  for (double& s : stress)
    s = weight > 0.0 ? s / weight : 0.0;
  row.put_stress(stress);
}

template <int Dim>
void Probes<Dim>::sample_body(Target& target, const Model<Dim>& model, Row& row) const
{
  const Body<Dim>& body = model.bodies()[target.index];
  const mpm::Particles<Dim>& particles = body.particles;
  Vec<Dim> moment = Vec<Dim>::Zero(), momentum = moment, start_moment = moment;
  double mass = 0.0, volume = 0.0, kinetic = 0.0, elastic = 0.0;
  Stress<Dim> stress{};
  Extent<Dim> extent;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double m = body.own_mass(p);
    mass += m;
    moment += m * body.position(p);
    start_moment += m * (*body.start)[particles.id[p]];
    momentum += m * body.velocity(p);
    kinetic += 0.5 * m * body.velocity(p).squaredNorm();
    elastic += particles.elastic_energy[p];
    volume += particles.volume[p];
    for (std::size_t k = 0; k < stress.size(); ++k)
      stress[k] += particles.volume[p] * particles.stress[k][p];
    extent.add(body.position(p));
  }
  for (double& s : stress)
    s /= volume;
  // The rotation that turns the start into the present best, by mass; followed over whole turns.
  double along = 0.0, across = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vec2 from = in_section((*body.start)[particles.id[p]] - start_moment / mass),
               to = in_section(body.position(p) - moment / mass);
    along += body.own_mass(p) * from.dot(to);
    across += body.own_mass(p) * cross(from, to);
  }
  target.turned_rad += std::remainder(std::atan2(across, along) - target.turned_rad, 2.0 * pi);

  row.put("centroid", "m", "m", moment / mass);
  row.put("velocity", "m_per_s", "m/s", momentum / mass);
  row.put("rotation_rad", "rad", target.turned_rad);
  row.put_stress(stress);
  row.put(Dim == 2 ? "volume_m2" : "volume_m3", Dim == 2 ? "m2" : "m3", volume);
  row.put(extent);
  row.put(Dim == 2 ? "kinetic_j_per_m" : "kinetic_j", Dim == 2 ? "J/m" : "J", kinetic);
  row.put(Dim == 2 ? "elastic_j_per_m" : "elastic_j", Dim == 2 ? "J/m" : "J", elastic);
}

/// The stress of a band one cell to either side of the cut, weighted by a hat across it, and the sheets that cross it.
template <int Dim>
void Probes<Dim>::sample_section(const Target& target, const Model<Dim>& model, Row& row) const
{
  if constexpr (Dim == 2) {
    const Vec2 from = target.probe.section->from_m, line = target.probe.section->to_m - from;
    const double length = line.norm();
    const Vec2 along = line / length, right(along[1], -along[0]);
    Vec2 force = Vec2::Zero();
    for (const Body<Dim>& body : model.bodies()) {
      const mpm::Particles<Dim>& particles = body.particles;
      for (std::size_t p = 0; p < particles.size(); ++p) {
        const Vec2 x = body.position(p) - from;
        const double across = std::abs(x.dot(right)), place = x.dot(along);
        if (across >= cell_size_ || place < 0.0 || place > length)
          continue;
        const double part = particles.volume[p] * (1.0 - across / cell_size_) / cell_size_;
        force += part * Vec2(particles.stress[0][p] * right[0] + particles.stress[2][p] * right[1],
                             particles.stress[2][p] * right[0] + particles.stress[1][p] * right[1]);
      }
    }
    for (const ModelSheet<Dim>& sheet : model.sheets())
      for (std::size_t i = 0; i < sheet.sheet.segments(); ++i) {
        const Vec2 a = sheet.sheet.node(i) - from, b = sheet.sheet.node(sheet.sheet.end_of(i)) - from;
        const double side_a = a.dot(right), side_b = b.dot(right);
        if ((side_a < 0.0) == (side_b < 0.0))
          continue;
        const Vec2 crossing = a + side_a / (side_a - side_b) * (b - a);
        if (crossing.dot(along) < 0.0 || crossing.dot(along) > length)
          continue;
        force += sheet.sheet.tension()[i] * (side_a < 0.0 ? b - a : a - b).normalized();
      }
    row.put("force", "n_per_m", "N/m", force);
  }
}

template <int Dim>
void Probes<Dim>::sample_geotextile(const Target& target, const Model<Dim>& model, Row& row) const
{
  if constexpr (Dim == 2) {
    const geotextile::Sheet& sheet = model.sheets()[target.index].sheet;
    std::vector<double> gauge;
    sheet.gauge_tension(gauge);
    double sum = 0.0;
    Extent<Dim> extent;
    for (const double tension : sheet.tension())
      sum += tension;
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i)
      extent.add(sheet.node(i));
    row.put("tension_max_n_per_m", "N/m", *std::max_element(gauge.begin(), gauge.end()));
    row.put("tension_mean_n_per_m", "N/m", sum / static_cast<double>(sheet.segments()));
    row.put("length_m", "m", sheet.length());
    row.put("area_m2", "m2", sheet.enclosed_area());
    row.put(extent);
    if (target.probe.geotextile->at_m) {
      row.put("point", "m", "m", sheet.node(target.node));
      // Mean of the segments that meet at the node.
      const std::size_t after = std::min(target.node, gauge.size() - 1);
      const std::size_t before = target.node > 0 ? target.node - 1 : sheet.closed() ? gauge.size() - 1 : 0;
      row.put("point_tension_n_per_m", "N/m", 0.5 * (gauge[before] + gauge[after]));
    }
  }
}

/// Force and moment of the material on the surface, mean since the last sample.
template <int Dim>
void Probes<Dim>::sample_surface(Target& target, const Model<Dim>& model, double angle_rad, double time_s,
                                 Row& row) const
{
  const BoundaryTotal<Dim>& total = model.state().boundary_totals[target.index];
  const double length = time_s - target.last_s, per_time = length > 0.0 ? -1.0 / length : 0.0;
  row.put("force", Dim == 2 ? "n_per_m" : "n", Dim == 2 ? "N/m" : "N",
          per_time * (total.impulse - target.last.impulse));
  row.put(Dim == 2 ? "moment_n" : "moment_n_m", Dim == 2 ? "N" : "N m", per_time * (total.moment - target.last.moment));
  row.put("angle_rad", "rad", angle_rad);
  row.put(Dim == 2 ? "work_j_per_m" : "work_j", Dim == 2 ? "J/m" : "J", total.work);
  target.last = total;
}

template <int Dim>
void Probes<Dim>::sample_manufactured(const Target& target, const Model<Dim>& model, double time_s, Row& row) const
{
  if constexpr (Dim == 2) {
    const Body<Dim>& body = model.bodies()[target.index];
    double square = 0.0, largest = 0.0;
    for (std::size_t p = 0; p < body.particles.size(); ++p) {
      const Vec2 exact = body.manufactured->position((*body.start)[body.particles.id[p]], time_s);
      const double error = (body.position(p) - exact).squaredNorm();
      square += error;
      largest = std::max(largest, error);
    }
    row.put("error_rms_m", "m", std::sqrt(square / static_cast<double>(body.particles.size())));
    row.put("error_max_m", "m", std::sqrt(largest));
  }
}

template class Probes<2>;
template class Probes<3>;

}  // namespace geocontainer_mpm::scene
