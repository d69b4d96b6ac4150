#include "hdf5_handle.h"

#include <algorithm>

namespace geocontainer_mpm::record {

namespace {

herr_t keep_first(unsigned, const H5E_error2_t* error, void* text)
{
  if (error->desc != nullptr)
    *static_cast<std::string*>(text) = error->desc;
  return 1;  // a positive value ends the walk
}

}  // namespace

std::string innermost_hdf5_error()
{
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  // The system's own words are enough where there are any; the library wraps them in addresses and a line break.
  const std::string mark = "error message = '";
  if (const std::size_t begin = text.find(mark); begin != std::string::npos) {
    text.erase(0, begin + mark.size());
    text.erase(std::min(text.find('\''), text.size()));
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "unknown HDF5 error" : text;
}

QuietHdf5::QuietHdf5()
{
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5()
{
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

}  // namespace geocontainer_mpm::record
