#include "factorizations/lapack.hpp"
#include "form_factors/exact_rooms.hpp"
#include "foundation/error.hpp"
#include "operators/global_operator.hpp"
#include "operators/operator_checks.hpp"
#include "operators/operator_registry.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

using exact_rooms::Room;

Field image_of(const LinearOperator& transport, const Field& X) {
  Field Y(X.rows(), X.cols());
  transport.apply(X, Y);
  return Y;
}

/// (I - T)^-1 E with the entries of T that the operator has, one column a channel.
Field answer_by_entries(const LinearOperator& transport, const Field& E) {
  const OperatorReference own = own_entries(transport);
  Field B(E.rows(), E.cols());
  for (Index j = 0; j < E.cols(); ++j) {
    const Eigen::MatrixXd T = own.matrix[static_cast<std::size_t>(j % own.channels())].cast<double>();
    B.col(j) = LuFactors(Eigen::MatrixXd::Identity(T.rows(), T.cols()) - T).solve(E.col(j));
  }
  return B;
}

std::string sentence(const FormFactors& form_factors, const std::string& spec) {
  try {
    cpu_operators().make(spec, form_factors);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GlobalOperator, IsTheInverseOfItsOperatorInEveryColour) {
  const FormFactors F = form_factors_of(exact_rooms::open_room(70, 3, 3));
  const Field E = exact_rooms::random_lights(70, 6, 4);
  for (const std::string spec : {"svd:k=9", "svd:k=70,norm=area", "rsvd:k=20,norm=area"})
    for (const double unit_roundoff : {0x1p-24, 0x1p-53}) {
      const std::string stored = spec + (unit_roundoff == 0x1p-53 ? ",storage=f64" : ",storage=f32");
      const auto transport = cpu_operators().make(stored, F);
      const auto global = cpu_operators().make(stored + ",global=1", F);
      const Field exact = answer_by_entries(*transport, E);
      EXPECT_TRUE(global->global());
      EXPECT_FALSE(transport->global());
      EXPECT_LE((image_of(*global, E) - exact).norm(), 200 * unit_roundoff * exact.norm()) << stored;
      EXPECT_GT((image_of(*transport, E) + E - exact).norm(), 1e-2 * exact.norm()) << "one bounce is less";
    }
}

TEST(GlobalOperator, OfFullRankAnswersExactly) {
  const Room room = exact_rooms::closed_room(60, 2, 0.9);
  const auto global = cpu_operators().make("svd:k=60,storage=f64,global=1", form_factors_of(room));
  const Field B = image_of(*global, Field::Ones(60, 1));
  EXPECT_LE((B.array() - 10).abs().maxCoeff(), 1e-12);
}

TEST(GlobalOperator, CountsOneFactorAReflectance) {
  Room room = exact_rooms::open_room(128, 3, 3);
  const auto part = [&](const std::string& spec, const std::string& name) {
    for (const auto& [kind, bytes] : cpu_operators().make(spec, form_factors_of(room))->bytes().parts)
      if (kind == name) return bytes;
    return std::size_t{0};
  };
  const std::size_t three = part("svd:k=64,global=1", "Y");
  EXPECT_EQ(three, 3 * 128 * 64 * sizeof(float));
  EXPECT_EQ(part("svd:k=64,global=1,storage=f64", "Y"), 2 * three);
  EXPECT_EQ(part("svd:k=64,global=1", "V"), part("svd:k=64", "V"));
  room.reflectance.col(2) = room.reflectance.col(0);
  EXPECT_EQ(part("svd:k=64,global=1", "Y"), three / 3 * 2);
  EXPECT_EQ(part("svd:k=64,global=1,norm=area", "V"), part("svd:k=64,norm=area", "Q") + 128 * sizeof(double));
}

TEST(GlobalOperator, RefusesWhatHasNoInverseOrIsNotOfLowRank) {
  const FormFactors F = form_factors_of(exact_rooms::open_room(20, 3, 1));
  EXPECT_NE(sentence(F, "dense:global=1").find("low rank"), std::string::npos);
  EXPECT_NE(sentence(F, "neumann-sparse:global=1").find("low rank"), std::string::npos);
  EXPECT_NE(sentence(F, "svd:k=4,closure=rows,global=1").find("low rank"), std::string::npos);
  EXPECT_NE(sentence(F, "neumann-sparse:closure=rows").find("leave the closure away"), std::string::npos);
  EXPECT_NE(sentence(form_factors_of(exact_rooms::sphere_cavity(30, 4, 1)), "svd:k=1,storage=f64,global=1")
                .find("singular"),
            std::string::npos);
  Room growing = exact_rooms::closed_room(30, 4, 0.9);
  growing.kernel *= 1.2;
  EXPECT_NE(sentence(form_factors_of(growing), "svd:k=30,global=1").find("grow at every bounce"),
            std::string::npos);
  EXPECT_EQ(sentence(form_factors_of(growing), "svd:k=30"), "");
}

TEST(NeumannSparse, SumsWhatIsLeftOfEveryBounce) {
  const Room room = exact_rooms::open_room(70, 5, 3);
  const FormFactors F = form_factors_of(room);
  const Field E = exact_rooms::random_lights(70, 3, 6);
  const auto T = cpu_operators().make("dense", F);
  const Field exact = answer_by_entries(*T, E);
  const auto error = [&](const std::string& keys) {
    return (image_of(*cpu_operators().make("neumann-sparse:" + keys, F), E) - exact).norm() / exact.norm();
  };
  EXPECT_LE(error("threshold=0"), 1e-6);
  EXPECT_LT(error("threshold=0"), error("threshold=1e-3"));
  EXPECT_LT(error("threshold=1e-3"), error("threshold=1e-2"));
  Field two = image_of(*T, E);
  two += E + image_of(*T, two);
  const auto bounces = cpu_operators().make("neumann-sparse:threshold=0,bounces=2", F);
  EXPECT_LE((image_of(*bounces, E) - two).norm(), 1e-6 * two.norm());
  EXPECT_NE(bounces->remark().find("2 powers"), std::string::npos) << bounces->remark();
  EXPECT_NE(bounces->remark().find("further powers"), std::string::npos) << bounces->remark();
}

TEST(NeumannSparse, KeepsOneMatrixAReflectance) {
  Room room = exact_rooms::open_room(40, 5, 3);
  const auto entries = [&] {
    return cpu_operators().make("neumann-sparse:threshold=0", form_factors_of(room))->bytes().parts[0].second;
  };
  const std::size_t three = entries();
  room.reflectance.col(1) = room.reflectance.col(0);
  room.reflectance.col(2) = room.reflectance.col(0);
  EXPECT_LT(entries(), three / 2);
}

}  // namespace
}  // namespace radiosity
