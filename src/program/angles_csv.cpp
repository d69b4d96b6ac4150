#include "angles_csv.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "geocontainer_mpm/error.h"

namespace geocontainer_mpm::program {
namespace {

constexpr std::array<const char*, 3> columns = { "time_s", "port_rad", "starboard_rad" };
constexpr const char* header = "time_s,port_rad,starboard_rad";
constexpr long double max_time_s = 9.2e9L;  ///< nanoseconds of it still fit 64 bits

/// Spreadsheets end lines with CR LF and may start a file with a byte order mark.
bool next_line(std::ifstream& file, std::string& line)
{
  if (!std::getline(file, line))
    return false;
  if (!line.empty() && line.back() == '\r')
    line.pop_back();
  return true;
}

void drop_byte_order_mark(std::string& line)
{
  constexpr const char* mark = "\xEF\xBB\xBF";
  if (line.rfind(mark, 0) == 0)
    line.erase(0, std::strlen(mark));
}

std::vector<std::string> split(const std::string& line)
{
  std::vector<std::string> fields;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = line.find(',', begin);
    fields.push_back(line.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return fields;
}

/// Extended precision, so that a time of today's epoch written with nine decimals gives exactly its nanoseconds: a log
/// exported from a bag is the same log. (strtold in the C locale, which this program never leaves; the standard
/// library of ROS Noetic's compiler has no std::from_chars for floating point.)
long double number(const std::string& text, const std::string& where, const char* column)
{
  char* end = nullptr;
  const long double value = std::strtold(text.c_str(), &end);
  while (*end == ' ' || *end == '\t')
    ++end;
  if (end == text.c_str() || *end != '\0')
    throw InputError(where, column, text, "is not a number");
  return value;
}

barge::OpeningSample sample(const std::string& line, const std::string& where)
{
  const std::vector<std::string> fields = split(line);
  if (fields.size() != columns.size())
    throw InputError(where, fields.size() < columns.size() ? columns.at(fields.size()) : "line", line,
                     "has " + std::to_string(fields.size()) + " fields, the table has 3 columns: " + header);
  const long double time_s = number(fields[0], where, columns[0]);
  if (!(std::abs(time_s) < max_time_s))
    throw InputError(where, columns[0], fields[0], "must be a finite time in s, within +-9.2e9");
  return { std::llround(time_s * 1e9L),
           { static_cast<double>(number(fields[1], where, columns[1])),
             static_cast<double>(number(fields[2], where, columns[2])) } };
}

}  // namespace

std::vector<barge::OpeningSample> read_angles_csv(const std::string& path)
{
  if (std::filesystem::is_directory(path))
    throw InputError("command line", "--angles", path, "is a directory, must be a CSV file");
  std::ifstream file(path);
  if (!file)
    throw InputError("command line", "--angles", path, std::string("cannot be read: ") + std::strerror(errno));
  std::string line;
  if (!next_line(file, line))
    throw InputError(path + ":1", "header", "", std::string("file is empty, must start with the line ") + header);
  drop_byte_order_mark(line);
  if (line != header)
    throw InputError(path + ":1", "header", line, std::string("must be ") + header);
  std::vector<barge::OpeningSample> samples;
  for (int number = 2; next_line(file, line); ++number)
    if (!line.empty())
      samples.push_back(sample(line, path + ":" + std::to_string(number)));
  if (samples.empty())
    throw InputError(path, columns[0], "", "file holds no sample");
  return samples;
}

}  // namespace geocontainer_mpm::program
