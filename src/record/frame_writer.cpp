#include "frame_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "frame_parts.h"

namespace geocontainer_mpm::record {

namespace {

Handle dataspace(std::initializer_list<hsize_t> extent)
{
  if (extent.size() == 0)
    return { H5Screate(H5S_SCALAR), H5Sclose, "cannot describe a scalar" };
  return { H5Screate_simple(static_cast<int>(extent.size()), extent.begin(), nullptr), H5Sclose,
           "cannot describe an array" };
}

Handle text_type(std::size_t length)
{
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "cannot describe a text");
  checked(H5Tset_size(type, std::max<std::size_t>(length, 1)), "cannot describe a text");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "cannot describe a text");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "cannot describe a text");
  return type;
}

void write_attribute(hid_t object, const char* name, hid_t type, hid_t memory_type, hid_t space, const void* data)
{
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "cannot create an attribute");
  checked(H5Awrite(attribute, memory_type, data), "cannot write an attribute");
}

void write_number(hid_t object, const char* name, double value)
{
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, dataspace({}), &value);
}

void write_count(hid_t object, const char* name, std::int64_t value)
{
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, dataspace({}), &value);
}

void write_point(hid_t object, const char* name, const Vec3& point)
{
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, dataspace({ 3 }), point.data());
}

void write_numbers(hid_t object, const char* name, const std::vector<double>& values)
{
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, dataspace({ values.size() }), values.data());
}

void write_counts(hid_t object, const char* name, const std::vector<std::int64_t>& values)
{
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, dataspace({ values.size() }), values.data());
}

void write_texts(hid_t object, const char* name, const std::vector<std::string>& texts)
{
  std::size_t width = 1;
  for (const std::string& text : texts)
    width = std::max(width, text.size());
  std::string packed(width * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i].copy(&packed[i * width], width);
  const Handle type = text_type(width);
  write_attribute(object, name, type, type, dataspace({ texts.size() }), packed.data());
}

/// Which rows of a group's arrays belong to which of its named parts.
void write_parts(hid_t group, const Parts& parts)
{
  write_texts(group, "name", parts.name);
  write_counts(group, "first", parts.first);
  write_counts(group, "count", parts.count);
}

Handle subgroup(hid_t parent, const char* name)
{
  return { H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "cannot create a group" };
}

/// Writes one array with its unit; `compact` for a few numbers that are not worth a place of their own.
void write_array(hid_t parent, const char* name, hid_t type, hid_t memory_type, std::initializer_list<hsize_t> extent,
                 const void* data, const char* units, bool compact = false)
{
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "cannot describe a data set");
  checked(H5Pset_layout(properties, compact ? H5D_COMPACT : H5D_CONTIGUOUS), "cannot describe a data set");
  checked(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), "cannot describe a data set");
  const Handle set(H5Dcreate2(parent, name, type, dataspace(extent), H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                   "cannot create a data set");
  checked(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot write a data set");
  write_text_attribute(set, "units", units);
}

template <typename Part>
std::vector<double> rows_of_three(const std::vector<const Part*>& parts, std::vector<Vec3> Part::*field)
{
  std::vector<double> rows;
  for (const Part* part : parts)
    for (const Vec3& point : part->*field)
      rows.insert(rows.end(), point.begin(), point.end());
  return rows;
}

template <typename Part>
std::vector<double> joined(const std::vector<const Part*>& parts, std::vector<double> Part::*field)
{
  std::vector<double> all;
  for (const Part* part : parts)
    all.insert(all.end(), (part->*field).begin(), (part->*field).end());
  return all;
}

void write_vectors(hid_t group, const char* name, hid_t type, const std::vector<double>& rows, const char* units)
{
  write_array(group, name, type, H5T_NATIVE_DOUBLE, { rows.size() / 3, 3 }, rows.data(), units);
}

void write_scalars(hid_t group, const char* name, const std::vector<double>& values, const char* units)
{
  write_array(group, name, H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, { values.size() }, values.data(), units);
}

void write_indices(hid_t group, const char* name, const std::vector<std::int32_t>& values, hsize_t columns)
{
  if (columns == 1)
    write_array(group, name, H5T_STD_I32LE, H5T_NATIVE_INT32, { values.size() }, values.data(), "1");
  else
    write_array(group, name, H5T_STD_I32LE, H5T_NATIVE_INT32, { values.size() / columns, columns }, values.data(), "1");
}

/// Then volumes are in m^3 instead of m^2, forces in N instead of N/m, energies in J instead of J/m.
bool is_3d(const scene::Frame& frame)
{
  return frame.status.dimensions == 3;
}

void write_soil(hid_t frame_group, const scene::Frame& frame)
{
  const auto bodies = soil_of(frame);
  if (bodies.empty())
    return;
  const Parts parts = parts_of(bodies, &scene::SoilFrame::position);
  const Handle group = subgroup(frame_group, "soil");
  write_parts(group, parts);
  write_vectors(group, "position", H5T_IEEE_F64LE, rows_of_three(bodies, &scene::SoilFrame::position), "m");
  write_vectors(group, "velocity", H5T_IEEE_F32LE, rows_of_three(bodies, &scene::SoilFrame::velocity), "m/s");

  // XDMF's and VTK's order of a symmetric tensor: xx xy xz yy yz zz.
  std::vector<double> stress;
  for (const scene::SoilFrame* body : bodies)
    for (const auto& [xx, yy, zz, xy, xz, yz] : body->stress)
      stress.insert(stress.end(), { xx, xy, xz, yy, yz, zz });
  write_array(group, "stress", H5T_IEEE_F32LE, H5T_NATIVE_DOUBLE, { stress.size() / 6, 6 }, stress.data(), "Pa");
  write_scalars(group, "volume", joined(bodies, &scene::SoilFrame::volume), is_3d(frame) ? "m^3" : "m^2");
  write_indices(group, "body", part_of_row(parts), 1);
}

void write_geotextile(hid_t frame_group, const scene::Frame& frame)
{
  const auto sheets = geotextile_of(frame);
  if (sheets.empty())
    return;
  const Parts parts = parts_of(sheets, &scene::GeotextileFrame::node);
  const Handle group = subgroup(frame_group, "geotextile");
  write_parts(group, parts);
  const Pieces pieces = pieces_of(sheets, parts);
  std::vector<double> gauge_length, strength, seam_strength;
  std::vector<std::int64_t> closed;
  for (const scene::GeotextileFrame* sheet : sheets) {
    closed.push_back(sheet->closed ? 1 : 0);
    gauge_length.push_back(sheet->gauge_length_m);
    strength.push_back(sheet->strength_n_per_m);
    seam_strength.push_back(sheet->seam_strength_n_per_m);
  }
  write_counts(group, "closed", closed);
  write_counts(group, "first_segment", pieces.first);
  write_counts(group, "segment_count", pieces.count);
  write_numbers(group, "gauge_length_m", gauge_length);
  write_numbers(group, "strength_n_per_m", strength);
  write_numbers(group, "seam_strength_n_per_m", seam_strength);
  write_vectors(group, "node", H5T_IEEE_F64LE, rows_of_three(sheets, &scene::GeotextileFrame::node), "m");
  write_vectors(group, "velocity", H5T_IEEE_F32LE, rows_of_three(sheets, &scene::GeotextileFrame::velocity), "m/s");
  write_scalars(group, "tension", joined(sheets, &scene::GeotextileFrame::tension), "N/m");
  write_scalars(group, "gauge_tension", joined(sheets, &scene::GeotextileFrame::gauge_tension), "N/m");
  if (has_directions(sheets)) {
    write_scalars(group, "warp_tension", joined(sheets, &scene::GeotextileFrame::warp_tension), "N/m");
    write_scalars(group, "weft_tension", joined(sheets, &scene::GeotextileFrame::weft_tension), "N/m");
  }
  write_indices(group, "connectivity", pieces.rows, static_cast<hsize_t>(pieces.corners));
  write_indices(group, "sheet", part_of_row(parts), 1);
}

void write_boundary(hid_t frame_group, const char* name, const std::vector<const scene::BoundaryFrame*>& boundaries,
                    const char* force_unit)
{
  if (boundaries.empty())
    return;
  const Parts parts = parts_of(boundaries, &scene::BoundaryFrame::position);
  const Handle group = subgroup(frame_group, name);
  write_parts(group, parts);
  std::vector<double> angle, force;
  std::vector<std::int64_t> closed;
  for (const scene::BoundaryFrame* boundary : boundaries) {
    closed.push_back(boundary->closed ? 1 : 0);
    angle.push_back(boundary->angle_rad);
    force.insert(force.end(), boundary->force.begin(), boundary->force.end());
  }
  write_counts(group, "closed", closed);
  write_vectors(group, "position", H5T_IEEE_F64LE, rows_of_three(boundaries, &scene::BoundaryFrame::position), "m");
  const Pieces pieces = pieces_of(boundaries, parts);
  write_indices(group, "connectivity", pieces.rows, static_cast<hsize_t>(pieces.corners));
  write_array(group, "angle", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, { angle.size() }, angle.data(), "rad");
  write_vectors(group, "force", H5T_IEEE_F64LE, force, force_unit);
}

/// One group for each probe, empty arrays where it took no sample since the frame before.
void write_probes(hid_t frame_group, const std::vector<scene::ProbeFrame>& probes)
{
  constexpr std::size_t few = 64;
  if (probes.empty())
    return;
  const Handle all = subgroup(frame_group, "probes");
  for (const scene::ProbeFrame& probe : probes) {
    const Handle group = subgroup(all, probe.name.c_str());
    write_text_attribute(group, "kind", probe.kind);
    const auto write = [&](const char* name, const std::vector<double>& values, const std::string& unit) {
      write_array(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, { values.size() }, values.data(), unit.c_str(),
                  values.size() <= few);
    };
    write("time", probe.time_s, "s");
    for (const scene::ProbeFrame::Column& column : probe.columns)
      write(column.name.c_str(), column.values, column.unit);
  }
}

void write_energy(hid_t frame_group, const scene::Frame& frame)
{
  const scene::EnergyFrame& energy = frame.energy;
  const Handle group = subgroup(frame_group, "energy");
  const auto write = [&](const char* name, double value) {
    write_number(group, (std::string(name) + (is_3d(frame) ? "_j" : "_j_per_m")).c_str(), value);
  };
  write("kinetic", energy.kinetic);
  write("elastic", energy.elastic);
  write("potential", energy.potential);
  write("dissipated", energy.dissipated);
  write("dissipated_plastic", energy.dissipated_plastic);
  write("dissipated_contact", energy.dissipated_contact);
  write("dissipated_transfer", energy.dissipated_transfer);
  write("dissipated_rupture", energy.dissipated_rupture);
  write("dissipated_water", energy.dissipated_water);
  write("work_in", energy.work_in);
  write_number(group, "relative_balance_error", energy.relative_balance_error);
}

void write_status(hid_t frame_group, const scene::Frame& frame)
{
  const scene::StatusFrame& status = frame.status;
  const Handle group = subgroup(frame_group, "status");
  write_text_attribute(group, "outcome", scene::to_string(status.outcome));
  write_number(group, "release_time_s", status.release_time_s);
  write_count(group, "resting", status.resting ? 1 : 0);
  write_number(group, "peak_tension_n_per_m", status.peak_tension_n_per_m);
  write_number(group, "peak_tension_time_s", status.peak_tension_time_s);
  write_point(group, "peak_tension_position_m", status.peak_tension_position_m);
  write_number(group, "current_tension_n_per_m", status.current_tension_n_per_m);
  write_number(group, "elongation_max", status.elongation_max);
  write_point(group, "centroid_m", status.centroid_m);
  write_number(group, "width_m", status.width_m);
  write_number(group, "height_m", status.height_m);
  write_number(group, "length_m", status.length_m);
  write_number(group, is_3d(frame) ? "soil_volume_m3" : "soil_volume_m2", status.soil_volume);
  write_number(group, is_3d(frame) ? "soil_volume_initial_m3" : "soil_volume_initial_m2", status.soil_volume_initial);
}

}  // namespace

void write_text_attribute(hid_t object, const char* name, const std::string& text)
{
  const Handle type = text_type(text.size());
  write_attribute(object, name, type, type, dataspace({}), text.c_str());
}

void write_text(hid_t parent, const char* name, const std::string& text)
{
  const Handle type = text_type(text.size());
  const Handle set(H5Dcreate2(parent, name, type, dataspace({}), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                   "cannot create a data set");
  checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "cannot write a data set");
}

std::size_t room_for(const scene::Frame& frame)
{
  // Per row or triangle at most three doubles, nine floats and three indices; the groups' own data is about 20 kB.
  constexpr std::size_t row_bytes = 3 * 8 + 9 * 4 + 3 * 4 + 16;
  constexpr std::size_t part_bytes = 256, group_bytes = 48 * 1024;
  std::size_t rows = 0, names = 0;
  const auto add = [&](std::size_t size, const std::string& name) {
    rows += size;
    names = std::max(names, name.size());
  };
  for (const scene::SoilFrame& body : frame.soil)
    add(body.position.size(), body.name);
  for (const scene::GeotextileFrame& sheet : frame.geotextile)
    add(sheet.node.size() + sheet.triangles.size(), sheet.name);
  for (const scene::BoundaryFrame& boundary : frame.boundary)
    add(boundary.position.size() + boundary.triangles.size(), boundary.name);
  const std::size_t parts = frame.soil.size() + frame.geotextile.size() + frame.boundary.size();
  // Each column is a data set of its own, with a header and a link; each probe a group.
  constexpr std::size_t column_bytes = 1024, probe_bytes = 4096;
  std::size_t probes = 0;
  for (const scene::ProbeFrame& probe : frame.probes) {
    probes += probe_bytes + probe.name.size() + column_bytes + probe.time_s.size() * sizeof(double);
    for (const scene::ProbeFrame::Column& column : probe.columns)
      probes += column_bytes + column.name.size() + column.values.size() * sizeof(double);
  }
  return group_bytes + rows * row_bytes + parts * (part_bytes + names) + probes;
}

Handle write_unlinked_frame(hid_t file, const scene::Frame& frame)
{
  Handle group(H5Gcreate_anon(file, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "cannot create a frame");
  write_number(group, "time_s", frame.time_s);
  write_count(group, "dimensions", frame.status.dimensions);
  write_count(group, "stamp_ns", frame.stamp_ns);
  write_count(group, "step", static_cast<std::int64_t>(frame.step));
  write_number(group, "dt_s", frame.dt_s);
  if (frame.water_level_m)
    write_number(group, "water_level_m", *frame.water_level_m);
  write_number(group, "port_rad", frame.opening.port_rad);
  write_number(group, "starboard_rad", frame.opening.starboard_rad);
  write_array(group, "time", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &frame.time_s, "s", true);
  write_soil(group, frame);
  write_geotextile(group, frame);
  const char* force_unit = is_3d(frame) ? "N" : "N/m";
  write_boundary(group, "hull", hull_of(frame), force_unit);
  write_boundary(group, "surface", surfaces_of(frame), force_unit);
  write_probes(group, frame.probes);
  write_energy(group, frame);
  write_status(group, frame);
  return group;
}

}  // namespace geocontainer_mpm::record
