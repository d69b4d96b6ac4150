#include <cstdint>

#include "geocontainer_mpm/record/recorder.h"
#include "recorder_fixture.h"
#include "synthetic_frame.h"

namespace geocontainer_mpm::record {
namespace {

/// Corners of triangles, as rows of the shared arrays of a group in which they start at `first`.
std::vector<double> corners(const std::vector<scene::Triangle>& triangles, std::uint32_t first = 0)
{
  std::vector<double> result;
  for (const scene::Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle)
      result.push_back(first + corner);
  return result;
}

TEST_F(RecorderTest, KeepsThreeDimensionalFrames)
{
  const scene::Frame frame = synthetic_solid_frame(28.5, 2);
  {
    Recorder recorder(path("solid.h5"), "solid", "");
    ASSERT_EQ(recorder.write(frame), "");
  }
  const Reader reader(path("solid.h5"));
  const std::string at = "/frames/000000";
  EXPECT_EQ(reader.number_attribute(at, "dimensions"), std::vector<double>{ 3.0 });

  const scene::SoilFrame& soil = frame.soil.front();
  EXPECT_EQ(reader.numbers(at + "/soil/position"), rows(soil.position));
  EXPECT_NE(reader.numbers(at + "/soil/position")[0], 0.0);
  const std::vector<double> stress = reader.numbers(at + "/soil/stress");
  const auto& [xx, yy, zz, xy, xz, yz] = soil.stress.back();
  EXPECT_NE(xy, 0.0);
  EXPECT_NE(xy, xz);
  EXPECT_EQ(singles({ stress.end() - 6, stress.end() }), singles({ xx, xy, xz, yy, yz, zz }));
  EXPECT_EQ(reader.text_attribute(at + "/soil/volume", "units"), "m^3");

  const scene::GeotextileFrame& sheet = frame.geotextile.front();
  EXPECT_EQ(reader.numbers(at + "/geotextile/node"), rows(sheet.node));
  ASSERT_EQ(reader.extent(at + "/geotextile/connectivity"), (Extent{ sheet.triangles.size(), 3 }));
  EXPECT_EQ(reader.numbers(at + "/geotextile/connectivity"), corners(sheet.triangles));
  EXPECT_EQ(reader.number_attribute(at + "/geotextile", "segment_count"),
            std::vector<double>{ static_cast<double>(sheet.triangles.size()) });
  EXPECT_EQ(singles(reader.numbers(at + "/geotextile/gauge_tension")), singles(sheet.gauge_tension));
  EXPECT_EQ(singles(reader.numbers(at + "/geotextile/warp_tension")), singles(sheet.warp_tension));
  EXPECT_EQ(singles(reader.numbers(at + "/geotextile/weft_tension")), singles(sheet.weft_tension));
  EXPECT_EQ(reader.text_attribute(at + "/geotextile/weft_tension", "units"), "N/m");

  // The starboard half's triangles lead to its own rows.
  std::vector<double> hull = corners(frame.boundary[0].triangles);
  const auto rows_of_port = static_cast<std::uint32_t>(frame.boundary[0].position.size());
  const std::vector<double> starboard = corners(frame.boundary[1].triangles, rows_of_port);
  hull.insert(hull.end(), starboard.begin(), starboard.end());
  EXPECT_EQ(reader.numbers(at + "/hull/connectivity"), hull);
  EXPECT_EQ(reader.numbers(at + "/hull/force"), rows({ frame.boundary[0].force, frame.boundary[1].force }));
  EXPECT_EQ(reader.text_attribute(at + "/hull/force", "units"), "N");

  EXPECT_EQ(reader.number_attribute(at + "/energy", "kinetic_j"), std::vector<double>{ frame.energy.kinetic });
  EXPECT_EQ(reader.number_attribute(at + "/status", "length_m"), std::vector<double>{ 8.0 });
  EXPECT_EQ(reader.number_attribute(at + "/status", "soil_volume_m3"), std::vector<double>{ frame.status.soil_volume });
  EXPECT_EQ(reader.number_attribute(at + "/status", "peak_tension_position_m"),
            rows({ frame.status.peak_tension_position_m }));

  const std::string xml = file_text(path("solid.xdmf"));
  for (const std::size_t count : { sheet.triangles.size(), hull.size() / 3, frame.boundary[2].triangles.size() })
    EXPECT_NE(xml.find("TopologyType=\"Triangle\" NumberOfElements=\"" + std::to_string(count) + "\""),
              std::string::npos);
  EXPECT_NE(xml.find("Dimensions=\"" + std::to_string(sheet.triangles.size()) + " 3\">solid.h5:" + at +
                     "/geotextile/connectivity"),
            std::string::npos);
  EXPECT_EQ(xml.find("Polyline"), std::string::npos);
  EXPECT_NE(xml.find("warp_tension"), std::string::npos);
}

TEST_F(RecorderTest, ALineAmongTrianglesIsOfTrianglesWithTwoCornersInOnePlace)
{
  scene::Frame frame = synthetic_solid_frame(1.0, 1);
  const scene::GeotextileFrame line = synthetic_frame(1.0, 1).geotextile.front();
  frame.geotextile.push_back(line);
  {
    Recorder recorder(path("mixed.h5"), "mixed", "");
    ASSERT_EQ(recorder.write(frame), "");
  }
  const Reader reader(path("mixed.h5"));
  const std::string sheets = "/frames/000000/geotextile";
  const std::size_t triangles = frame.geotextile[0].triangles.size(), segments = line.tension.size();
  ASSERT_EQ(reader.extent(sheets + "/connectivity"), (Extent{ triangles + segments, 3 }));
  ASSERT_EQ(reader.extent(sheets + "/tension"), (Extent{ triangles + segments }));
  EXPECT_FALSE(reader.has(sheets + "/warp_tension"));  // the line has none
  const std::vector<double> pieces = reader.numbers(sheets + "/connectivity");
  const auto first = static_cast<double>(frame.geotextile[0].node.size());
  for (std::size_t i = 0; i < segments; ++i) {
    EXPECT_EQ(pieces[3 * (triangles + i)], first + static_cast<double>(i));
    EXPECT_EQ(pieces[3 * (triangles + i) + 1], pieces[3 * (triangles + i) + 2]);
  }
  EXPECT_EQ(pieces.back(), first);
}

}  // namespace
}  // namespace geocontainer_mpm::record
