#pragma once
/// What the tests of the recorder share: a folder for each test, and a reader that shares nothing with the writer.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "geocontainer_mpm/mpm/types.h"

namespace geocontainer_mpm::record {

/// A folder of its own for each test.
class RecorderTest : public testing::Test {
protected:
  void SetUp() override
  {
    std::string name = (std::filesystem::temp_directory_path() / "recorder_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

/// Reads with HDF5's own calls, so that reading shares nothing with the writer.
class Reader {
public:
  explicit Reader(const std::string& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT))
  {
    if (file_ < 0)
      throw std::runtime_error("cannot open " + path);
  }
  ~Reader() { H5Fclose(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  bool has(const std::string& name) const
  {
    for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
      if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
        return false;
    return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
  }

  std::vector<hsize_t> extent(const std::string& name) const
  {
    const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    std::vector<hsize_t> result(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, result.data(), nullptr);
    H5Sclose(space);
    H5Dclose(set);
    return result;
  }

  std::vector<double> numbers(const std::string& name) const
  {
    const auto size = extent(name);
    std::vector<double> result(std::accumulate(size.begin(), size.end(), std::size_t{ 1 }, std::multiplies<>()));
    const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()), 0) << name;
    H5Dclose(set);
    return result;
  }

  std::string text(const std::string& name) const
  {
    const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(set);
    std::string result(H5Tget_size(type), '\0');
    H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data());
    H5Tclose(type);
    H5Dclose(set);
    return result;
  }

  std::vector<double> number_attribute(const std::string& object, const std::string& name) const
  {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Aget_space(attribute);
    std::vector<double> result(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, result.data()), 0) << object << " " << name;
    H5Sclose(space);
    H5Aclose(attribute);
    return result;
  }

  /// Texts of an attribute, one after the other and padded with NUL.
  std::string text_attribute(const std::string& object, const std::string& name) const
  {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    std::string result(H5Aget_storage_size(attribute), '\0');
    EXPECT_GE(H5Aread(attribute, type, result.data()), 0) << object << " " << name;
    H5Tclose(type);
    H5Aclose(attribute);
    return result;
  }

private:
  hid_t file_;
};

inline std::vector<double> rows(const std::vector<Vec3>& points)
{
  std::vector<double> result;
  for (const Vec3& point : points)
    result.insert(result.end(), point.begin(), point.end());
  return result;
}

/// What the file keeps of these. One-way on purpose: GCC 12 at -O3 drops a rounding to float and back in a vector.
inline std::vector<float> singles(const std::vector<double>& values)
{
  std::vector<float> result;
  for (const double value : values)
    result.push_back(static_cast<float>(value));
  return result;
}

inline std::string file_text(const std::string& name)
{
  std::ifstream file(name);
  return { std::istreambuf_iterator<char>(file), {} };
}

using Extent = std::vector<hsize_t>;

}  // namespace geocontainer_mpm::record
