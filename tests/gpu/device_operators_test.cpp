#include "form_factors/exact_rooms.hpp"
#include "foundation/random.hpp"
#include "gpu/dense_on_device.hpp"
#include "gpu/gl_operators.hpp"
#include "gpu/upload.hpp"
#include "operators/low_rank_operator.hpp"
#include "operators/operator_checks.hpp"
#include "tests/conformance/transport_cases.hpp"
#include "tests/gpu/device_test.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace radiosity {
namespace {

double storage_roundoff(const std::string& spec) {
  if (spec.find("f64") != std::string::npos) return 0x1p-53;
  return spec.find("f16") != std::string::npos ? 0x1p-11 : 0x1p-24;
}

/// Every spec with either strategy.
class DeviceOperators : public DeviceTest, public testing::WithParamInterface<std::string> {
 protected:
  static OperatorRegistry registry() { return gl_operators(device(), cpu_operators()); }
};

/// D1: the plain reference is T in long double; what is stored in float32 or binary16 may be off by n u.
TEST_P(DeviceOperators, MultiplyAsThePlainArithmeticOfTheCpuDoes) {
  for (const Index n : {0, 1, 6, 70})
    for (TransportCase& data : transport_cases(n)) {
      SCOPED_TRACE(data.name);
      const auto transport = registry().make(GetParam(), data.form_factors);
      allow_storage_error(data, storage_roundoff(GetParam()));
      EXPECT_EQ(check_operator(*transport, data.reference), "");
      EXPECT_EQ(check_certificate(*transport, data.reference, data.root_area), "");
    }
}

class LimitedDevice : public DeviceTest {
 protected:
  /// Kernels of n patches, each in its own scale.
  static FormFactors random_room(Index n) {
    return symmetric_form_factors(random_kernel(n, 5), Eigen::VectorXd::Ones(n),
                                  Eigen::MatrixXd::Constant(n, 1, 0.7));
  }
};

TEST_F(LimitedDevice, SplitsWhatIsLargerThanAStorageBlockAndGivesTheSameBits) {
  constexpr Index n = 300;  // five strips of 64 rows, of 64 x 320 numbers
  const FormFactors form_factors = random_room(n);
  const Field X = Field::Random(n, 5);
  for (const char* strategy : {"strategy=group", "strategy=invocation"}) {
    const std::string spec = with_keys("dense:f32", strategy);
    const auto whole = gl_operators(device(), cpu_operators()).make(spec, form_factors);
    const auto split =
        gl_operators(device_with_blocks_of(2 * 64 * 320 * 4 + 4), cpu_operators()).make(spec, form_factors);
    Field Y(n, 5);
    Field Z(n, 5);
    whole->apply(X, Y);
    split->apply(X, Z);
    EXPECT_EQ(Y, Z) << strategy;
  }
}

TEST_F(LimitedDevice, SplitsIntoAsManyBlocksAsItMust) {
  const auto kernel = convert<float>(*random_room(300).kernel);
  for (const auto& [strips, blocks] : {std::pair{1, 5}, {2, 3}, {4, 2}, {5, 1}})
    EXPECT_EQ(DenseOnDevice<float>(device_with_blocks_of(strips * 64 * 320 * 4), kernel, RowStrategy::group)
                  .blocks(),
              static_cast<std::size_t>(blocks));
}

TEST_F(LimitedDevice, SplitsFactorsSparseMatricesAndTexturesToo) {
  constexpr Index n = 300;  // five panels of 64 rows, each of 2048 bytes with k = 8; five tiles of 2048 a row
  const FormFactors form_factors = random_room(n);
  const Field X = Field::Random(n, 5);
  const auto whole = gl_operators(device(), cpu_operators());
  const auto split_in = [&](Index bytes, const std::string& spec) {
    Field Y(n, 5);
    Field Z(n, 5);
    whole.make(spec, form_factors)->apply(X, Y);
    gl_operators(device_with_blocks_of(bytes), cpu_operators()).make(spec, form_factors)->apply(X, Z);
    EXPECT_LE((Y - Z).norm(), 1e-6 * Y.norm()) << spec;
  };
  for (const char* spec : {"svd:k=8", "svd:k=8,norm=area,method=lanczos", "sparse-v:k=8", "dxt:reorder=none"})
    split_in(2 * 2048, spec);
  split_in(2 * 2048 * 4, "csr:f32");  // by fours of rows
  for (const char* spec : {"svd:k=8,storage=f64", "sparse-v:k=8,storage=f64"}) split_in(4 * 2048, spec);
  split_in(2 * 5 * 2048, "dxt:codec=bc4,reorder=none");
}

/// Rows down to 2^-`graded` of the first, with signs, against sums in double of the same halves.
class HalvesOnDevice : public DeviceTest {
 protected:
  static void expect_plain_products(int graded, RowStrategy strategy) {
    constexpr Index n = 90;
    RandomStream random(7);
    const Eigen::MatrixXd numbers = Eigen::MatrixXd::NullaryExpr(n, n, [&](Index i, Index) {
      return std::ldexp(random.uniform() - 0.4, -static_cast<int>(i * graded / n));
    });
    const RowMajorMatrix<Half> halves(numbers);
    const Eigen::MatrixXd M =
        Eigen::MatrixXd::NullaryExpr(n, n, [&](Index i, Index j) { return halves(i, j); });
    const Field X = Field::NullaryExpr(n, 3, [&] { return random.uniform() - 0.5; });
    Field Y(n, 3);
    DenseOnDevice<Half>(device(), halves, strategy).multiply(X, Y);
    const Field allowed = (2 * (n + 8) * 0x1p-24) * (M.cwiseAbs() * X.cwiseAbs());
    EXPECT_TRUE(((Y - M * X).array().abs() <= allowed.array()).all()) << graded;
  }
};

TEST_F(HalvesOnDevice, MultiplyExactlyAboveAndBelowTheNormalRange) {
  for (const RowStrategy strategy : {RowStrategy::group, RowStrategy::invocation})
    for (const int graded : {0, 12, 38}) expect_plain_products(graded, strategy);
}

TEST_F(LimitedDevice, RefusesWhatDoesNotFitIntoItsStorageBlocks) {
  const auto registry = gl_operators(device_with_blocks_of(64 * 320 * 4 - 1), cpu_operators());
  EXPECT_NO_THROW(registry.make("dense:f16", random_room(300)));
  try {
    registry.make("dense:f32", random_room(300));
    FAIL() << "it was not refused";
  } catch (const Error& error) {
    for (const char* part : {"81920", "81919", "fewer patches", "--device cpu"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST_F(LimitedDevice, RefusesFieldsThatDoNotFitIntoItsStorageBlocks) {
  const auto registry = gl_operators(device_with_blocks_of(320 * 4 - 1), cpu_operators());
  try {
    registry.make("sparse-v:k=1", random_room(300));
    FAIL() << "it was not refused";
  } catch (const Error& error) {
    for (const char* part : {"1280", "1279", "--device cpu"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

using DeviceUses = LimitedDevice;

TEST_F(DeviceUses, AreToldByTheOperatorAndByWhatIsWrappedAroundIt) {
  const auto registry = gl_operators(device(), cpu_operators());
  for (const char* spec : {"dense:f32", "dense:f32,closure=symmetric", "dense:f16,closure=rows"}) {
    const auto transport = registry.make(spec, random_room(70));
    ASSERT_TRUE(transport->device_use().has_value()) << spec;
    EXPECT_EQ(transport->device_use()->renderer, device()->context()->renderer());
    EXPECT_GT(transport->device_use()->difference_max, 0) << "float32 sums in another order";
    EXPECT_LT(transport->device_use()->difference_max, 70 * 0x1p-24);
    EXPECT_GT(transport->device_use()->upload_seconds, 0);
    EXPECT_GT(transport->device_use()->device_seconds, 0);
  }
  EXPECT_FALSE(cpu_operators().make("dense:f32", random_room(70))->device_use().has_value());
}

TEST_F(DeviceUses, TakeAFairPartOfTheTimeOfALargeProduct) {
  constexpr Index n = 1000;
  const auto transport = gl_operators(device(), cpu_operators()).make("dense:f32", random_room(n));
  const Field X = Field::Random(n, 4);
  Field Y(n, 4);
  const double device_before = transport->device_use()->device_seconds;
  const double all_before = transport->usage().seconds;
  for (int repetition = 0; repetition < 3; ++repetition) transport->apply(X, Y);
  const double on_device = transport->device_use()->device_seconds - device_before;
  const double in_all = transport->usage().seconds - all_before;
  EXPECT_LT(on_device, in_all);
  EXPECT_GT(on_device, 0.05 * in_all);
}

/// Each is compared with the CPU's product when it is copied.
TEST_F(DeviceUses, AreThereForEveryOperatorOfTheRegistryAndForWhatIsSaidToBeTaken) {
  const auto registry = gl_operators(device(), cpu_operators());
  const FormFactors form_factors = random_room(70);
  std::vector<std::string> specs = uploadable_specs();
  for (const OperatorEntry& entry : registry.entries()) {
    specs.push_back(entry.defaults);
    specs.insert(specs.end(), entry.variants.begin(), entry.variants.end());
  }
  for (const std::string& spec : specs)
    EXPECT_TRUE(registry.make(spec, form_factors)->device_use().has_value()) << spec;
}

std::size_t bytes_of_part(const LinearOperator& transport, const std::string& name) {
  for (const auto& [part, bytes] : transport.bytes().parts)
    if (part == name) return bytes;
  return 0;
}

/// Full panels: there is no padding but the CPU's.
TEST_F(DeviceUses, OfGlobalOperatorsHaveOneVForAllReflectances) {
  const FormFactors F = form_factors_of(exact_rooms::open_room(128, 3, 3));
  for (const char* spec : {"svd:k=20,global=1", "svd:k=20,storage=f64,global=1"}) {
    const auto original = cpu_operators().make(spec, F);
    const auto copy = gl_operators(device(), cpu_operators()).make(spec, F);
    for (const char* part : {"Y", "V"})
      EXPECT_EQ(bytes_of_part(*copy, part), bytes_of_part(*original, part)) << spec << " " << part;
  }
}

TEST_F(DeviceUses, OfGlobalOperatorsThatNeedDoublePrecisionHaveIt) {
  const auto registry = gl_operators(device(), cpu_operators());
  const auto roundoff = [&](double reflectance) {
    const FormFactors F = form_factors_of(exact_rooms::sphere_cavity(70, 4, reflectance));
    return registry.make("svd:k=4,global=1", F)->product_roundoff();
  };
  EXPECT_EQ(roundoff(0.9), 0x1p-24);
  EXPECT_EQ(roundoff(1 - 1e-6), 0x1p-53) << "Y is in float64 on the CPU too";
}

TEST_F(DeviceUses, OfGlobalOperatorsTakeNoClosure) {
  const auto registry = gl_operators(device(), cpu_operators());
  for (const char* spec : {"svd:k=4,global=1,closure=rows", "dense:f32,global=1"})
    EXPECT_THROW(registry.make(spec, random_room(70)), UsageError) << spec;
}

/// Closures are around what is on a device.
TEST_F(DeviceUses, OfOperatorsWithoutAFormForTheDeviceAreRefusedWithAListOfThoseThatHaveOne) {
  const auto closed = cpu_operators().make("dense:f32,closure=rows", random_room(6));
  try {
    upload(device(), *closed);
    ADD_FAILURE() << "it was not refused";
  } catch (const UsageError& error) {
    for (const char* part : {"closure=rows cannot run", "dense:f64, dense:f32, dense:f16"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

/// 64 columns are on the device at a time, and three channels do not divide them.
TEST_F(LimitedDevice, KeepsTheChannelsOfManyColumnsApart) {
  constexpr Index n = 70;
  Eigen::MatrixXd reflectance(n, 3);
  reflectance << Eigen::VectorXd::Constant(n, 0.2), Eigen::VectorXd::Constant(n, 0.5),
      Eigen::VectorXd::Constant(n, 0.8);
  const FormFactors form_factors =
      symmetric_form_factors(random_kernel(n, 5), Eigen::VectorXd::Ones(n), reflectance);
  const Field X = Field::Random(n, 3 * 25);
  for (const char* spec : {"dxt:reorder=none", "dxt:codec=bf16,reorder=none", "dense:f32"}) {
    Field Y(n, X.cols());
    Field Z(n, X.cols());
    cpu_operators().make(spec, form_factors)->apply(X, Y);
    gl_operators(device(), cpu_operators()).make(spec, form_factors)->apply(X, Z);
    EXPECT_LE((Y - Z).norm(), 1e-6 * Y.norm()) << spec;
  }
}

/// A device that loses one entry of 130 x 130 is found out by the comparison with its original.
TEST(CompareProducts, RefusesACopyThatComputesSomethingElse) {
  const Index n = 130;
  Eigen::MatrixXd kernel = random_kernel(n, 7);
  const Eigen::VectorXd area = Eigen::VectorXd::Ones(n);
  const Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(n, 1, 0.7);
  const auto original = cpu_operators().make("dense:f32", symmetric_form_factors(kernel, area, reflectance));
  const auto rounded = cpu_operators().make("dense", symmetric_form_factors(kernel, area, reflectance));
  EXPECT_LT(compare_products(*original, *rounded, "a device"), n * 0x1p-24);
  kernel(3, 5) = kernel(5, 3) += 0.5 / static_cast<double>(n);
  const auto wrong = cpu_operators().make("dense:f32", symmetric_form_factors(kernel, area, reflectance));
  try {
    compare_products(*original, *wrong, "a device");
    ADD_FAILURE() << "it was not noticed";
  } catch (const Error& error) {
    for (const char* part : {"dense:f32", "a device", "--device cpu"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(CompareProducts, RefusesInDoublePrecisionWhatIsOffByABillionth) {
  const Index n = 130;
  Eigen::MatrixXd kernel = random_kernel(n, 7);
  const auto in_double = [&] {
    return cpu_operators().make("dense", symmetric_form_factors(kernel, Eigen::VectorXd::Ones(n),
                                                                Eigen::MatrixXd::Constant(n, 1, 0.7)));
  };
  const auto original = in_double();
  EXPECT_NO_THROW(compare_products(*original, *in_double(), "a device"));
  kernel(3, 5) = kernel(5, 3) += 1e-9 / static_cast<double>(n);
  EXPECT_THROW(compare_products(*original, *in_double(), "a device"), Error);
}

TEST_F(LimitedDevice, RefusesTwoPlacesForWhatHasNotTwoFactors) {
  const auto registry = gl_operators(device(), cpu_operators());
  for (const char* spec : {"svd:k=8,norm=area,method=lanczos,placement=hybrid", "dense:f32,placement=hybrid",
                           "svd:k=8,storage=f64,placement=hybrid",
                           "sparse-v:k=8,storage=f64,placement=hybrid", "svd:k=8,global=1,placement=hybrid"})
    EXPECT_THROW(registry.make(spec, random_room(70)), UsageError) << spec;
}

/// Four columns are on the device at a time; the CPU has the next.
TEST_F(LimitedDevice, MultipliesMoreColumnsThanTwoPlacesPassOnAtATime) {
  const FormFactors form_factors = random_room(70);
  const Field X = Field::Random(70, 10);
  for (const char* spec : {"svd:k=8", "sparse-v:k=8"}) {
    const auto whole = cpu_operators().make(spec, form_factors);
    const auto hybrid =
        gl_operators(device(), cpu_operators()).make(with_keys(spec, "placement=hybrid"), form_factors);
    Field Y(70, 10);
    Field Z(70, 10);
    whole->apply(X, Y);
    hybrid->apply(X, Z);
    EXPECT_LE((Y - Z).norm(), 1e-6 * Y.norm()) << spec;
    EXPECT_GT(hybrid->device_use()->device_seconds, 0);
  }
}

std::string spec_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

/// Whether operators of a spec are made of symmetric kernels alone.
bool takes_symmetric_kernels_alone(const std::string& spec) {
  for (const char* part : {"norm=area", "sides=two", "quantized", "topk", "matrix=kernel"})
    if (spec.find(part) != std::string::npos) return true;
  return false;
}

/// Operators that are made of approximations: the plain reference is the CPU's operator, entry by entry.
class DeviceCopies : public DeviceOperators {
 protected:
  /// The keys at the end of a spec that only devices know.
  static std::string strategy() {
    const std::size_t begin = GetParam().find(",strategy=");
    return begin == std::string::npos ? "" : GetParam().substr(begin);
  }
  static bool in_double() { return GetParam().find("storage=f64") != std::string::npos; }
  static std::string without_strategy(const std::string& spec) {
    return spec.substr(0, spec.size() - strategy().size());
  }
  /// Closures are around what is on the device: their key comes last.
  static std::string with_strategy(const std::string& spec) {
    const std::size_t closure = std::min(spec.find(",closure="), spec.size());
    return spec.substr(0, closure) + strategy() + spec.substr(closure);
  }
};

TEST_P(DeviceCopies, MultiplyAsTheOperatorThatTheyAreCopiesOf) {
  for (const Index n : {1, 70})
    for (const TransportCase& data : transport_cases(n)) {
      if (!data.form_factors.symmetric() && takes_symmetric_kernels_alone(GetParam())) continue;
      SCOPED_TRACE(data.name);
      const auto original = cpu_operators().make(without_strategy(GetParam()), data.form_factors);
      const auto copy = registry().make(GetParam(), data.form_factors);
      EXPECT_EQ(copy->describe(), with_strategy(original->describe()));
      EXPECT_EQ(copy->symmetric(), original->symmetric());
      EXPECT_EQ(copy->global(), original->global());
      if (in_double()) {
        EXPECT_EQ(copy->product_roundoff(), 0x1p-53);
      }
      OperatorReference entries = own_entries(*original);
      entries.unit_roundoff = std::max(entries.unit_roundoff, copy->product_roundoff());
      EXPECT_EQ(check_operator(*copy, entries), "");
      const auto* left = dynamic_cast<const LowRankFactors*>(original.get());
      const auto* right = dynamic_cast<const LowRankFactors*>(copy.get());
      ASSERT_EQ(left == nullptr, right == nullptr);
      if (left != nullptr) {
        const Field ones = Field::Ones(n, 1);
        const Eigen::MatrixXd expected = left->multiply_between(ones).front();
        const double allowed = 1e-5 * copy->product_roundoff() / 0x1p-24;
        EXPECT_LE((right->multiply_between(ones).front() - expected).norm(), allowed * expected.norm());
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Stored, DeviceOperators,
                         testing::Values("dense:f64,strategy=group", "csr:f64,strategy=invocation",
                                         "dense:f64,strategy=invocation", "dense:f32,strategy=group",
                                         "dense:f32,strategy=invocation", "dense:f16,strategy=group",
                                         "dense:f16,strategy=invocation", "csr:f32,strategy=group",
                                         "csr:f32,strategy=invocation"),
                         spec_name);

INSTANTIATE_TEST_SUITE_P(Factors, DeviceCopies,
                         testing::Values("svd:k=8,strategy=group", "svd:k=9,strategy=invocation",
                                         "svd:k=19,norm=area,method=lanczos,strategy=invocation", "2msc:k=8",
                                         "2msc:k=9,sides=two,strategy=group", "sparse-v:k=8,strategy=group",
                                         "sparse-v:k=7,strategy=invocation",
                                         "svd:k=8,strategy=group,placement=hybrid",
                                         "sparse-v:k=7,strategy=invocation,placement=hybrid"),
                         spec_name);
INSTANTIATE_TEST_SUITE_P(FactorsInDouble, DeviceCopies,
                         testing::Values("svd:k=9,storage=f64,strategy=invocation",
                                         "svd:k=19,norm=area,method=lanczos,storage=f64,strategy=group",
                                         "2msc:k=9,sides=two,storage=f64,strategy=group",
                                         "sparse-v:k=8,storage=f64,strategy=group",
                                         "sparse-v:k=7,storage=f64,strategy=invocation"),
                         spec_name);
INSTANTIATE_TEST_SUITE_P(Global, DeviceCopies,
                         testing::Values("svd:k=8,global=1,strategy=group",
                                         "svd:k=9,storage=f64,global=1,strategy=invocation",
                                         "svd:k=19,norm=area,method=lanczos,global=1,strategy=invocation",
                                         "2msc:k=9,sides=two,storage=f64,global=1,strategy=group",
                                         "sparse-v:k=8,global=1,strategy=group",
                                         "sparse-v:k=7,storage=f64,global=1,strategy=invocation"),
                         spec_name);
INSTANTIATE_TEST_SUITE_P(Bounces, DeviceCopies,
                         testing::Values("bounces:k=3,storage=f32", "bounces:k=2,storage=f16"), spec_name);

INSTANTIATE_TEST_SUITE_P(
    Textures, DeviceCopies,
    testing::Values("dxt:reorder=rows,strategy=group", "dxt:reorder=rows,strategy=invocation",
                    "dxt:bounces=3,reorder=none,map=linear", "dxt:codec=bc4,fill=1,strategy=group",
                    "dxt:codec=bc4,map=linear,strategy=invocation", "dxt:bounces=2,codec=bc4,range=auto",
                    "dxt:codec=u8,strategy=group", "dxt:bounces=2,codec=f16,reorder=none"),
    spec_name);

INSTANTIATE_TEST_SUITE_P(Tiles, DeviceCopies,
                         testing::Values("quantized:closure=none,strategy=group",
                                         "quantized:bits=8,closure=none,strategy=invocation",
                                         "topk:closure=none,strategy=group",
                                         "dxt:matrix=kernel,reorder=rows,strategy=group",
                                         "dxt:matrix=kernel,codec=u4,range=6,fill=1,strategy=invocation"),
                         spec_name);

INSTANTIATE_TEST_SUITE_P(Series, DeviceCopies,
                         testing::Values("neumann-sparse:bounces=99,strategy=group",
                                         "neumann-sparse:threshold=1e-3,bounces=3,strategy=invocation"),
                         spec_name);

}  // namespace
}  // namespace radiosity
