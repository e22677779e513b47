// one-ray, gather, rows on demand and kernel files.
#include "form_factors/form_factor_rows.hpp"
#include "form_factors/kernel_file.hpp"
#include "scene/built_in.hpp"
#include "tests/form_factors/hand_made_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>
#include <unistd.h>

namespace radiosity::testing {
namespace {

std::shared_ptr<const PatchMesh> room(Index patches) {
  return std::make_shared<const PatchMesh>(
      make_patches(built_in_scene("cornell-box-closed"), {.patches = patches}));
}

TEST(OneRay, IsTheFormulaBetweenIncircleCentres) {
  HandMadeScene scene;  // two right triangles with legs 3, 4: incircle radius 1, centre (1, 1)
  scene.polygon({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}).polygon({{0, 0, 2}, {0, 4, 2}, {3, 0, 2}});
  FormFactorOptions options = raw();
  options.method = FormFactorMethod::one_ray;
  const FormFactors form_factors = compute(scene.mesh(), options);
  EXPECT_NEAR(form_factors(0, 1), 6 / (std::numbers::pi * 4), 1e-12);
  EXPECT_EQ(form_factors.quality.method, "one-ray");
}

TEST(OneRay, OneBlockedRayTakesAll) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY)
      .rectangle({0, 0, 1}, kY, kX)
      .rectangle({0.4, 0.4, 0.5}, 0.2 * kX, 0.2 * kY);
  FormFactorOptions options = raw();
  options.method = FormFactorMethod::one_ray;
  EXPECT_EQ(compute(scene.mesh(), options)(0, 1), 0);
}

TEST(Gather, RowsOfARoomSumToOneAndComeNearTheAccurateFactors) {
  const auto mesh = room(200);
  FormFactorOptions options = raw();
  options.method = FormFactorMethod::gather;
  options.gather_rays = 4096;
  const FormFactors gathered = compute(mesh, options), accurate = compute(mesh, raw());
  EXPECT_FALSE(gathered.symmetric());
  EXPECT_LE((gathered.row_sums().array() - 1).abs().maxCoeff(), 1e-3);
  EXPECT_GT(gathered.quality.reciprocity_max, 0);
  EXPECT_LE((gathered.matrix() - accurate.matrix()).norm() / accurate.matrix().norm(), 0.08);
}

TEST(FormFactorRows, EqualTheAssembledKernel) {
  const auto mesh = room(300);
  const Eigen::MatrixXd F = compute(mesh, raw()).matrix();
  const FormFactorRows rows(mesh);
  for (const Index i : {Index{0}, Index{57}, mesh->patch_count() - 1}) {
    EXPECT_LE((rows.row(i).transpose() - F.row(i)).cwiseAbs().maxCoeff(), 1e-12) << i;
    EXPECT_LE((rows.column(i) - F.col(i)).cwiseAbs().maxCoeff(), 1e-12) << i;
  }
  const std::vector<Index> some = {3, 250, 77}, others = {1, 2, 290, 120};
  const Eigen::MatrixXd block = rows.block(some, others);
  for (std::size_t r = 0; r < some.size(); ++r)
    for (std::size_t c = 0; c < others.size(); ++c)
      EXPECT_NEAR(block(static_cast<Index>(r), static_cast<Index>(c)), F(some[r], others[c]), 1e-12);

  std::vector<int> groups;
  for (const Patch& patch : mesh->patches) groups.push_back(patch.group == 2 ? -1 : patch.group % 2);
  SilentMonitor monitor;
  const Eigen::MatrixXd panel = rows.panel(groups, 2, monitor);
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Zero(mesh->patch_count(), 2);
  for (Index j = 0; j < mesh->patch_count(); ++j)
    if (groups[static_cast<std::size_t>(j)] >= 0) wanted.col(groups[static_cast<std::size_t>(j)]) += F.col(j);
  EXPECT_LE((panel - wanted).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FormFactorRows, RefusePatchesThatAreNotThere) {
  const FormFactorRows rows(room(100));
  EXPECT_THROW(rows.row(-1), UsageError);
  EXPECT_THROW(rows.row(rows.patch_count()), UsageError);
  SilentMonitor monitor;
  EXPECT_THROW(rows.panel(std::vector<int>{0, 1}, 2, monitor), UsageError);
}

class KernelFile : public ::testing::Test {
 protected:
  KernelFile()
      : folder_(std::filesystem::temp_directory_path() / ("radiosity_kernel_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~KernelFile() override { std::filesystem::remove_all(folder_); }
  KernelFile(const KernelFile&) = delete;
  KernelFile& operator=(const KernelFile&) = delete;
  std::filesystem::path file() const { return folder_ / "kernel"; }

 private:
  std::filesystem::path folder_;
};

TEST_F(KernelFile, ComesBackBitForBit) {
  const auto mesh = room(150);
  for (const FormFactorMethod method : {FormFactorMethod::accurate, FormFactorMethod::gather}) {
    FormFactorOptions options;
    options.method = method;
    const FormFactors saved = compute(mesh, options);
    save_kernel(file(), saved);
    const FormFactors loaded = load_kernel(file(), mesh);
    EXPECT_EQ(loaded.matrix(), saved.matrix());
    EXPECT_EQ(loaded.exposed, saved.exposed);
    EXPECT_EQ(loaded.group_standard_error, saved.group_standard_error);
    EXPECT_EQ(loaded.quality.method, saved.quality.method);
    EXPECT_EQ(loaded.quality.rays, saved.quality.rays);
  }
}

TEST_F(KernelFile, BelongsToItsPatches) {
  save_kernel(file(), compute(room(150)));
  EXPECT_THROW(load_kernel(file(), room(300)), Error);
  Scene bent = built_in_scene("cornell-box-closed");
  for (Vector3& vertex : bent.vertices) vertex.x() *= 1.01;
  const auto other = std::make_shared<const PatchMesh>(make_patches(bent, {.patches = 150}));
  EXPECT_THROW(load_kernel(file(), other), Error);
}

TEST_F(KernelFile, DamageIsNoticedWhereverItIs) {
  const auto mesh = room(60);
  save_kernel(file(), compute(mesh));
  std::string content;
  {
    std::ifstream in(file(), std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto write = [&](const std::string& bytes) { std::ofstream(file(), std::ios::binary) << bytes; };
  for (const double part : {0.0, 0.001, 0.01, 0.3, 0.7, 0.9999}) {
    write(content.substr(0, static_cast<std::size_t>(part * static_cast<double>(content.size()))));
    EXPECT_THROW(load_kernel(file(), mesh), Error) << "cut at " << part;
  }
  for (std::size_t at = 0; at < content.size(); at += 1 + content.size() / 97) {
    std::string damaged = content;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write(damaged);
    EXPECT_THROW(load_kernel(file(), mesh), Error) << "byte " << at;
  }
}

}  // namespace
}  // namespace radiosity::testing
