#include "foundation/error.hpp"
#include "foundation/npy.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <unistd.h>
#include <vector>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

/// A .npy file of version 1.0 as NumPy writes it, with any header and data.
template <typename Scalar>
std::string npy(const std::string& header, const std::vector<Scalar>& values) {
  std::string text = header;
  text.append((64 - (10 + text.size() + 1) % 64) % 64, ' ');
  text.push_back('\n');
  std::string file("\x93NUMPY\x01\x00", 8);
  file.push_back(static_cast<char>(text.size() & 255U));
  file.push_back(static_cast<char>(text.size() >> 8U));
  file += text;
  std::string data(values.size() * sizeof(Scalar), '\0');
  if (!values.empty()) std::memcpy(data.data(), values.data(), data.size());
  return file + data;
}

class Npy : public testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }

  Eigen::MatrixXd read(const std::string& content) {
    std::ofstream(file_, std::ios::binary) << content;
    return read_npy(file_);
  }

  std::string refusal(const std::string& content) {
    try {
      read(content);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path file_ = fs::temp_directory_path() / ("radiosity-npy-" + std::to_string(::getpid()) + ".npy");
};

TEST_F(Npy, GivesBackWhatWasWritten) {
  Eigen::MatrixXd matrix(3, 2);
  matrix << 1, -2.5, 1e300, 5e-324, 0, 1.0 / 3;
  write_npy(file_, matrix);
  EXPECT_EQ(read_npy(file_), matrix);
  EXPECT_EQ(fs::file_size(file_) % 64, 6 * 8 % 64U);  // the data starts at a multiple of 64
}

TEST_F(Npy, WritesMatricesWithoutRowsOrColumns) {
  write_npy(file_, Eigen::MatrixXd(0, 3));
  EXPECT_EQ(read_npy(file_).rows(), 0);
  EXPECT_EQ(read_npy(file_).cols(), 3);
}

TEST_F(Npy, ReadsRowMajorColumnMajorAndSinglePrecision) {
  const std::vector<double> values = {1, 2, 3, 4, 5, 6};
  Eigen::MatrixXd rows(2, 3), columns(2, 3);
  rows << 1, 2, 3, 4, 5, 6;
  columns << 1, 3, 5, 2, 4, 6;
  EXPECT_EQ(read(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", values)), rows);
  EXPECT_EQ(read(npy("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }", values)), columns);
  EXPECT_EQ(
      read(npy<float>("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", {1, 2, 3, 4, 5, 6})),
      rows);
}

TEST_F(Npy, ReadsOneDimensionAsAColumn) {
  EXPECT_EQ(read(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }", {1, 2, 3})),
            Eigen::Vector3d(1, 2, 3));
}

TEST_F(Npy, RefusesOtherTypesAndDimensions) {
  EXPECT_NE(refusal(npy<std::int64_t>("{'descr': '<i8', 'fortran_order': False, 'shape': (1,), }", {1}))
                .find("float"),
            std::string::npos);
  EXPECT_NE(
      refusal(npy<double>("{'descr': '>f8', 'fortran_order': False, 'shape': (1,), }", {1})).find("float"),
      std::string::npos);
  EXPECT_NE(refusal(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1), }", {1}))
                .find("3 dimensions"),
            std::string::npos);
}

TEST_F(Npy, RefusesTruncatedFilesAtEveryLength) {
  const std::string whole =
      npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", {1, 2, 3, 4});
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(refusal(whole.substr(0, length)), "no error") << length << " of " << whole.size() << " bytes";
}

TEST_F(Npy, RefusesAnnouncedSizesThatAreNotThere) {
  EXPECT_NE(refusal(npy<double>(
                        "{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000), }", {1}))
                .find("truncated"),
            std::string::npos);
}

TEST_F(Npy, NamesTheElementThatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(
      refusal(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", {1, 2, nan, 4}))
          .find("[1, 0]"),
      std::string::npos);
  EXPECT_NE(
      refusal(npy<double>("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", {1, infinity, 3, 4}))
          .find("[0, 1]"),
      std::string::npos);
}

TEST_F(Npy, SaysThatAFileIsMissing) {
  EXPECT_THROW(read_npy(file_.string() + ".missing"), Error);
}

}  // namespace
}  // namespace radiosity
