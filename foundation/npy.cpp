#include "foundation/npy.hpp"

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace radiosity {
namespace {

constexpr std::array<char, 8> kMagic = {'\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0};

struct Header {
  bool single = false;
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
};

std::string quoted_value(const std::string& header, const std::string& key) {
  const auto at = header.find("'" + key + "'");
  if (at == std::string::npos) return {};
  const auto colon = header.find(':', at);
  return colon == std::string::npos ? std::string{} : header.substr(colon + 1);
}

Header parse_header(const std::string& text, const std::string& file) {
  Header header;
  const std::string type = quoted_value(text, "descr");
  if (type.find("'<f4'") != std::string::npos && type.find("'<f4'") < 8)
    header.single = true;
  else if (type.find("'<f8'") == std::string::npos || type.find("'<f8'") >= 8)
    fail("'{}' is not an array of float32 or float64 numbers; save it with numpy.save(file, a.astype(float))",
         file);
  const std::string order = quoted_value(text, "fortran_order");
  header.fortran_order = order.find("True") != std::string::npos && order.find("True") < 3;

  const std::string shape = quoted_value(text, "shape");
  const auto open = shape.find('('), close = shape.find(')');
  if (open == std::string::npos || close == std::string::npos)
    fail("'{}' has no array shape: not a .npy file", file);
  const char* at = shape.data() + open + 1;
  const char* end = shape.data() + close;
  while (at < end) {
    if (*at == ' ' || *at == ',') {
      ++at;
      continue;
    }
    std::int64_t extent = 0;
    const auto [next, error] = std::from_chars(at, end, extent);
    if (error != std::errc{} || extent < 0)
      fail("'{}' has an array shape that is not a list of numbers", file);
    header.shape.push_back(extent);
    at = next;
  }
  if (header.shape.empty() || header.shape.size() > 2)
    fail("'{}' has {} dimensions; an array of 1 or 2 is needed", file, header.shape.size());
  return header;
}

template <typename Scalar>
Eigen::MatrixXd read_values(std::ifstream& in, const Header& header, const std::string& file) {
  const Eigen::Index rows = header.shape[0];
  const Eigen::Index cols = header.shape.size() == 2 ? header.shape[1] : 1;
  const auto data_start = in.tellg();
  in.seekg(0, std::ios::end);
  const auto available = static_cast<std::uint64_t>(in.tellg() - data_start);
  in.seekg(data_start);
  const auto wanted = static_cast<long double>(rows) * static_cast<long double>(cols) * sizeof(Scalar);
  if (wanted > static_cast<long double>(available))
    fail("'{}' is truncated: {} x {} numbers are announced, {} bytes are there", file, rows, cols, available);

  using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor values(header.fortran_order ? cols : rows, header.fortran_order ? rows : cols);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(wanted));
  Eigen::MatrixXd matrix = values.template cast<double>();
  if (header.fortran_order) matrix.transposeInPlace();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      if (!std::isfinite(matrix(i, j)))
        fail("'{}' holds {} at [{}, {}]; every number must be finite", file, matrix(i, j), i, j);
  return matrix;
}

}  // namespace

void write_npy(const std::filesystem::path& file, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   matrix.rows(), matrix.cols());
  const std::size_t unpadded = kMagic.size() + 2 + header.size() + 1;
  header.append((64 - unpadded % 64) % 64, ' ');
  header.push_back('\n');

  OutputFile output(file);
  output.stream().write(kMagic.data(), kMagic.size());
  const auto length = static_cast<std::uint16_t>(header.size());
  const std::array<char, 2> length_bytes = {static_cast<char>(length & 0xff), static_cast<char>(length >> 8)};
  output.stream().write(length_bytes.data(), 2);
  output.stream().write(header.data(), static_cast<std::streamsize>(header.size()));
  Eigen::RowVectorXd row(matrix.cols());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    row = matrix.row(i);
    output.stream().write(reinterpret_cast<const char*>(row.data()),
                          static_cast<std::streamsize>(sizeof(double) * row.size()));
  }
  output.commit();
}

Eigen::MatrixXd read_npy(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot read '{}': {}", file, std::strerror(errno));
  std::array<char, 10> start{};
  in.read(start.data(), start.size());
  if (!in || std::memcmp(start.data(), kMagic.data(), 6) != 0) fail("'{}' is not a .npy file", file);
  std::uint32_t length = static_cast<unsigned char>(start[8]) | static_cast<unsigned char>(start[9]) << 8U;
  if (start[6] >= 2) {
    std::array<char, 2> high{};
    in.read(high.data(), 2);
    length |= static_cast<std::uint32_t>(static_cast<unsigned char>(high[0])) << 16U |
              static_cast<std::uint32_t>(static_cast<unsigned char>(high[1])) << 24U;
  }
  if (length > 1U << 20U) fail("'{}' has a header of {} bytes: not a .npy file of numbers", file, length);
  std::string text(length, '\0');
  in.read(text.data(), length);
  if (!in) fail("'{}' is truncated in its header", file);
  const Header header = parse_header(text, file);
  return header.single ? read_values<float>(in, header, file) : read_values<double>(in, header, file);
}

}  // namespace radiosity
