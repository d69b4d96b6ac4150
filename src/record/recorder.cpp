#include "geocontainer_mpm/record/recorder.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <optional>
#include <system_error>

#include "frame_writer.h"
#include "geocontainer_mpm/error.h"
#include "hdf5_handle.h"
#include "xdmf.h"

namespace geocontainer_mpm::record {

namespace {

constexpr const char* frames_link = "frames";

Handle create_file(const std::string& path)
{
  // The first formats of HDF5, on purpose: their object headers carry no checksum over parts that change in place,
  // their superblock no "open for writing" mark that would keep readers out after a kill, and every reader knows them.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "cannot describe the file");
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), "cannot describe the file");
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "cannot describe the file");
  // Tracking the order of creation makes the root keep its links inside its own object header; see commit().
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "cannot describe the file");
  checked(H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED), "cannot describe the file");
  return { H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose, "cannot create the file" };
}

/// A group that keeps existing whether or not a link leads to it.
Handle create_index(hid_t file)
{
  Handle index(H5Gcreate_anon(file, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "cannot create the index");
  checked(H5Oincr_refcount(index), "cannot create the index");
  return index;
}

void flush(hid_t file)
{
  checked(H5Fflush(file, H5F_SCOPE_LOCAL), "cannot write the file");
}

std::string xdmf_path(const std::string& path)
{
  const std::filesystem::path file(path);
  return (file.extension() == ".h5" ? std::filesystem::path(file).replace_extension() : file).string() + ".xdmf";
}

[[noreturn]] void fail(int error, const char* what)
{
  throw std::system_error(error, std::generic_category(), what);
}

/// Makes an empty file with room for the first things written to it, so that HDF5 meets neither a wrong path nor a full
/// disk: it does not survive them, see reserve(). A reader that still has an old record open keeps that one, instead of
/// seeing this one grow over it.
void prepare_file(const std::string& path, std::size_t bytes)
{
  std::error_code ignored;  // what cannot be asked or removed shows when the file is opened
  if (std::filesystem::is_regular_file(path, ignored))
    std::filesystem::remove(path, ignored);
  else if (std::filesystem::exists(path, ignored))
    fail(EINVAL, "is no regular file");
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0)
    fail(errno, "cannot create the file");
  const int error = ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes));
  ::close(descriptor);
  if (error != 0)
    fail(error, "no room for the file");
}

/// The operating system's descriptor behind an HDF5 file.
int descriptor_of(hid_t file)
{
  void* descriptor = nullptr;
  checked(H5Fget_vfd_handle(file, H5P_DEFAULT, &descriptor), "cannot reach the file");
  return *static_cast<int*>(descriptor);
}

hsize_t size_of(hid_t file)
{
  hsize_t size = 0;
  checked(H5Fget_filesize(file, &size), "cannot ask for the file's size");
  return size;
}

}  // namespace

/// Two indices, groups of links to the frames, take turns. The root's link `frames` leads to one; the other is brought
/// up to date and written out, then the link is turned. That turn is the only change to anything a reader can reach,
/// and it is one small write within the file's first page, so a kill falls before it or after it.
struct Recorder::File {
  Handle file;
  std::array<Handle, 2> index;
  std::size_t shown = 0;  ///< which index `frames` leads to
  Handle last;            ///< the newest frame; the other index lacks it
  std::string last_name;
  std::size_t frames = 0;
  std::string name;  ///< of the HDF5 file, without folder
  std::optional<XdmfSidecar> xdmf;
  std::string failure;  ///< after a failed write the library's state is unknown: nothing more is tried

  File(const std::string& path, const std::string& scene_name, const std::string& scene_text);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void append(const scene::Frame& frame);
  void reserve(const scene::Frame& frame);
  void commit();
  void trim();
};

Recorder::File::File(const std::string& path, const std::string& scene_name, const std::string& scene_text)
    : name(std::filesystem::path(path).filename().string())
{
  prepare_file(path, scene_name.size() + scene_text.size() + 64 * 1024);
  file = create_file(path);
  for (Handle& group : index)
    group = create_index(file);
  checked(H5Olink(index[shown], file, frames_link, H5P_DEFAULT, H5P_DEFAULT), "cannot create the index");
  write_text_attribute(file, "scene_name", scene_name);
  write_text_attribute(file, "creator", "geocontainer_mpm " GEOCONTAINER_MPM_VERSION);
  write_text_attribute(file, "created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))));
  write_text_attribute(file, "convention", "SI units; rows are x forward, y port, z up in base_link; compression < 0");
  write_text(file, "scene", scene_text);
  flush(file);
  xdmf.emplace(xdmf_path(path));
}

Recorder::File::~File()
{
  const QuietHdf5 quiet;
  trim();
  last.reset();
  for (Handle& group : index)
    group.reset();
  file.reset();
}

void Recorder::File::append(const scene::Frame& frame)
{
  reserve(frame);
  const std::string frame_name = fmt::format("{:06}", frames);
  Handle group = write_unlinked_frame(file, frame);
  const hid_t hidden = index[1 - shown];
  if (frames > 0)
    checked(H5Olink(last, hidden, last_name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "cannot link a frame");
  checked(H5Olink(group, hidden, frame_name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "cannot link a frame");
  flush(file);
  commit();
  last = std::move(group);
  last_name = frame_name;
  ++frames;
  xdmf->append(xdmf_entry(frame, "/frames/" + frame_name, name));
}

/// HDF5 does not survive a write that fails for want of space: closing its objects afterwards can crash the process. So
/// the space is taken before the library is asked to write, and a full disk is noticed while nothing has happened yet.
void Recorder::File::reserve(const scene::Frame& frame)
{
  const std::size_t index_growth = 4096 + 64 * frames;  // a longer list of names moves to a new place as a whole
  const int error = ::posix_fallocate(descriptor_of(file), static_cast<off_t>(size_of(file)),
                                      static_cast<off_t>(room_for(frame) + index_growth));
  if (error != 0)
    fail(error, "no room for the next frame");
}

/// Gives back what was reserved and not used. A run that is killed leaves it at the file's end, where it does no harm.
void Recorder::File::trim()
{
  int* descriptor = nullptr;
  hsize_t size = 0;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, reinterpret_cast<void**>(&descriptor)) >= 0 &&
      H5Fget_filesize(file, &size) >= 0 && ::ftruncate(*descriptor, static_cast<off_t>(size)) != 0)
    failure = "the file keeps some unused bytes at its end";
}

void Recorder::File::commit()
{
  checked(H5Ldelete(file, frames_link, H5P_DEFAULT), "cannot turn to the new index");
  checked(H5Olink(index[1 - shown], file, frames_link, H5P_DEFAULT, H5P_DEFAULT), "cannot turn to the new index");
  flush(file);
  shown = 1 - shown;
}

Recorder::Recorder(const std::string& path, const std::string& scene_name, const std::string& scene_text)
{
  const QuietHdf5 quiet;
  try {
    file_ = std::make_unique<File>(path, scene_name, scene_text);
  } catch (const std::runtime_error& error) {
    throw InputError("", "record", path, std::string(error.what()) + "; a file on a disk with room is needed");
  }
}

Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

std::string Recorder::write(const scene::Frame& frame)
{
  if (!file_->failure.empty())
    return file_->failure;
  const QuietHdf5 quiet;
  try {
    file_->append(frame);
  } catch (const std::exception& error) {
    file_->failure = fmt::format("record stopped after {} frames: {}", file_->frames, error.what());
  }
  return file_->failure;
}

std::size_t Recorder::frames() const
{
  return file_->frames;
}

}  // namespace geocontainer_mpm::record
