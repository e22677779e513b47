#include "experiments/low_rank_radiosity/moved_object.hpp"
#include "form_factors/form_factors.hpp"
#include "form_factors/moved_pairs.hpp"
#include "foundation/error.hpp"
#include "operators/direct_two_mesh.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

MovedObjectOptions small_room() {
  MovedObjectOptions options;
  options.patches = 500;
  options.coarse_patches = 100;
  options.steps = 2;
  return options;
}

TEST(MovedObject, IsFollowedByUpdatedFactors) {
  SilentMonitor monitor;
  const MovedObject object = measure_moved_object(small_room(), monitor);
  ASSERT_EQ(object.steps.size(), 2U);
  for (const MovedObjectStep& step : object.steps) {
    EXPECT_GT(step.changed, 0.02);
    EXPECT_LT(step.changed, 0.8);
    EXPECT_LE(step.factor_difference, 1e-3);
    EXPECT_NEAR(step.updated_error, step.rebuilt_error, 1e-3);
    EXPECT_LT(step.updated_error, 0.08);
    EXPECT_GT(step.stale_error, 1.5 * step.updated_error) << "it matters that the box has moved";
  }
  EXPECT_LT(object.steps[0].place, object.steps[1].place);
}

TEST(MovedObject, IsInAReport) {
  const TemporaryFolder temporary;
  SilentMonitor monitor;
  MovedObjectOptions options = small_room();
  options.steps = 1;
  const ReportSection section = moved_object(temporary.path() / "results", "command", options, monitor);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
  EXPECT_TRUE(fs::exists(temporary.path() / "results/low_rank_motion.json"));
  EXPECT_TRUE(fs::exists(temporary.path() / "results/low_rank_motion.png"));
}

TEST(MovedObject, RefusesTooFewPatchesAndNoSteps) {
  SilentMonitor monitor;
  MovedObjectOptions options = small_room();
  options.coarse_patches = 10;
  EXPECT_THROW(measure_moved_object(options, monitor), UsageError);
  options = small_room();
  options.steps = 0;
  EXPECT_THROW(measure_moved_object(options, monitor), UsageError);
}

std::shared_ptr<const PatchMesh> room_mesh(double place, Index patches) {
  return std::make_shared<const PatchMesh>(make_patches(room_with_hovering_box(place), {.patches = patches}));
}

std::vector<bool> faces_of_the_box(const Scene& scene) {
  std::vector<bool> moved;
  for (const Face& face : scene.faces)
    moved.push_back(scene.groups[static_cast<std::size_t>(face.group)] == "box");
  return moved;
}

TEST(MovedPairs, MissNoFormFactorThatChanges) {
  const auto before = room_mesh(1.5, 400), after = room_mesh(2.1, 400);
  SilentMonitor monitor;
  const FormFactors F = compute_form_factors(before, {.closure = Closure::none}, monitor);
  const FormFactors G = compute_form_factors(after, {.closure = Closure::none}, monitor);
  const MovedPairs pairs(*before, *after, *after, faces_of_the_box(*after->scene));
  Index unchanged = 0, missed = 0;
  double largest_by_shadow = 0;
  for (Index i = 0; i < F.patch_count(); ++i)
    for (Index j = 0; j < F.patch_count(); ++j) {
      const double difference = std::fabs(F(i, j) - G(i, j));
      if (!pairs.has_moved(i, j)) largest_by_shadow = std::max(largest_by_shadow, difference);
      if (pairs(i, j)) continue;
      ++unchanged;
      if (difference > 1e-12) ++missed;
    }
  EXPECT_GT(unchanged, F.patch_count() * F.patch_count() / 3);
  EXPECT_EQ(missed, 0);
  EXPECT_GT(largest_by_shadow, 1e-3) << "shadows matter";
}

TEST(MovedPairs, RefuseMeshesThatDoNotFit) {
  const auto before = room_mesh(1.5, 400), after = room_mesh(2.1, 500);
  EXPECT_THROW(MovedPairs(*before, *after, *after, faces_of_the_box(*after->scene)), UsageError);
  EXPECT_THROW(MovedPairs(*after, *after, *after, {true}), UsageError);
}

}  // namespace
}  // namespace radiosity
