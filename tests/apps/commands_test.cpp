#include "foundation/npy.hpp"
#include "process.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace radiosity::test {
namespace {

using Json = nlohmann::json;

Json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return Json::parse(stream);
}

/// Runs a command that must succeed without a word on standard error.
std::string succeed(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  const ProcessResult result = run_program(arguments, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  return result.output;
}

TEST(Commands, EachExplainsItself) {
  const TemporaryFolder folder;
  for (const std::string command : {"info", "form-factors", "solve", "compare", "reproduce", "bench"})
    EXPECT_NE(succeed({command, "--help"}, folder).find("--threads"), std::string::npos) << command;
  EXPECT_NE(succeed({"--help"}, folder).find("compare"), std::string::npos);
}

TEST(Info, ListsWhatThereIs) {
  const TemporaryFolder folder;
  const std::string text = succeed({"info", "--list"}, folder);
  for (const std::string word : {"cube", "rooms:n=2,door=0.3", "clutter:boxes=12", "cornell-box", "dense",
                                 "csr", "cg", "gmres", "neumann", "gauss-seidel", "lu"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(Info, DescribesTheCube) {
  const TemporaryFolder folder;
  succeed({"info", "cube", "--patches", "216", "--json", "cube.json"}, folder);
  const Json info = read_json(folder.path() / "cube.json");
  EXPECT_EQ(info["scene"]["name"], "cube");
  EXPECT_EQ(info["scene"]["triangles"], 12);
  EXPECT_EQ(info["scene"]["patches"], 216);
  EXPECT_EQ(info["scene"]["channels"], 1);
  EXPECT_EQ(info["scene"]["closed"], true);
  EXPECT_NEAR(info["scene"]["area"].get<double>(), 6, 1e-12);
  EXPECT_EQ(info["groups"].size(), 6u);
  EXPECT_GT(info["memory"]["dense:f64"], info["memory"]["dense:f16"]);
}

TEST(FormFactors, GivesTheMatrixAndTheGroups) {
  const TemporaryFolder folder;
  succeed({"form-factors", "cube", "--patches", "24", "--groups", "--json", "F.json", "-o", "F.npy"}, folder);
  const Eigen::MatrixXd F = read_npy(folder.path() / "F.npy");
  ASSERT_EQ(F.rows(), 24);
  EXPECT_LT((F.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-6);
  const Json json = read_json(folder.path() / "F.json");
  for (const std::string key :
       {"scene", "machine", "form_factors", "groups", "areas", "matrix", "standard_error"})
    EXPECT_TRUE(json.contains(key)) << key;
  // Opposite faces of a cube: 0.199824896 (closed form).
  EXPECT_NEAR(json["matrix"][0][1].get<double>(), 0.199824896, 1e-6);
}

TEST(Solve, LightsTheOriginalFromASimplifiedScene) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"solve",     "cornell-box-closed", "--patches", "60", "--simplify",
                                        "voxels:60", "--interpolate",      "--width",   "40", "--height",
                                        "40"};
  for (const char* file : {"B.npy", "B.glb", "B.ply", "B.png"})
    arguments.insert(arguments.end(), {"-o", file});
  arguments.insert(arguments.end(), {"--set", "left:emission=2", "--json", "B.json"});
  const std::string text = succeed(arguments, folder);
  EXPECT_NE(text.find("triangles became"), std::string::npos);
  const Json simplification = read_json(folder.path() / "B.json")["simplification"];
  const Eigen::MatrixXd B = read_npy(folder.path() / "B.npy");
  EXPECT_EQ(B.rows(), simplification["original_patches"].get<Eigen::Index>());
  EXPECT_NEAR(simplification["patches"].get<double>(), 60, 15);
  EXPECT_GE(B.maxCoeff(), 2);
  EXPECT_GT(B.minCoeff(), 0);
  for (const char* file : {"B.glb", "B.ply", "B.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
}

TEST(Solve, SimplifyingACubeToItsOwnPatchesChangesNothing) {
  const TemporaryFolder folder;
  succeed({"solve", "cube", "--patches", "54", "-o", "original.npy"}, folder);
  succeed({"solve", "cube", "--patches", "54", "--simplify", "voxels:54", "-o", "simplified.npy"}, folder);
  const Eigen::MatrixXd original = read_npy(folder.path() / "original.npy");
  const Eigen::MatrixXd simplified = read_npy(folder.path() / "simplified.npy");
  ASSERT_EQ(simplified.rows(), original.rows());
  EXPECT_LT((simplified - original).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Solve, FindsTheRadiosityOfTheCube) {
  // One patch a face, reflectance 0.5, one face emits 1 W/m^2: known values.
  const TemporaryFolder folder;
  const std::string text =
      succeed({"solve", "cube", "--tolerance", "1e-10", "-o", "B.npy", "--json", "B.json"}, folder);
  EXPECT_NE(text.find("ceiling"), std::string::npos);
  const Json json = read_json(folder.path() / "B.json");
  for (const Json& group : json["groups"]) {
    const double expected = group["name"] == "ceiling" ? 1.090909098
                            : group["name"] == "floor" ? 0.181745826
                                                       : 0.181836269;
    EXPECT_NEAR(group["radiosity"][0].get<double>(), expected, 2e-6) << group["name"];
  }
  EXPECT_NEAR(json["energy"]["absorbed"].get<double>(), json["energy"]["emitted"].get<double>(), 1e-8);
  EXPECT_EQ(read_npy(folder.path() / "B.npy").rows(), 6);
}

TEST(Solve, WritesEveryFormat) {
  const TemporaryFolder folder;
  succeed({"solve", "cube", "-o", "a.png", "-o", "a.exr", "-o", "a.glb", "-o", "a.ply", "-o", "a.npy",
           "--width", "40", "--height", "30"},
          folder);
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.exr", "a.glb", "a.npy", "a.ply", "a.png"}));
}

TEST(Solve, TakesItsMaterialsFromTheCommandLine) {
  const TemporaryFolder folder;
  write_npy(folder.path() / "E.npy", Eigen::MatrixXd::Ones(6, 1));
  // A furnace: B = E / (1 - rho).
  succeed({"solve", "cube", "--reflectance", "0.75", "--emission", "E.npy", "-o", "B.npy"}, folder);
  EXPECT_LT((read_npy(folder.path() / "B.npy").array() - 4).abs().maxCoeff(), 1e-5);
  succeed({"solve", "cube", "--set", "floor:reflectance=0.5/0.4/0.3,emission=2", "--set",
           "ceiling:emission=0", "-o", "B.npy"},
          folder);
  const Eigen::MatrixXd B = read_npy(folder.path() / "B.npy");
  ASSERT_EQ(B.cols(), 3);
  EXPECT_GT(B(0, 0), B(0, 1));
  EXPECT_GT(B(0, 1), B(0, 2));
}

TEST(Solve, CertifiesFromRowsComputedAfresh) {
  const TemporaryFolder folder;
  const auto certificate = [&](std::vector<std::string> arguments) {
    const std::vector<std::string> common = {"solve", "cube", "--patches", "96", "--json", "B.json"};
    arguments.insert(arguments.begin(), common.begin(), common.end());
    succeed(arguments, folder);
    std::ifstream file(folder.path() / "B.json");
    return nlohmann::json::parse(file).at("certificate");
  };
  const auto sampled = certificate({"--certificate-rows", "64"});
  EXPECT_EQ(sampled.at("kind"), "sampled");
  EXPECT_EQ(sampled.at("confidence"), 0.99);
  EXPECT_LT(sampled.at("bound").get<double>(), 0.01);
  EXPECT_EQ(certificate({"--certificate-rows", "200"}).at("kind"), "proved");
  // Form factors from one ray are several per cent off, and only fresh rows tell.
  const auto one_ray = certificate({"--form-factors", "one-ray", "--certificate-rows", "64"});
  EXPECT_GT(one_ray.at("bound").get<double>(), 0.02);
  EXPECT_LT(certificate({"--form-factors", "one-ray"}).at("bound").get<double>(), 1e-4);
}

TEST(Solve, WritesBoundsOnTheErrorOfEachPatch) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& tolerance, const std::string& stem) {
    succeed({"solve", "cornell-box", "--patches", "150", "--tolerance", tolerance, "-o", stem + ".npy",
             "--error-bounds", stem + "-bounds.npy"},
            folder);
    return read_npy(folder.path() / (stem + ".npy"));
  };
  const Eigen::MatrixXd rough = run("1e-3", "rough");
  const Eigen::MatrixXd errors = (rough - run("1e-12", "fine")).cwiseAbs();
  const Eigen::MatrixXd bounds = read_npy(folder.path() / "rough-bounds.npy");
  EXPECT_GE((bounds - errors).minCoeff(), 0);
  EXPECT_LT(bounds.norm(), 100 * errors.norm());
}

TEST(Solve, SetsOfGroupsAndLightsAgree) {
  const TemporaryFolder folder;
  const std::string dark = succeed({"solve", "cube", "--set", "ceiling:emission=0"}, folder);
  EXPECT_NE(dark.find("nothing emits"), std::string::npos);
  const std::string lit =
      succeed({"solve", "cube", "--set", "ceiling:emission=0", "--lights", "patch:1"}, folder);
  EXPECT_EQ(lit.find("nothing emits"), std::string::npos);
}

TEST(Solve, AgreesWithTheReferee) {
  const TemporaryFolder folder;
  succeed({"solve", "cube", "--patches", "96", "--reference", "--reference-paths", "256", "--json", "B.json"},
          folder);
  const Json reference = read_json(folder.path() / "B.json")["reference"];
  EXPECT_LT(std::abs(reference["mean_difference"].get<double>()),
            4 * reference["mean_difference_standard_error"].get<double>() + 0.01);
}

TEST(Solve, ReusesAKernel) {
  const TemporaryFolder folder;
  succeed({"solve", "cube", "--patches", "24", "--save", "cube.kernel", "-o", "first.npy"}, folder);
  succeed({"solve", "cube", "--patches", "24", "--kernel", "cube.kernel", "-o", "second.npy"}, folder);
  EXPECT_EQ(read_npy(folder.path() / "first.npy"), read_npy(folder.path() / "second.npy"));
}

TEST(Solve, DoesNotDependOnTheNumberOfThreads) {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "3"})
    succeed({"solve", "cornell-box", "--patches", "200", "--threads", threads, "-o", threads + ".npy"},
            folder);
  EXPECT_EQ(read_npy(folder.path() / "1.npy"), read_npy(folder.path() / "3.npy"));
}

TEST(Solve, TakesOperatorsThatAnswerByThemselves) {
  const TemporaryFolder folder;
  const auto solve = [&](const std::string& spec) {
    return succeed(
        {"solve", "cube", "--patches", "54", "--operator", spec, "-o", "B.npy", "--json", "B.json"}, folder);
  };
  EXPECT_NE(solve("svd:k=54,storage=f64,global=1").find("answers by itself"), std::string::npos);
  const Json json = read_json(folder.path() / "B.json");
  EXPECT_TRUE(json["solver"].is_null());
  EXPECT_TRUE(json["residual"].is_null());
  EXPECT_EQ(json["iterations"], 0);
  EXPECT_LE(json["certificate"]["bound"], 1e-10);
  const Eigen::MatrixXd B = read_npy(folder.path() / "B.npy");
  EXPECT_EQ(solve("dense").find("answers by itself"), std::string::npos);
  EXPECT_LE((B - read_npy(folder.path() / "B.npy")).norm(), 1e-5 * B.norm());
  solve("neumann-sparse:threshold=0");
  EXPECT_LE((B - read_npy(folder.path() / "B.npy")).norm(), 1e-5 * B.norm());
}

TEST(Compare, HasOneResultForEachOperator) {
  const TemporaryFolder folder;
  succeed({"compare", "cube", "--patches", "54", "--operators", "csr", "dense:f32", "--lights",
           "area:1,point:1,patch:1", "--json", "c.json", "--plot", "c.svg"},
          folder);
  const Json json = read_json(folder.path() / "c.json");
  ASSERT_EQ(json["results"].size(), 2u);
  EXPECT_EQ(json["results"][0]["operator"], "csr");
  EXPECT_EQ(json["results"][1]["operator"], "dense:f32");
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{"c.json", "c.svg"}));
}

}  // namespace
}  // namespace radiosity::test
