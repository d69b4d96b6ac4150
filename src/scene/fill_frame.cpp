#include "fill_frame.h"

#include <algorithm>

namespace geocontainer_mpm::scene {
namespace {

/// In plane strain particles keep yy, zz, yz, xx.
SymmetricTensor barge_stress(const mpm::Particles<2>& particles, std::size_t p)
{
  const auto s = [&](std::size_t k) { return particles.stress[k][p]; };
  return { s(3), s(0), s(1), 0.0, 0.0, s(2) };
}
SymmetricTensor barge_stress(const mpm::Particles<3>& particles, std::size_t p)
{
  SymmetricTensor stress;
  for (std::size_t k = 0; k < stress.size(); ++k)
    stress[k] = particles.stress[k][p];
  return stress;
}

void fill_pieces(const geotextile::Sheet& sheet, GeotextileFrame& frame)
{
  sheet.gauge_tension(frame.gauge_tension);
}

void fill_pieces(const geotextile::Membrane& sheet, GeotextileFrame& frame)
{
  frame.triangles = sheet.triangles();
  sheet.gauge_tension(frame.warp_tension, frame.weft_tension);
  for (std::size_t t = 0; t < frame.triangles.size(); ++t)
    frame.gauge_tension.push_back(std::max(frame.warp_tension[t], frame.weft_tension[t]));
}

}  // namespace

template <int Dim>
void fill_frame(const Model<Dim>& model, const SceneDescription& scene, const std::vector<Vec<Dim>>& boundary_force,
                Frame& frame)
{
  for (const Body<Dim>& body : model.bodies()) {
    const mpm::Particles<Dim>& particles = body.particles;
    SoilFrame soil;
    soil.name = body.name;
    const std::size_t n = particles.size();
    soil.position.resize(n);
    soil.velocity.resize(n);
    soil.stress.resize(n);
    soil.volume.resize(n);
    for (std::size_t p = 0; p < n; ++p) {
      const std::size_t row = particles.id[p];  // order of creation, so that a row is one particle in every frame
      soil.position[row] = in_barge_frame(particles.position_of(p));
      soil.velocity[row] = in_barge_frame(particles.velocity_of(p));
      soil.stress[row] = barge_stress(particles, p);
      soil.volume[row] = particles.volume[p];
    }
    frame.soil.push_back(std::move(soil));
  }
  for (const ModelSheet<Dim>& enclosing : model.sheets()) {
    const SheetOf<Dim>& sheet = enclosing.sheet;
    const GeotextileDescription& description = scene.geotextiles.at(enclosing.name);
    GeotextileFrame geotextile;
    geotextile.name = enclosing.name;
    geotextile.closed = sheet.closed();
    for (std::size_t i = 0; i < sheet.nodes().size(); ++i) {
      geotextile.node.push_back(in_barge_frame(sheet.node(i)));
      geotextile.velocity.push_back(in_barge_frame(sheet.nodes().velocity_of(i)));
    }
    geotextile.tension = sheet.tension();
    fill_pieces(sheet, geotextile);
    geotextile.gauge_length_m = description.gauge_length_m;
    geotextile.strength_n_per_m = description.strength_n_per_m;
    geotextile.seam_strength_n_per_m = enclosing.strength.weakest_seam();
    frame.geotextile.push_back(std::move(geotextile));
  }
  for (std::size_t b = 0; b < model.boundaries().size(); ++b) {
    const contact::BoundaryBody<Dim>& body = model.boundaries()[b];
    BoundaryFrame boundary;
    boundary.name = body.name();
    for (std::size_t p = 0; p < body.size(); ++p)
      boundary.position.push_back(in_barge_frame(body.reference(p)));
    boundary.force = in_barge_frame(boundary_force[b]);
    boundary.closed = body.closed();
    boundary.triangles = body.triangles();
    frame.boundary.push_back(std::move(boundary));
  }
}

template void fill_frame(const Model<2>&, const SceneDescription&, const std::vector<Vec2>&, Frame&);
template void fill_frame(const Model<3>&, const SceneDescription&, const std::vector<Vec3>&, Frame&);

}  // namespace geocontainer_mpm::scene
