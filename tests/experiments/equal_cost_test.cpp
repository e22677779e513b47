#include "experiments/low_rank_radiosity/equal_cost.hpp"
#include "foundation/error.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity {
namespace {

TEST(EqualCost, InterpolatesCostsAndErrors) {
  const std::vector<CostedOperator> one_sided = {{10, 110, 1, 0.4}, {20, 210, 2, 0.2}, {40, 410, 4, 0.1}};
  const auto equal = at_equal_cost(one_sided, &CostedOperator::bytes, 210);
  ASSERT_TRUE(equal);
  EXPECT_NEAR(equal->k, 20, 1e-12);
  EXPECT_NEAR(equal->error, 0.2, 1e-12);
  const auto between = at_equal_cost(one_sided, &CostedOperator::seconds, 2 * std::sqrt(2.0));
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->error, 0.1 * std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(at_equal_cost(one_sided, &CostedOperator::bytes, 1000));
  EXPECT_THROW(at_equal_cost({one_sided.front()}, &CostedOperator::bytes, 100), UsageError);
}

TEST(EqualCost, TwoSidesHaveLessErrorForTheBytesOfOne) {
  const TemporaryFolder temporary;
  SilentMonitor monitor;
  EqualCostOptions options;
  options.scenes = {"cornell-box-closed"};
  options.patches = 300;
  options.ranks = {60};
  const std::vector<EqualCostRow> rows = measure_equal_cost(options, cpu_operators(), cpu_solvers(), monitor);
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_TRUE(rows[0].at_equal_bytes);
  EXPECT_NEAR(rows[0].at_equal_bytes->k, 60, 6);
  EXPECT_LT(rows[0].two_sided.error, rows[0].at_equal_bytes->error);
  const ReportSection section =
      equal_cost(temporary.path(), "command", options, cpu_operators(), cpu_solvers(), monitor);
  EXPECT_NO_THROW(to_html({"report", "", "", {section}}));
}

}  // namespace
}  // namespace radiosity
