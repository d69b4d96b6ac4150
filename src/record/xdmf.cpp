#include "xdmf.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include "frame_parts.h"

namespace geocontainer_mpm::record {

namespace {

constexpr std::string_view head = R"(<?xml version="1.0" encoding="UTF-8"?>
<Xdmf Version="3.0">
 <Domain>
  <Grid Name="record" GridType="Collection" CollectionType="Temporal">
)";
constexpr std::string_view tail = "  </Grid>\n </Domain>\n</Xdmf>\n";

[[noreturn]] void fail(const std::string& what)
{
  throw std::system_error(errno, std::generic_category(), what);
}

void write_at(int descriptor, std::string_view text, std::size_t offset, const std::string& path)
{
  while (!text.empty()) {
    const ssize_t written = ::pwrite(descriptor, text.data(), text.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR)
      continue;
    if (written < 0)
      fail("cannot write " + path);
    text.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::size_t>(written);
  }
}

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// Builds the grids of one frame.
class EntryBuilder {
public:
  explicit EntryBuilder(std::string frame_location) : frame_location_(std::move(frame_location)) {}

  void begin_points(const char* group, std::int64_t points)
  {
    begin_grid(group);
    text_ += fmt::format("     <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n", points);
  }

  void begin_pieces(const char* group, const Pieces& pieces)
  {
    const char* type = pieces.corners == 3 ? "Triangle" : "Polyline\" NodesPerElement=\"2";
    begin_grid(group);
    text_ += fmt::format("     <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">\n", type, pieces.total);
    item("connectivity", "Int", 4, fmt::format("{} {}", pieces.total, pieces.corners));
    text_ += "     </Topology>\n";
  }

  void geometry(const char* name, std::int64_t points)
  {
    text_ += "     <Geometry GeometryType=\"XYZ\">\n";
    item(name, "Float", 8, fmt::format("{} 3", points));
    text_ += "     </Geometry>\n";
  }

  void attribute(const char* name, const char* type, const char* center, std::int64_t rows, int columns,
                 const char* number = "Float")
  {
    text_ += fmt::format("     <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n", name, type, center);
    item(name, number, 4, columns == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, columns));
    text_ += "     </Attribute>\n";
  }

  void end() { text_ += "    </Grid>\n"; }

  const std::string& text() const { return text_; }

private:
  void begin_grid(const char* group)
  {
    group_ = group;
    text_ += fmt::format("    <Grid Name=\"{}\" GridType=\"Uniform\">\n", group);
  }

  void item(const char* name, const char* number, int precision, const std::string& extent)
  {
    text_ += fmt::format(
        "      <DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}/{}/{}</DataItem>\n",
        number, precision, extent, frame_location_, group_, name);
  }

  std::string frame_location_, group_, text_;
};

void add_boundaries(EntryBuilder& builder, const char* group,
                    const std::vector<const scene::BoundaryFrame*>& boundaries)
{
  const Parts parts = parts_of(boundaries, &scene::BoundaryFrame::position);
  const Pieces pieces = pieces_of(boundaries, parts);
  if (pieces.total == 0)
    return;
  builder.begin_pieces(group, pieces);
  builder.geometry("position", parts.total);
  builder.end();
}

}  // namespace

std::string xdmf_entry(const scene::Frame& frame, const std::string& frame_path, const std::string& file_name)
{
  EntryBuilder builder(escaped(file_name) + ":" + frame_path);
  if (const auto bodies = soil_of(frame); !bodies.empty()) {
    const std::int64_t n = parts_of(bodies, &scene::SoilFrame::position).total;
    builder.begin_points("soil", n);
    builder.geometry("position", n);
    builder.attribute("velocity", "Vector", "Node", n, 3);
    builder.attribute("stress", "Tensor6", "Node", n, 6);
    builder.attribute("volume", "Scalar", "Node", n, 1);
    builder.attribute("body", "Scalar", "Node", n, 1, "Int");
    builder.end();
  }
  if (const auto sheets = geotextile_of(frame); !sheets.empty()) {
    const Parts parts = parts_of(sheets, &scene::GeotextileFrame::node);
    const std::int64_t n = parts.total;
    const Pieces pieces = pieces_of(sheets, parts);
    builder.begin_pieces("geotextile", pieces);
    builder.geometry("node", n);
    builder.attribute("velocity", "Vector", "Node", n, 3);
    builder.attribute("tension", "Scalar", "Cell", pieces.total, 1);
    builder.attribute("gauge_tension", "Scalar", "Cell", pieces.total, 1);
    if (has_directions(sheets)) {
      builder.attribute("warp_tension", "Scalar", "Cell", pieces.total, 1);
      builder.attribute("weft_tension", "Scalar", "Cell", pieces.total, 1);
    }
    builder.end();
  }
  add_boundaries(builder, "hull", hull_of(frame));
  add_boundaries(builder, "surface", surfaces_of(frame));
  return fmt::format(
      "   <Grid Name=\"frame\" GridType=\"Collection\" CollectionType=\"Spatial\">\n    <Time Value=\"{}\"/>\n{}   "
      "</Grid>\n",
      frame.time_s, builder.text());
}

XdmfSidecar::Side::Side(const std::string& path)
    : descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)), body_end(head.size())
{
  if (descriptor < 0)
    fail("cannot create " + path);
}

XdmfSidecar::Side::~Side()
{
  if (descriptor >= 0)
    ::close(descriptor);
}

XdmfSidecar::Side::Side(Side&& other) noexcept
    : descriptor(std::exchange(other.descriptor, -1)), body_end(other.body_end)
{
}

XdmfSidecar::Side& XdmfSidecar::Side::operator=(Side&& other) noexcept
{
  std::swap(descriptor, other.descriptor);
  std::swap(body_end, other.body_end);
  return *this;
}

XdmfSidecar::XdmfSidecar(const std::string& path)
    : path_(path), next_path_(path + ".next"), shown_(path_), next_(next_path_)
{
  for (const Side* side : { &shown_, &next_ })
    write_at(side->descriptor, std::string(head) + std::string(tail), 0, path_);
}

XdmfSidecar::~XdmfSidecar()
{
  ::unlink(next_path_.c_str());
}

void XdmfSidecar::append(const std::string& entry)
{
  const std::string body = missing_in_next_ + entry;
  write_at(next_.descriptor, body + std::string(tail), next_.body_end, next_path_);
  next_.body_end += body.size();
  exchange_names();
  std::swap(shown_, next_);
  missing_in_next_ = entry;
}

void XdmfSidecar::exchange_names()
{
  if (::renameat2(AT_FDCWD, next_path_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0)
    return;
  // File systems without an exchange (some network shares and memory sticks): for an instant there is no sidecar.
  const std::string aside = next_path_ + "2";
  if (::rename(path_.c_str(), aside.c_str()) != 0 || ::rename(next_path_.c_str(), path_.c_str()) != 0 ||
      ::rename(aside.c_str(), next_path_.c_str()) != 0)
    fail("cannot rename " + next_path_);
}

}  // namespace geocontainer_mpm::record
