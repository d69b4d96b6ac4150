#pragma once
/// Writes named values to an HDF5 group, or reads them from it: one visitor for both ways, so that both see one list
/// (state_list.h). Numbers keep their bits.

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Core>

#include "hdf5_handle.h"

namespace geocontainer_mpm::record {

template <class T>
inline constexpr bool is_number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T, class = void>
inline constexpr bool is_matrix = false;
template <class T>
inline constexpr bool is_matrix<T, std::enable_if_t<std::is_base_of_v<Eigen::MatrixBase<T>, T>>> = true;

template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;

/// Of a number in memory.
template <class T>
hid_t type_of()
{
  if constexpr (std::is_enum_v<T>)
    return type_of<std::underlying_type_t<T>>();
  else if constexpr (std::is_floating_point_v<T>)
    return sizeof(T) == 8 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
  else if constexpr (sizeof(T) == 8)
    return std::is_signed_v<T> ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64;
  else if constexpr (sizeof(T) == 4)
    return std::is_signed_v<T> ? H5T_NATIVE_INT32 : H5T_NATIVE_UINT32;
  else
    return std::is_signed_v<T> ? H5T_NATIVE_INT8 : H5T_NATIVE_UINT8;
}

/// Calls `visit(name, member)` for each member, with its name from a text such as "a, b, c".
template <class V, class... Members>
void for_each_named(V& visit, std::string names, Members&... members)
{
  const auto next = [&names] {
    const std::size_t comma = names.find(',');
    std::string name = names.substr(0, comma);
    names.erase(0, comma == std::string::npos ? comma : comma + 2);
    return name;
  };
  (visit(next(), members), ...);
}

/// All numbers of one row of a table, in order: real ones in one column, whole ones in another.
template <bool reading, class Owner>
class RowArchive {
public:
  std::vector<double> real;
  std::vector<std::int64_t> whole;
  std::size_t next_real = 0, next_whole = 0;

  template <class... Members>
  void members(const char* names, Members&... all)
  {
    for_each_named(*this, names, all...);
  }
  template <class T>
  void operator()(const std::string&, T& value)
  {
    if constexpr (std::is_floating_point_v<T>)
      one(value, real, next_real);
    else if constexpr (is_number<T>)
      one(value, whole, next_whole);
    else if constexpr (is_matrix<T> || is_array<T>)
      for (auto& number : value)
        (*this)("", number);
    else
      Owner::list(*this, value);
  }

private:
  template <class T, class Column>
  void one(T& value, Column& column, std::size_t& next)
  {
    if constexpr (reading) {
      if (next >= column.size())
        throw Hdf5Error("a table is too short");
      value = static_cast<T>(column[next++]);
    } else {
      column.push_back(static_cast<typename Column::value_type>(value));
    }
  }
};

/// `Owner::list(archive, value)` names the members of a struct.
template <bool reading, class Owner>
class StateArchive {
public:
  explicit StateArchive(hid_t group) : group_(group) {}

  template <class... Members>
  void members(const char* names, Members&... all)
  {
    for_each_named(*this, names, all...);
  }

  template <class T>
  void operator()(const std::string& name, T& value)
  {
    if constexpr (is_number<T>)
      move(name, type_of<T>(), &value, 1);
    else if constexpr (is_matrix<T>)
      move(name, type_of<double>(), value.data(), static_cast<std::size_t>(value.size()));
    else if constexpr (std::is_same_v<T, std::string>)
      text(name, value);
    else if constexpr (std::is_same_v<T, std::vector<bool>>)
      flags(name, value);
    else if constexpr (is_array<T>)
      array(name, value);
    else if constexpr (is_vector<T>)
      vector(name, value);
    else
      group(name, [&value](auto& inside) { Owner::list(inside, value); });
  }

  /// Elements of a container, each in a group of its own, by `list(archive, element)`. Those that nothing can make but
  /// the scene must be there already.
  template <class Container, class List>
  void parts(const std::string& name, Container& container, List&& list)
  {
    group(name, [&](auto& inside) {
      std::uint64_t count = container.size();
      inside("count", count);
      if constexpr (std::is_default_constructible_v<typename Container::value_type>)
        container.resize(count);
      else if (count != container.size())
        throw Hdf5Error(fmt::format("there are {} {}, {} are needed", count, name, container.size()));
      std::size_t i = 0;
      for (auto& element : container)
        inside.group(fmt::format("{}", i++), [&](auto& within) { list(within, element); });
    });
  }

  /// The same for many small ones of numbers alone: a table in two columns.
  template <class Container, class List>
  void rows(const std::string& name, Container& container, List&& list)
  {
    group(name, [&](auto& inside) {
      std::uint64_t count = container.size();
      inside("count", count);
      RowArchive<reading, Owner> row;
      if constexpr (reading) {
        inside.members("real, whole", row.real, row.whole);
        container.resize(count);
      }
      for (auto& element : container)
        list(row, element);
      if constexpr (!reading)
        inside.members("real, whole", row.real, row.whole);
    });
  }
  template <class Container>
  void rows(const std::string& name, Container& container)
  {
    rows(name, container, [](auto& row, auto& element) { row("", element); });
  }

  template <class Inside>
  void group(const std::string& name, Inside&& inside)
  {
    const Handle handle(reading ? H5Gopen2(group_, name.c_str(), H5P_DEFAULT)
                                : H5Gcreate2(group_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                        H5Gclose, name.c_str());
    StateArchive archive(handle);
    inside(archive);
  }

private:
  template <class T, std::size_t N>
  void array(const std::string& name, std::array<T, N>& value)
  {
    if constexpr (is_number<T>)
      move(name, type_of<T>(), value.data(), N);
    else
      group(name, [&value](auto& inside) {
        for (std::size_t i = 0; i < N; ++i)
          inside(fmt::format("{}", i), value[i]);
      });
  }
  template <class T>
  void vector(const std::string& name, std::vector<T>& value)
  {
    if constexpr (is_number<T>) {
      if constexpr (reading)
        value.resize(count_of(name));
      move(name, type_of<T>(), value.data(), value.size());
    } else {
      parts(name, value, [](auto& inside, auto& element) {
        if constexpr (is_array<T> || is_vector<T>)
          inside("values", element);
        else
          Owner::list(inside, element);
      });
    }
  }
  void flags(const std::string& name, std::vector<bool>& value)
  {
    std::vector<std::uint8_t> bytes(value.begin(), value.end());
    vector(name, bytes);
    value.assign(bytes.begin(), bytes.end());
  }
  void text(const std::string& name, std::string& value)
  {
    std::vector<char> letters(value.begin(), value.end());
    vector(name, letters);
    value.assign(letters.begin(), letters.end());
  }
  std::size_t count_of(const std::string& name) const
  {
    const Handle set(H5Dopen2(group_, name.c_str(), H5P_DEFAULT), H5Dclose, name.c_str());
    const Handle space(H5Dget_space(set), H5Sclose, name.c_str());
    return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space), name.c_str()));
  }
  void move(const std::string& name, hid_t type, void* data, std::size_t count)
  {
    const char* what = name.c_str();
    if constexpr (reading) {
      if (count_of(name) != count)
        throw Hdf5Error(name + " has another size");
      const Handle set(H5Dopen2(group_, what, H5P_DEFAULT), H5Dclose, what);
      checked(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), what);
    } else {
      const hsize_t extent = count;
      const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose, what);
      const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
      checked(H5Pset_layout(properties, count * H5Tget_size(type) <= compact_bytes ? H5D_COMPACT : H5D_CONTIGUOUS),
              what);
      const Handle set(H5Dcreate2(group_, what, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, what);
      checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), what);
    }
  }

  static constexpr std::size_t compact_bytes = 512;  ///< fewer are kept in the data set's own header

  hid_t group_;
};

}  // namespace geocontainer_mpm::record
