#include "geocontainer_mpm/record/checkpoint.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "frame_writer.h"
#include "geocontainer_mpm/error.h"
#include "geocontainer_mpm/record/whole_file.h"
#include "hdf5_handle.h"
#include "state_archive.h"
#include "state_list.h"

namespace geocontainer_mpm::record {
namespace {

using scene::SceneDescription;

/// The file is HDF5 and behind it this mark and a hash of all before, which readers of HDF5 do not see: whether it is
/// whole is known before anything in it is believed.
constexpr std::size_t mark_size = 16, hash_size = 16;
constexpr const char* mark = "geocontainer_mpm";
constexpr const char* creator = "geocontainer_mpm " GEOCONTAINER_MPM_VERSION;

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
class Hash {
public:
  void add(std::uint64_t word) { value_ = (value_ ^ word) * 1099511628211ULL; }
  void add(double number)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  /// Words of eight bytes, the last one filled up.
  void add(const char* bytes, std::size_t count)
  {
    for (std::size_t i = 0; i < count; i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i, std::min<std::size_t>(8, count - i));
      add(word);
    }
  }
  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

std::string hex(std::uint64_t value)
{
  return fmt::format("{:016x}", value);
}

std::string hash_of(const std::string& bytes)
{
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hex(hash.value());
}

/// What of a checkpoint says whose it is.
struct Identity {
  std::string content, version, scene, scene_hash, opening_hash;
  double end_s = 0.0, time_s = 0.0;

  template <class Archive>
  void list(Archive& archive)
  {
    archive.members("content, version, scene, scene_hash, opening_hash, end_s, time_s", content, version, scene,
                    scene_hash, opening_hash, end_s, time_s);
  }
};

template <bool reading>
using Archive = StateArchive<reading, StateAccess>;

/// All of the scene that its state depends on: the end is not in it.
std::string lasting_text(const SceneDescription& scene)
{
  std::istringstream lines(scene::scene_text(scene));
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (line.compare(0, 8, "  end_s:") != 0)
      text += line + "\n";
  return text;
}

/// An HDF5 file in memory: new, or one that is read.
Handle memory_file(const std::string* image)
{
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "cannot describe the file");
  constexpr std::size_t growth = 1024 * 1024;
  checked(H5Pset_fapl_core(access, growth, false), "cannot describe the file");
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "cannot describe the file");
  if (!image)
    return { H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "cannot create the file" };
  checked(H5Pset_file_image(access, const_cast<char*>(image->data()), image->size()), "cannot describe the file");
  return { H5Fopen("checkpoint", H5F_ACC_RDONLY, access), H5Fclose, "cannot open the file" };
}

template <class Run, class State>
std::string file_bytes(Run& run, State& state, std::uint64_t opening)
{
  const Handle file = memory_file(nullptr);
  write_text_attribute(file, "creator", creator);
  Archive<false> archive(file);
  const std::string text = lasting_text(run.scene);
  Identity identity{ "checkpoint",         GEOCONTAINER_MPM_VERSION, text, hash_of(text), hex(opening),
                     run.scene.time.end_s, state.progress.time_s };
  archive.group("identity", [&](auto& inside) { identity.list(inside); });
  archive.group("run", [&](auto& inside) { StateAccess::list(inside, run); });
  archive.group("state", [&](auto& inside) { StateAccess::list_checkpoint(inside, state); });
  checked(H5Fflush(file, H5F_SCOPE_LOCAL), "cannot finish the file");
  std::string bytes(static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0), "cannot finish the file")),
                    '\0');
  checked(H5Fget_file_image(file, bytes.data(), bytes.size()), "cannot finish the file");
  bytes.append(mark, mark_size);
  return bytes + hash_of(bytes);
}

/// Collects what a message needs.
class Refusal {
public:
  explicit Refusal(const std::string& path) : path_(path) {}
  [[noreturn]] void operator()(const std::string& why) const { throw InputError("", "checkpoint", path_, why); }

private:
  const std::string& path_;
};

/// Without the mark and the hash.
std::string read_whole(const std::string& path, const Refusal& refuse)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    refuse("cannot be read: is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || file.bad())
    refuse(std::string("cannot be read: ") + (errno != 0 ? std::strerror(errno) : "is empty"));
  std::string bytes = text.str();
  constexpr const char* signature = "\x89HDF\r\n\x1a\n";
  if (bytes.compare(0, 8, signature, 8) != 0)
    refuse("is no checkpoint: not an HDF5 file");
  const std::size_t end = bytes.size() - std::min(bytes.size(), mark_size + hash_size);
  if (bytes.compare(end, mark_size, mark) != 0)
    refuse("is no checkpoint, or cut short: a file that `--checkpoint` wrote ends with a mark of its own");
  const std::string hash = bytes.substr(end + mark_size);
  bytes.resize(end + mark_size);
  if (hash_of(bytes) != hash)
    refuse("is damaged: its bytes are not those that were written");
  bytes.resize(end);
  return bytes;
}

/// The first line of two texts that differs.
std::string difference(const std::string& then, const std::string& now)
{
  std::istringstream old_lines(then), new_lines(now);
  std::string old_line, new_line;
  do {
    if (!std::getline(old_lines, old_line))
      old_line = "nothing";
    if (!std::getline(new_lines, new_line))
      new_line = "nothing";
  } while (old_line == new_line && old_line != "nothing");
  const auto trimmed = [](const std::string& line) {
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
  };
  return fmt::format("'{}' there, '{}' now", trimmed(old_line), trimmed(new_line));
}

/// Output instants are multiples of their interval, to the last bit.
bool is_output_instant(double time_s, const SceneDescription& scene)
{
  const double interval = scene.time.output_interval_s;
  return std::round(time_s / interval) * interval == time_s;
}

void check(const Identity& identity, const SceneDescription& scene, std::optional<std::uint64_t> opening,
           const Refusal& refuse)
{
  if (identity.content != "checkpoint")
    refuse("is no checkpoint");
  if (identity.version != GEOCONTAINER_MPM_VERSION)
    refuse(fmt::format("is of version {}, this is {}: a state is read by the version that wrote it", identity.version,
                       GEOCONTAINER_MPM_VERSION));
  const std::string text = lasting_text(scene);
  if (identity.scene_hash != hash_of(text))
    refuse("is of another scene: " + difference(identity.scene, text));
  if (opening && identity.opening_hash != hex(*opening))
    refuse(fmt::format("is of another log of opening angles: hash {} there, {} now", identity.opening_hash,
                       hex(*opening)));
  const double end_s = scene.time.end_s;
  if (end_s < identity.time_s)
    refuse(fmt::format("is of {} s, after the end of the scene at {} s", identity.time_s, end_s));
  if (end_s != identity.end_s && !is_output_instant(identity.end_s, scene))
    refuse(fmt::format("is of a run to {} s, between two output instants, and goes on to that end only, not to {} s",
                       identity.end_s, end_s));
}

template <int Dim>
scene::Simulation read_run(const Archive<true>& file, const SceneDescription& scene, int threads)
{
  Archive<true> archive = file;
  auto run = std::make_unique<scene::Run<Dim>>(scene, threads, typename scene::Run<Dim>::Unsettled{});
  run->settled = run->model.state();
  run->fresh_progress = run->progress;
  archive.group("run", [&](auto& inside) { StateAccess::list(inside, *run); });
  auto state = StateAccess::fresh_state(*run);
  archive.group("state", [&](auto& inside) { StateAccess::list_checkpoint(inside, state); });
  run->go_on(std::move(state));
  return StateAccess::wrap(std::move(run));
}

}  // namespace

std::uint64_t opening_hash(const std::vector<barge::OpeningSample>& samples)
{
  Hash hash;
  for (const barge::OpeningSample& sample : samples) {
    hash.add(static_cast<std::uint64_t>(sample.stamp_ns));
    hash.add(sample.angles.port_rad);
    hash.add(sample.angles.starboard_rad);
  }
  return hash.value();
}

std::string checkpoint_bytes(const scene::Simulation& simulation, std::uint64_t opening)
{
  const QuietHdf5 quiet;
  return StateAccess::with_run(simulation, [&](auto& run) {
    auto state = run.right_state();
    return state ? file_bytes(run, *state, opening) : std::string();
  });
}

std::string save_checkpoint(const scene::Simulation& simulation, std::uint64_t opening, const std::string& path)
{
  try {
    const std::string bytes = checkpoint_bytes(simulation, opening);
    if (bytes.empty())
      return "there is no state to save yet: the run has not begun";
    return replace_file(path, bytes);
  } catch (const std::exception& error) {
    return error.what();
  }
}

scene::Simulation load_checkpoint(const std::string& path, const SceneDescription& scene,
                                  std::optional<std::uint64_t> opening, int threads)
{
  const QuietHdf5 quiet;
  const Refusal refuse(path);
  const std::string image = read_whole(path, refuse);
  try {
    const Handle file = memory_file(&image);
    Archive<true> archive(file);
    Identity identity;
    archive.group("identity", [&](auto& inside) { identity.list(inside); });
    check(identity, scene, opening, refuse);
    return scene.dimensions() == 3 ? read_run<3>(archive, scene, threads) : read_run<2>(archive, scene, threads);
  } catch (const Hdf5Error& error) {
    refuse(std::string("has no state of this program: ") + error.what());
  }
}

}  // namespace geocontainer_mpm::record
