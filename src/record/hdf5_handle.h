#pragma once
/// Thin RAII layer over HDF5's C API: handles that close themselves, errors as exceptions, a quiet error stack.

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace geocontainer_mpm::record {

/// A failed HDF5 call: what was tried and the library's innermost reason. Does not leave this room.
class Hdf5Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The innermost entry of HDF5's error stack as one line (there the system's own words are, e.g. "No space left").
std::string innermost_hdf5_error();

/// HDF5 prints its error stack to stderr by default; the core never prints. Restores what was set before.
class QuietHdf5 {
public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Returns a non-negative result of HDF5 as it is; throws Hdf5Error for a negative one.
template <typename Result>
Result checked(Result result, const char* what)
{
  if (result < 0)
    throw Hdf5Error(std::string(what) + ": " + innermost_hdf5_error());
  return result;
}

/// Owns one HDF5 identifier.
class Handle {
public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close close, const char* what) : id_(checked(id, what)), close_(close) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept
  {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
      close_ = other.close_;
    }
    return *this;
  }

  operator hid_t() const { return id_; }

  void reset()
  {
    if (id_ >= 0)
      close_(id_);
    id_ = H5I_INVALID_HID;
  }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

}  // namespace geocontainer_mpm::record
