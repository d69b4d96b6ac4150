#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/record/recorder.h"
#include "recorder_fixture.h"
#include "synthetic_frame.h"

namespace geocontainer_mpm::record {
namespace {

TEST_F(RecorderTest, KeepsEveryFieldOfAFrame)
{
  const scene::Frame frame = synthetic_frame(26.3, 8);
  {
    Recorder recorder(path("run.h5"), "release", "name: release\n");
    ASSERT_EQ(recorder.write(frame), "");
    EXPECT_EQ(recorder.frames(), 1u);
  }
  const Reader reader(path("run.h5"));
  EXPECT_EQ(reader.text_attribute("/", "scene_name"), "release");
  EXPECT_EQ(reader.text("/scene"), "name: release\n");
  const std::string at = "/frames/000000";
  EXPECT_EQ(reader.numbers(at + "/time"), std::vector<double>{ 26.3 });
  EXPECT_EQ(reader.text_attribute(at + "/time", "units"), "s");
  EXPECT_EQ(reader.number_attribute(at, "step"), std::vector<double>{ 26300.0 });
  EXPECT_EQ(reader.number_attribute(at, "port_rad"), std::vector<double>{ frame.opening.port_rad });

  const scene::SoilFrame& soil = frame.soil.front();
  EXPECT_EQ(reader.numbers(at + "/soil/position"), rows(soil.position));
  EXPECT_EQ(reader.extent(at + "/soil/position"), (Extent{ soil.position.size(), 3 }));
  EXPECT_EQ(reader.text_attribute(at + "/soil/position", "units"), "m");
  EXPECT_EQ(singles(reader.numbers(at + "/soil/velocity")), singles(rows(soil.velocity)));
  EXPECT_EQ(singles(reader.numbers(at + "/soil/volume")), singles(soil.volume));
  const std::vector<double> stress = reader.numbers(at + "/soil/stress");
  ASSERT_EQ(reader.extent(at + "/soil/stress"), (Extent{ soil.stress.size(), 6 }));
  const auto& [xx, yy, zz, xy, xz, yz] = soil.stress.back();
  EXPECT_EQ(singles({ stress.end() - 6, stress.end() }), singles({ xx, xy, xz, yy, yz, zz }));

  const scene::GeotextileFrame& sheet = frame.geotextile.front();
  EXPECT_EQ(reader.numbers(at + "/geotextile/node"), rows(sheet.node));
  EXPECT_EQ(singles(reader.numbers(at + "/geotextile/tension")), singles(sheet.tension));
  EXPECT_EQ(singles(reader.numbers(at + "/geotextile/gauge_tension")), singles(sheet.gauge_tension));
  EXPECT_EQ(reader.number_attribute(at + "/geotextile", "seam_strength_n_per_m"), std::vector<double>{ 102e3 });
  const std::vector<double> pairs = reader.numbers(at + "/geotextile/connectivity");
  ASSERT_EQ(pairs.size(), 2 * sheet.node.size());
  EXPECT_EQ(pairs[pairs.size() - 2], static_cast<double>(sheet.node.size() - 1));
  EXPECT_EQ(pairs.back(), 0.0);  // the last segment closes the sheet

  EXPECT_EQ(reader.numbers(at + "/hull/angle"), (std::vector<double>(2, frame.opening.port_rad)));
  std::vector<double> force = rows({ frame.boundary[0].force, frame.boundary[1].force });
  EXPECT_EQ(reader.numbers(at + "/hull/force"), force);
  EXPECT_EQ(reader.numbers(at + "/surface/position"), rows(frame.boundary[2].position));
  EXPECT_EQ(reader.text_attribute(at + "/status", "outcome"), "releasing");
  EXPECT_EQ(reader.number_attribute(at + "/status", "centroid_m"), rows({ frame.status.centroid_m }));
  EXPECT_EQ(reader.number_attribute(at + "/energy", "kinetic_j_per_m"), std::vector<double>{ frame.energy.kinetic });
}

TEST_F(RecorderTest, LaysSeveralBodiesAndSheetsEndToEnd)
{
  scene::Frame frame = synthetic_frame(1.0, 3);
  const scene::Frame other = synthetic_frame(30.0, 5);
  frame.soil.push_back(other.soil.front());
  frame.soil.back().name = "second fill";
  frame.geotextile.push_back(other.geotextile.front());
  frame.geotextile.back().name = "second bag";
  {
    Recorder recorder(path("two.h5"), "two", "");
    ASSERT_EQ(recorder.write(frame), "");
  }
  const Reader reader(path("two.h5"));
  const std::string soil = "/frames/000000/soil", sheet = "/frames/000000/geotextile";
  const double first = static_cast<double>(frame.soil[0].position.size());
  EXPECT_EQ(reader.number_attribute(soil, "first"), (std::vector<double>{ 0.0, first }));
  EXPECT_EQ(reader.number_attribute(soil, "count").back(), static_cast<double>(other.soil[0].position.size()));
  EXPECT_EQ(reader.text_attribute(soil, "name"), std::string("fill\0\0\0\0\0\0\0second fill", 22));
  const std::vector<double> body = reader.numbers(soil + "/body");
  EXPECT_EQ(std::accumulate(body.begin(), body.end(), 0.0), static_cast<double>(other.soil[0].position.size()));
  const std::vector<double> position = reader.numbers(soil + "/position");
  const std::vector<double> expected = rows(other.soil[0].position);
  EXPECT_TRUE(std::equal(expected.rbegin(), expected.rend(), position.rbegin()));

  // Each sheet closes on itself: every node begins one segment and ends one, and no segment joins the two sheets.
  const std::vector<double> pairs = reader.numbers(sheet + "/connectivity");
  const double nodes = static_cast<double>(frame.geotextile[0].node.size());
  ASSERT_EQ(pairs.size(), static_cast<std::size_t>(4 * nodes));
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    EXPECT_EQ(pairs[i] < nodes, pairs[i + 1] < nodes) << i;
  EXPECT_EQ(pairs[pairs.size() - 1], nodes);
}

TEST_F(RecorderTest, AnOpenSheetHasOneSegmentLessThanNodes)
{
  scene::Frame frame = synthetic_frame(1.0, 1);
  scene::GeotextileFrame cable = frame.geotextile.front();
  cable.name = "cable";
  cable.closed = false;
  cable.tension.pop_back();
  cable.gauge_tension.pop_back();
  frame.geotextile.insert(frame.geotextile.begin(), cable);
  {
    Recorder recorder(path("open.h5"), "open", "");
    ASSERT_EQ(recorder.write(frame), "");
  }
  const Reader reader(path("open.h5"));
  const std::string sheet = "/frames/000000/geotextile";
  const auto nodes = static_cast<double>(cable.node.size());
  EXPECT_EQ(reader.number_attribute(sheet, "closed"), (std::vector<double>{ 0.0, 1.0 }));
  EXPECT_EQ(reader.number_attribute(sheet, "first_segment"), (std::vector<double>{ 0.0, nodes - 1.0 }));
  EXPECT_EQ(reader.number_attribute(sheet, "segment_count"), (std::vector<double>{ nodes - 1.0, nodes }));
  const std::vector<double> pairs = reader.numbers(sheet + "/connectivity");
  ASSERT_EQ(pairs.size(), static_cast<std::size_t>(2.0 * (2.0 * nodes - 1.0)));
  const std::size_t end = 2 * (cable.node.size() - 1);  // where the closed sheet begins
  EXPECT_EQ(pairs[end - 2], nodes - 2.0);
  EXPECT_EQ(pairs[end - 1], nodes - 1.0);
  EXPECT_EQ(pairs[end], nodes);
  EXPECT_EQ(pairs[pairs.size() - 2], 2.0 * nodes - 1.0);
  EXPECT_EQ(pairs.back(), nodes);
  EXPECT_EQ(reader.extent(sheet + "/tension"), (Extent{ 2 * cable.node.size() - 1 }));
  const std::string xml = file_text(path("open.xdmf"));
  EXPECT_NE(xml.find("NumberOfElements=\"" + std::to_string(2 * cable.node.size() - 1) + "\""), std::string::npos);
}

TEST_F(RecorderTest, ClosesTheLineOfAClosedSurface)
{
  scene::Frame frame = synthetic_frame(1.0, 1);
  frame.boundary.back().closed = true;
  {
    Recorder recorder(path("roller.h5"), "roller", "");
    ASSERT_EQ(recorder.write(frame), "");
  }
  const Reader reader(path("roller.h5"));
  const std::vector<double> pairs = reader.numbers("/frames/000000/surface/connectivity");
  EXPECT_EQ(pairs.size(), 2 * frame.boundary.back().position.size());
  EXPECT_EQ(pairs.back(), 0.0);
  EXPECT_EQ(reader.number_attribute("/frames/000000/surface", "closed"), std::vector<double>{ 1.0 });
  EXPECT_EQ(reader.number_attribute("/frames/000000/hull", "closed"), (std::vector<double>{ 0.0, 0.0 }));
}

TEST_F(RecorderTest, KeepsTheSamplesOfProbes)
{
  scene::Frame frame;
  const std::vector<double> many(1000, 2.5);  // beyond what fits a header
  frame.probes = { { "top", "point", { 0.1, 0.2 }, { { "displacement_z", "m", { -1.0, -2.0 } } } },
                   { "error", "manufactured", {}, { { "rms", "m", {} } } },
                   { "fast", "body", many, { { "kinetic_energy", "J/m", many } } } };
  {
    Recorder recorder(path("probes.h5"), "probes", "");
    ASSERT_EQ(recorder.write(frame), "");
    frame.probes[0].time_s = { 0.3 };
    frame.probes[0].columns[0].values = { -3.0 };
    ASSERT_EQ(recorder.write(frame), "");
    ASSERT_EQ(recorder.write(scene::Frame()), "");
  }
  const Reader reader(path("probes.h5"));
  const std::string top = "/frames/000000/probes/top";
  EXPECT_EQ(reader.text_attribute(top, "kind"), "point");
  EXPECT_EQ(reader.numbers(top + "/time"), (std::vector<double>{ 0.1, 0.2 }));
  EXPECT_EQ(reader.text_attribute(top + "/time", "units"), "s");
  EXPECT_EQ(reader.numbers(top + "/displacement_z"), (std::vector<double>{ -1.0, -2.0 }));
  EXPECT_EQ(reader.text_attribute(top + "/displacement_z", "units"), "m");
  EXPECT_EQ(reader.extent("/frames/000000/probes/error/rms"), Extent{ 0 });
  EXPECT_EQ(reader.numbers("/frames/000000/probes/fast/kinetic_energy"), many);
  EXPECT_EQ(reader.numbers("/frames/000001/probes/top/displacement_z"), std::vector<double>{ -3.0 });
  EXPECT_FALSE(reader.has("/frames/000002/probes"));
}

/// Compares what is reserved for a frame with what it takes.
void expect_room(const scene::Frame& frame, const std::string& path)
{
  const auto size = [&] { return std::filesystem::file_size(path); };
  std::uintmax_t reserved_end = 0;
  {
    Recorder recorder(path, "room", "");
    ASSERT_EQ(recorder.write(frame), "");
    reserved_end = size();
  }
  const std::uintmax_t one_frame = size();
  {
    Recorder recorder(path, "room", "");
    ASSERT_EQ(recorder.write(frame), "");
    ASSERT_EQ(recorder.write(frame), "");
  }
  const std::uintmax_t frame_bytes = size() - one_frame;
  EXPECT_GT(reserved_end - (one_frame - frame_bytes), frame_bytes);
}

TEST_F(RecorderTest, ReservesRoomForManyProbes)
{
  // HDF5 does not survive a full disk, so what is reserved for a frame must hold it.
  scene::Frame frame = synthetic_frame(1.0, 1);
  for (int i = 0; i < 40; ++i) {
    scene::ProbeFrame probe = frame.probes.front();
    probe.name = "probe_" + std::to_string(i);
    for (int k = 0; k < 10; ++k)
      probe.columns.push_back({ "column_" + std::to_string(k), "m", { 1.0, 2.0 } });
    frame.probes.push_back(probe);
  }
  expect_room(frame, path("wide.h5"));
}

TEST_F(RecorderTest, ReservesRoomForTriangles)
{
  // Nothing but triangles with every tension: six to a node.
  scene::Frame frame = synthetic_solid_frame(1.0, 1);
  scene::GeotextileFrame& sheet = frame.geotextile[0];
  for (int i = 0; i < 3; ++i) {
    sheet.triangles.insert(sheet.triangles.end(), sheet.triangles.begin(), sheet.triangles.end());
    for (std::vector<double>* tension :
         { &sheet.tension, &sheet.gauge_tension, &sheet.warp_tension, &sheet.weft_tension })
      tension->insert(tension->end(), tension->begin(), tension->end());
  }
  expect_room(frame, path("triangles.h5"));
}

TEST_F(RecorderTest, LeavesOutWhatASceneDoesNotHave)
{
  scene::Frame frame;
  frame.soil = synthetic_frame(0.0, 2).soil;
  {
    Recorder recorder(path("column.h5"), "column", "");
    ASSERT_EQ(recorder.write(frame), "");
    ASSERT_EQ(recorder.write(scene::Frame()), "");
  }
  const Reader reader(path("column.h5"));
  EXPECT_TRUE(reader.has("/frames/000000/soil/position"));
  EXPECT_FALSE(reader.has("/frames/000000/geotextile"));
  EXPECT_FALSE(reader.has("/frames/000000/hull"));
  EXPECT_TRUE(reader.has("/frames/000001/time"));
  EXPECT_FALSE(reader.has("/frames/000001/soil"));
  EXPECT_EQ(file_text(path("column.xdmf")).find("geotextile"), std::string::npos);
}

TEST_F(RecorderTest, KeepsALongScene)
{
  const std::string scene(200'000, 'x');
  {
    Recorder recorder(path("long.h5"), "long", scene);
  }
  EXPECT_EQ(Reader(path("long.h5")).text("/scene"), scene);
}

TEST_F(RecorderTest, HoldsManyFramesInOrder)
{
  const int frames = 300;
  const scene::Frame first = synthetic_frame(0.0, 1);
  {
    Recorder recorder(path("many.h5"), "many", "");
    scene::Frame frame = first;
    for (int i = 0; i < frames; ++i) {
      frame.time_s = i;
      ASSERT_EQ(recorder.write(frame), "");
    }
    Recorder moved = std::move(recorder);
    ASSERT_EQ(moved.write(first), "");
    EXPECT_EQ(moved.frames(), frames + 1u);
  }
  const Reader reader(path("many.h5"));
  for (int i = 0; i < frames; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "/frames/%06d/time", i);
    ASSERT_EQ(reader.numbers(name), std::vector<double>{ static_cast<double>(i) });
  }
  EXPECT_FALSE(reader.has("/frames/000301"));
}

TEST_F(RecorderTest, NamesAPathThatCannotBeWritten)
{
  for (const std::string& bad : { path("no/such/folder/run.h5"), folder_.string(), std::string("/dev/full") }) {
    try {
      Recorder(bad, "x", "");
      ADD_FAILURE() << bad << " was accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.value(), bad);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(bad), std::string::npos) << error.what();
    }
  }
}

/// Lets this process write no file beyond so many bytes, as a full disk would.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }

private:
  rlimit before_{};
};

TEST_F(RecorderTest, NamesAFullDiskAtTheStart)
{
  const FileSizeLimit full(10'000);
  EXPECT_THROW(Recorder(path("full.h5"), "full", ""), InputError);
}

TEST_F(RecorderTest, KeepsTheFramesBeforeTheDiskWasFull)
{
  // Limits between whole frames of about 60 kB, so that the write that fails is a different one each time.
  for (rlim_t limit = 300'000; limit < 440'000; limit += 1'499) {
    std::size_t kept = 0;
    std::string failure, again;
    {
      Recorder recorder(path("full.h5"), "full", "name: full\n");
      const FileSizeLimit full(limit);
      for (int i = 0; failure.empty() && i < 100; ++i)
        failure = recorder.write(synthetic_frame(i, 15));
      kept = recorder.frames();
      again = recorder.write(synthetic_frame(99.0, 15));
      EXPECT_EQ(recorder.frames(), kept);
      Recorder(std::move(recorder));  // closing may not crash while the disk is still full
    }
    EXPECT_EQ(failure,
              "record stopped after " + std::to_string(kept) + " frames: no room for the next frame: File too large");
    EXPECT_EQ(again, failure);
    ASSERT_GT(kept, 1u);
    const Reader reader(path("full.h5"));
    for (std::size_t i = 0; i < kept; ++i)
      EXPECT_EQ(reader.extent("/frames/00000" + std::to_string(i) + "/soil/position"), (Extent{ 721, 3 }));
    const std::string xml = file_text(path("full.xdmf"));
    EXPECT_EQ(xml.substr(xml.size() - 8), "</Xdmf>\n");
  }
}

}  // namespace
}  // namespace geocontainer_mpm::record
