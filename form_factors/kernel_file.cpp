#include "form_factors/kernel_file.hpp"

#include "foundation/hash.hpp"
#include "foundation/output_file.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "kernel files are little endian");

constexpr std::array<char, 16> kMagic = {'r', 'a', 'd', 'i', 'o', 's', 'i',  't',
                                         'y', ' ', 'K', ' ', 'v', '1', '\n', 0};

// Big arrays word by word, which is faster.
void add_to_checksum(Fingerprint& checksum, const void* data, std::size_t count) {
  const char* const bytes = static_cast<const char*>(data);
  checksum.add(std::string_view(bytes, std::min<std::size_t>(count, 4096)));
  if (count <= 4096) return;
  std::uint64_t word;
  for (std::size_t at = 0; at + sizeof word <= count; at += sizeof word) {
    std::memcpy(&word, bytes + at, sizeof word);
    checksum.add(word);
  }
}

// Everything goes through here, so that a damaged file is noticed whatever part of it is damaged.
class Writer {
 public:
  explicit Writer(std::ofstream& out) : out_(out) {}
  void bytes(const void* data, std::size_t count) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
    add_to_checksum(checksum_, data, count);
  }
  template <typename T>
  void value(const T& value) {
    bytes(&value, sizeof value);
  }
  void text(const std::string& text) {
    value(static_cast<std::uint64_t>(text.size()));
    bytes(text.data(), text.size());
  }
  std::uint64_t checksum() const { return checksum_.value(); }

 private:
  std::ofstream& out_;
  Fingerprint checksum_;
};

class Reader {
 public:
  Reader(std::ifstream& in, std::string file) : in_(in), file_(std::move(file)) {
    in_.seekg(0, std::ios::end);
    left_ = static_cast<std::uint64_t>(in_.tellg());
    in_.seekg(0);
  }
  void bytes(void* data, std::size_t count) {
    if (count > left_) damaged("truncated");
    in_.read(static_cast<char*>(data), static_cast<std::streamsize>(count));
    if (!in_) fail("kernel file '{}' cannot be read to its end", file_);
    left_ -= count;
    add_to_checksum(checksum_, data, count);
  }
  [[noreturn]] void damaged(const char* how = "damaged") const {
    fail("kernel file '{}' is {}; write it again with --save", file_, how);
  }
  // For what is read twice: where the next value stands, and back there.
  std::streampos position() { return in_.tellg(); }
  void seek(std::streampos position) { in_.seekg(position); }
  // Reads without checksum; false at the end of the file.
  bool peek(void* data, std::size_t count) {
    return static_cast<bool>(in_.read(static_cast<char*>(data), static_cast<std::streamsize>(count)));
  }
  void skip(std::size_t count) { in_.seekg(static_cast<std::streamoff>(count), std::ios::cur); }
  template <typename T>
  T value() {
    T result;
    bytes(&result, sizeof result);
    return result;
  }
  std::string text() {
    const auto size = value<std::uint64_t>();
    if (size > left_) damaged("truncated");
    std::string result(size, '\0');
    bytes(result.data(), size);
    return result;
  }
  std::uint64_t left() const { return left_; }
  std::uint64_t checksum() const { return checksum_.value(); }

 private:
  std::ifstream& in_;
  std::string file_;
  std::uint64_t left_ = 0;
  Fingerprint checksum_;
};

// The same list of members for both directions.
template <typename Archive, typename Quality>
void each_number(Archive&& archive, Quality& q) {
  archive(q.rays), archive(q.seconds), archive(q.cpu_seconds), archive(q.row_sum_min), archive(q.row_sum_max);
  archive(q.row_sum_rms), archive(q.reciprocity_max), archive(q.back_hits), archive(q.leaks),
      archive(q.probe_rays);
}

void write_matrix(Writer& writer, const Eigen::MatrixXd& matrix) {
  writer.value(static_cast<std::int64_t>(matrix.rows()));
  writer.value(static_cast<std::int64_t>(matrix.cols()));
  writer.bytes(matrix.data(), sizeof(double) * static_cast<std::size_t>(matrix.size()));
}

Eigen::MatrixXd read_matrix(Reader& reader) {
  const auto rows = reader.value<std::int64_t>(), cols = reader.value<std::int64_t>();
  if (rows < 0 || cols < 0 ||
      static_cast<long double>(rows) * static_cast<long double>(cols) * 8 >
          static_cast<long double>(reader.left()))
    reader.damaged("truncated or damaged");
  Eigen::MatrixXd matrix(rows, cols);
  reader.bytes(matrix.data(), sizeof(double) * static_cast<std::size_t>(matrix.size()));
  return matrix;
}

constexpr std::size_t kTileBytes = sizeof(double) * SymmetricTiles<double>::tile_entries;

std::shared_ptr<SymmetricTiles<double>> read_tiles(Reader& reader, Index n, std::int64_t tiles) {
  if (static_cast<std::uint64_t>(tiles) > reader.left() / kTileBytes) reader.damaged("truncated");
  const Index rows = (n + SymmetricTiles<double>::tile_size - 1) / SymmetricTiles<double>::tile_size;
  // The directory is spread over the file: read it first, then the entries.
  const std::streampos start = reader.position();
  std::vector<char> present(static_cast<std::size_t>(rows * rows), 0);
  for (std::int64_t t = 0; t < tiles; ++t) {
    std::array<std::int64_t, 2> place{};
    const bool there = reader.peek(place.data(), sizeof place);
    if (!there || place[0] < 0 || place[0] > place[1] || place[1] >= rows) reader.damaged();
    present[static_cast<std::size_t>(place[0] * rows + place[1])] = 1;
    reader.skip(kTileBytes);
  }
  reader.seek(start);
  auto kernel = std::make_shared<SymmetricTiles<double>>(n, [&](Index row, Index column) {
    return present[static_cast<std::size_t>(row * rows + column)] != 0;
  });
  for (std::int64_t t = 0; t < tiles; ++t) {
    const auto row = reader.value<std::int64_t>(), column = reader.value<std::int64_t>();
    reader.bytes(kernel->tile_data(kernel->find_tile(row, column)), kTileBytes);
  }
  return kernel;
}

std::shared_ptr<RowMajorMatrix<double>> read_rows(Reader& reader, Index n) {
  const long double wanted = 8.0L * static_cast<long double>(n) * static_cast<long double>(n);
  if (wanted > static_cast<long double>(reader.left())) reader.damaged("truncated");
  auto factors = std::make_shared<RowMajorMatrix<double>>(n, n);
  for (Index i = 0; i < n; ++i) reader.bytes(factors->row(i), sizeof(double) * static_cast<std::size_t>(n));
  return factors;
}

}  // namespace

void save_kernel(const std::filesystem::path& path, const FormFactors& form_factors) {
  OutputFile output(path);
  Writer writer(output.stream());
  writer.bytes(kMagic.data(), kMagic.size());
  writer.value(form_factors.mesh->geometry_hash());
  writer.value(static_cast<std::int64_t>(form_factors.patch_count()));
  const FormFactorQuality& quality = form_factors.quality;
  writer.text(quality.method), writer.text(quality.closure), writer.text(quality.closure_note);
  each_number([&](const auto& number) { writer.value(number); }, quality);
  write_matrix(writer, form_factors.exposed);
  write_matrix(writer, form_factors.group_standard_error);
  writer.value(static_cast<std::int64_t>(form_factors.symmetric() ? form_factors.kernel->tile_count() : -1));
  if (form_factors.symmetric()) {
    const SymmetricTiles<double>& kernel = *form_factors.kernel;
    for (Index row = 0; row < kernel.tile_rows(); ++row)
      for (Index tile = kernel.row_begin(row); tile < kernel.row_begin(row + 1); ++tile) {
        writer.value(static_cast<std::int64_t>(row));
        writer.value(static_cast<std::int64_t>(kernel.tile_column(tile)));
        writer.bytes(kernel.tile_data(tile), kTileBytes);
      }
  } else {
    for (Index i = 0; i < form_factors.patch_count(); ++i)
      writer.bytes(form_factors.unsymmetric->row(i),
                   sizeof(double) * static_cast<std::size_t>(form_factors.patch_count()));
  }
  writer.value(writer.checksum());
  output.commit();
}

FormFactors load_kernel(const std::filesystem::path& path, std::shared_ptr<const PatchMesh> mesh) {
  const std::string file = path.string();
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot read kernel file '{}': {}", file, std::strerror(errno));
  Reader reader(in, file);
  std::array<char, 16> magic{};
  if (reader.left() >= magic.size()) reader.bytes(magic.data(), magic.size());
  if (magic != kMagic) fail("'{}' is not a kernel file; write one with --save", file);
  const auto hash = reader.value<std::uint64_t>();
  const auto n = reader.value<std::int64_t>();
  if (n != mesh->patch_count() || hash != mesh->geometry_hash())
    fail(
        "kernel file '{}' belongs to other patches ({} of them, here {}); use the scene and mesh options it "
        "was saved with",
        file, n, mesh->patch_count());
  FormFactors result;
  result.mesh = std::move(mesh);
  FormFactorQuality& quality = result.quality;
  quality.method = reader.text(), quality.closure = reader.text(), quality.closure_note = reader.text();
  each_number([&](auto& number) { number = reader.value<std::decay_t<decltype(number)>>(); }, quality);
  const Eigen::MatrixXd exposed = read_matrix(reader);
  if (exposed.rows() != n || exposed.cols() != 1) reader.damaged();
  result.exposed = exposed.col(0);
  result.group_standard_error = read_matrix(reader);
  const auto tiles = reader.value<std::int64_t>();
  if (tiles >= 0)
    result.kernel = read_tiles(reader, n, tiles);
  else
    result.unsymmetric = read_rows(reader, n);
  const std::uint64_t computed = reader.checksum();
  if (reader.value<std::uint64_t>() != computed) reader.damaged("damaged (its checksum differs)");
  return result;
}

}  // namespace radiosity
