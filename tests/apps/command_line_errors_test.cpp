#include "form_factors/kernel_file.hpp"
#include "foundation/npy.hpp"
#include "process.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace radiosity::test {
namespace {

/// A command line that must be refused: with which exit code, and what the one line of the message must
/// contain.
struct Refusal {
  std::string name;
  std::vector<std::string> arguments;
  int exit_code;
  std::vector<std::string> words;
};

void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

/// A folder with files that the command lines below name.
class FilledFolder : public TemporaryFolder {
 public:
  FilledFolder() {
    write("truncated.obj", "v 0 0 0\nv 1 0 0\nv 1 1\n");
    write("nan.obj", "v 0 0 0\nv 1 0 nan\nv 1 1 0\nf 1 2 3\n");
    write("bad-index.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n");
    write("empty.obj", "");
    write("truncated.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    write("unknown.xyz", "0 0 0\n");
    write("path.txt", "0.5 0.5 0.5\n0.5 0.6\n");
    write("short.txt", "0.5 0.5 0.5\n");
    write("garbage.npy", "this is no array");
    write("garbage.kernel", "this is no kernel");
    std::filesystem::create_directory(path() / "folder.npy");
    write_npy(path() / "five-rows.npy", Eigen::MatrixXd::Ones(5, 1));
    write_npy(path() / "two-columns.npy", Eigen::MatrixXd::Ones(6, 2));
    write_npy(path() / "negative.npy", -Eigen::MatrixXd::Ones(6, 1));
    SilentMonitor monitor;
    const auto cube = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube")));
    save_kernel(path() / "cube.kernel", compute_form_factors(cube, {}, monitor));
  }
};

std::string joined(const std::vector<std::string>& words) {
  std::string text = "radiosity";
  for (const std::string& word : words) text += " " + word;
  return text;
}

std::string refusal_name(const testing::TestParamInfo<Refusal>& parameter) {
  return parameter.param.name;
}

class CommandLineRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(CommandLineRefusal, SaysWhyInOneLineAndLeavesNothing) {
  const Refusal& refusal = GetParam();
  const FilledFolder folder;
  const std::vector<std::string> before = folder.entries();
  const ProcessResult result = run_program(refusal.arguments, folder.path());
  SCOPED_TRACE(joined(refusal.arguments) + "\n" + result.errors);
  EXPECT_EQ(result.exit_code, refusal.exit_code);
  EXPECT_EQ(result.errors.rfind("radiosity: ", 0), 0u);
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1);
  EXPECT_EQ(result.errors.find('\r'), std::string::npos);
  for (const std::string& word : refusal.words)
    EXPECT_NE(result.errors.find(word), std::string::npos) << word;
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(folder.entries(), before);
}

const std::string to_file = "out.npy";

INSTANTIATE_TEST_SUITE_P(
    Commands, CommandLineRefusal,
    testing::Values(Refusal{"no_command", {}, 2, {"subcommand"}},
                    Refusal{"unknown_command", {"illuminate", "cube"}, 2, {"illuminate", "solve", "compare"}},
                    Refusal{"unknown_option", {"solve", "cube", "--brightness", "3"}, 2, {"--brightness"}},
                    Refusal{"two_scenes", {"solve", "cube", "cornell-box"}, 2, {"cornell-box"}},
                    Refusal{"solve_without_scene", {"solve"}, 2, {"SCENE"}},
                    Refusal{"info_without_scene", {"info"}, 2, {"SCENE"}},
                    Refusal{"form_factors_without_scene", {"form-factors", "--groups"}, 2, {"SCENE"}},
                    Refusal{"compare_without_scene",
                            {"compare", "--operators", "dense", "csr"},
                            2,
                            {"SCENE", "--operators"}},
                    Refusal{"compare_swallowed_scene",
                            {"compare", "--operators", "dense", "csr", "cube"},
                            2,
                            {"SCENE", "'cube'"}},
                    Refusal{"compare_without_operators", {"compare", "cube"}, 2, {"--operators"}},
                    Refusal{"unknown_benchmark", {"bench", "dreams"}, 2, {"dreams", "apply", "form-factors"}},
                    Refusal{"unknown_table", {"reproduce", "no-such-table"}, 2, {"no-such-table"}}),
    refusal_name);

INSTANTIATE_TEST_SUITE_P(
    Scenes, CommandLineRefusal,
    testing::Values(
        Refusal{"unknown_scene", {"solve", "cubus"}, 2, {"cubus", "cube", "cornell-box"}},
        Refusal{"missing_file", {"info", "missing.obj"}, 1, {"missing.obj"}},
        Refusal{"folder_for_scene", {"info", "."}, 2, {"'.'"}},
        Refusal{"unknown_format", {"info", "unknown.xyz"}, 1, {"unknown.xyz"}},
        Refusal{"truncated_obj", {"solve", "truncated.obj", "-o", to_file}, 1, {"truncated.obj", "3"}},
        Refusal{"nan_in_obj", {"solve", "nan.obj", "-o", to_file}, 1, {"nan.obj", "2"}},
        Refusal{"bad_index_in_obj", {"solve", "bad-index.obj"}, 1, {"bad-index.obj", "4"}},
        Refusal{"empty_obj", {"solve", "empty.obj"}, 1, {"empty.obj"}},
        Refusal{"truncated_ply", {"solve", "truncated.ply"}, 1, {"truncated.ply"}}),
    refusal_name);

INSTANTIATE_TEST_SUITE_P(
    Meshes, CommandLineRefusal,
    testing::Values(
        Refusal{"patches_zero", {"solve", "cube", "--patches", "0"}, 2, {"--patches", "'0'"}},
        Refusal{"patches_negative", {"solve", "cube", "--patches", "-6"}, 2, {"--patches"}},
        Refusal{"patches_no_number", {"solve", "cube", "--patches", "many"}, 2, {"--patches", "many"}},
        Refusal{"patches_fraction", {"solve", "cube", "--patches", "6.5"}, 2, {"--patches", "6.5"}},
        Refusal{"patches_nan", {"solve", "cube", "--patches", "nan"}, 2, {"--patches", "nan"}},
        Refusal{"too_few_patches", {"solve", "cornell-box", "--patches", "3"}, 2, {"3"}},
        Refusal{"too_many_for_memory", {"solve", "cube", "--patches", "600000"}, 1, {"memory", "TB"}},
        Refusal{"edge_zero", {"solve", "cube", "--edge", "0"}, 2, {"--edge"}},
        Refusal{"edge_negative", {"solve", "cube", "--edge", "-1"}, 2, {"--edge"}},
        Refusal{"edge_nan", {"solve", "cube", "--edge", "nan"}, 2, {"--edge", "nan"}},
        Refusal{"edge_infinite", {"solve", "cube", "--edge", "inf"}, 2, {"--edge", "inf"}},
        Refusal{"patches_and_edge",
                {"solve", "cube", "--patches", "24", "--edge", "1"},
                2,
                {"--patches", "--edge"}},
        Refusal{"simplify_unknown_way",
                {"solve", "cube", "--simplify", "edges:100"},
                2,
                {"edges:100", "voxels:N"}},
        Refusal{"simplify_without_number", {"solve", "cube", "--simplify", "voxels"}, 2, {"voxels:N"}},
        Refusal{"simplify_zero", {"solve", "cube", "--simplify", "voxels:0"}, 2, {"voxels:0", "1 to"}},
        Refusal{"simplify_empty", {"solve", "cube", "--simplify", ""}, 2, {"--simplify", "voxels:N"}},
        Refusal{"simplify_with_error_bounds",
                {"solve", "cube", "--simplify", "voxels:24", "--error-bounds", "b.npy"},
                2,
                {"--simplify", "--error-bounds"}},
        Refusal{"simplify_kernel_of_original",
                {"solve", "cube", "--simplify", "voxels:24", "--kernel", "cube.kernel"},
                1,
                {"cube.kernel"}}),
    refusal_name);

INSTANTIATE_TEST_SUITE_P(
    Materials, CommandLineRefusal,
    testing::Values(
        Refusal{"reflectance_one",
                {"solve", "cube", "--reflectance", "1"},
                1,
                {"reflectance", "--max-reflectance"}},
        Refusal{
            "reflectance_above_one", {"solve", "cube", "--reflectance", "1.5"}, 2, {"--reflectance", "1.5"}},
        Refusal{"reflectance_negative", {"solve", "cube", "--reflectance", "-0.1"}, 2, {"--reflectance"}},
        Refusal{"reflectance_nan", {"solve", "cube", "--reflectance", "nan"}, 2, {"--reflectance", "nan"}},
        Refusal{"max_reflectance_one", {"solve", "cube", "--max-reflectance", "1"}, 2, {"--max-reflectance"}},
        Refusal{"error_bounds_ending", {"solve", "cube", "--error-bounds", "b.csv"}, 2, {"b.csv", ".npy"}},
        Refusal{"error_bounds_gather",
                {"solve", "cube", "--form-factors", "gather", "--error-bounds", "b.npy"},
                2,
                {"symmetric", "gather"}},
        Refusal{"emission_missing", {"solve", "cube", "--emission", "none.npy"}, 1, {"none.npy"}},
        Refusal{"emission_garbage", {"solve", "cube", "--emission", "garbage.npy"}, 1, {"garbage.npy"}},
        Refusal{"emission_rows",
                {"solve", "cube", "--emission", "five-rows.npy"},
                1,
                {"five-rows.npy", "5 x 1", "6 x 1"}},
        Refusal{
            "emission_columns", {"solve", "cube", "--emission", "two-columns.npy"}, 1, {"6 x 2", "6 x 3"}},
        Refusal{"emission_negative",
                {"solve", "cube", "--emission", "negative.npy"},
                1,
                {"negative.npy", "patch 0"}},
        Refusal{
            "set_unknown_group", {"solve", "cube", "--set", "roof:reflectance=0.5"}, 2, {"roof", "ceiling"}},
        Refusal{"set_unknown_key",
                {"solve", "cube", "--set", "floor:gloss=0.5"},
                2,
                {"gloss", "reflectance", "emission"}},
        Refusal{"set_without_group", {"solve", "cube", "--set", "reflectance=0.5"}, 2, {"--set", "GROUP:"}},
        Refusal{"set_two_numbers", {"solve", "cube", "--set", "floor:reflectance=0.1/0.2"}, 2, {"0.1/0.2"}},
        Refusal{"set_no_number", {"solve", "cube", "--set", "floor:reflectance="}, 2, {"--set", "number"}},
        Refusal{"set_nan", {"solve", "cube", "--set", "floor:emission=nan"}, 2, {"nan"}},
        Refusal{"set_reflectance_above_one",
                {"solve", "cube", "--set", "floor:reflectance=2"},
                2,
                {"2", "[0, 1]"}},
        Refusal{"set_emission_negative", {"solve", "cube", "--set", "floor:emission=-1"}, 2, {"-1"}}),
    refusal_name);

INSTANTIATE_TEST_SUITE_P(
    Methods, CommandLineRefusal,
    testing::Values(
        Refusal{"unknown_operator", {"solve", "cube", "--operator", "sparse"}, 2, {"sparse", "dense", "csr"}},
        Refusal{"unknown_operator_key", {"solve", "cube", "--operator", "dense:size=3"}, 2, {"size"}},
        Refusal{"empty_operator", {"solve", "cube", "--operator", ""}, 2, {""}},
        Refusal{"compare_unknown_operator",
                {"compare", "cube", "--operators", "dense", "magic", "--json", "a.json"},
                2,
                {"magic"}},
        Refusal{"compare_unknown_key",
                {"compare", "cube", "--operators", "csr:x=1", "--json", "a.json"},
                2,
                {"csr:x=1"}},
        Refusal{"unknown_solver", {"solve", "cube", "--solver", "jacobi"}, 2, {"jacobi", "cg", "gmres"}},
        Refusal{"unknown_solver_key", {"solve", "cube", "--solver", "cg:restart=3"}, 2, {"restart"}},
        Refusal{
            "solver_value_out_of_range", {"solve", "cube", "--solver", "gmres:restart=0"}, 2, {"restart"}},
        Refusal{"solver_for_global_operator",
                {"solve", "cube", "--operator", "svd:k=2,global=1", "--solver", "woodbury"},
                2,
                {"woodbury", "global=1", "leave the solver away"}},
        Refusal{"global_operator_of_full_rank",
                {"solve", "cube", "--operator", "csr:global=1"},
                2,
                {"low rank", "csr"}},
        Refusal{"cg_on_gather", {"solve", "cube", "--form-factors", "gather", "--solver", "cg"}, 2, {"cg"}},
        Refusal{"tolerance_zero", {"solve", "cube", "--tolerance", "0"}, 2, {"--tolerance"}},
        Refusal{"tolerance_nan", {"solve", "cube", "--tolerance", "nan"}, 2, {"--tolerance", "nan"}},
        Refusal{
            "unknown_method", {"solve", "cube", "--form-factors", "guess"}, 2, {"--form-factors", "guess"}},
        Refusal{"unknown_closure", {"solve", "cube", "--closure", "open"}, 2, {"--closure", "open"}},
        Refusal{"factor_tolerance_negative",
                {"solve", "cube", "--form-factor-tolerance", "-1"},
                2,
                {"--form-factor-tolerance"}},
        Refusal{"unknown_device", {"solve", "cube", "--device", "abacus"}, 2, {"abacus", "cpu"}},
        Refusal{"texture_without_device",
                {"solve", "cube", "--operator", "dxt:blocks=texture"},
                2,
                {"dxt:blocks=texture", "--device gl"}},
        Refusal{"strategy_without_device",
                {"compare", "cube", "--operators", "dense", "csr:strategy=group"},
                2,
                {"csr:strategy=group", "--device gl"}},
        Refusal{"no_operator_on_device",
                {"form-factors", "cube", "--device", "gl"},
                2,
                {"form-factors", "--device cpu"}},
        Refusal{"threads_zero", {"solve", "cube", "--threads", "0"}, 2, {"--threads"}},
        Refusal{"seed_negative", {"solve", "cube", "--seed", "-1"}, 2, {"--seed"}},
        Refusal{"lights_unknown_kind",
                {"compare", "cube", "--operators", "dense", "--lights", "laser:1"},
                2,
                {"laser"}},
        Refusal{"lights_without_number",
                {"compare", "cube", "--operators", "dense", "--lights", "area"},
                2,
                {"area"}},
        Refusal{"lights_negative",
                {"compare", "cube", "--operators", "dense", "--lights", "area:-1"},
                2,
                {"area"}},
        Refusal{"lights_twice",
                {"compare", "cube", "--operators", "dense", "--lights", "area:1,area:2"},
                2,
                {"area"}},
        Refusal{"solve_many_lights", {"solve", "cube", "--lights", "patch:3"}, 2, {"patch:3", "one light"}}),
    refusal_name);

INSTANTIATE_TEST_SUITE_P(
    Files, CommandLineRefusal,
    testing::Values(
        Refusal{"unknown_extension", {"solve", "cube", "-o", "out.jpeg"}, 2, {"out.jpeg", ".png", ".npy"}},
        Refusal{"no_extension", {"solve", "cube", "-o", "out"}, 2, {"out", ".glb"}},
        Refusal{"missing_folder", {"solve", "cube", "-o", "none/out.npy"}, 1, {"none/out.npy"}},
        Refusal{"folder_as_output", {"solve", "cube", "-o", "folder.npy"}, 1, {"folder.npy", "folder"}},
        Refusal{"one_of_two_outputs",
                {"solve", "cube", "-o", "good.npy", "-o", "none/out.png"},
                1,
                {"none/out.png"}},
        Refusal{"solve_json_folder",
                {"solve", "cube", "-o", to_file, "--json", "none/a.json"},
                1,
                {"none/a.json"}},
        Refusal{"compare_json_folder",
                {"compare", "cube", "--operators", "dense", "--json", "none/a.json"},
                1,
                {"none/a.json"}},
        Refusal{"info_json_folder", {"info", "cube", "--json", "none/a.json"}, 1, {"none/a.json"}},
        Refusal{"plot_extension",
                {"compare", "cube", "--operators", "dense", "--plot", "a.png"},
                2,
                {"a.png", ".svg"}},
        Refusal{"matrix_extension", {"form-factors", "cube", "-o", "F.csv"}, 2, {"F.csv", ".npy"}},
        Refusal{"matrix_folder", {"form-factors", "cube", "-o", "none/F.npy"}, 1, {"none/F.npy"}},
        Refusal{"save_folder", {"form-factors", "cube", "--save", "none/k"}, 1, {"none/k"}},
        Refusal{"kernel_missing", {"solve", "cube", "--kernel", "none.kernel"}, 1, {"none.kernel"}},
        Refusal{"kernel_garbage", {"solve", "cube", "--kernel", "garbage.kernel"}, 1, {"garbage.kernel"}},
        Refusal{
            "kernel_of_other_scene", {"solve", "cornell-box", "--kernel", "cube.kernel"}, 1, {"cube.kernel"}},
        Refusal{"kernel_of_other_mesh",
                {"solve", "cube", "--patches", "24", "--kernel", "cube.kernel"},
                1,
                {"cube.kernel"}},
        Refusal{"kernel_and_save",
                {"solve", "cube", "--kernel", "cube.kernel", "--save", "k"},
                2,
                {"--kernel", "--save"}},
        Refusal{"width_zero", {"solve", "cube", "-o", "a.png", "--width", "0"}, 2, {"--width"}}),
    refusal_name);

INSTANTIATE_TEST_SUITE_P(
    Frames, CommandLineRefusal,
    testing::Values(
        Refusal{"render_size", {"render", "cube", "--size", "1280"}, 2, {"--size 1280", "1280x720"}},
        Refusal{"render_light", {"render", "cube", "--light", "sun"}, 2, {"sun", "point", "spot"}},
        Refusal{"render_on_cpu", {"render", "cube", "--device", "cpu"}, 2, {"--device cpu", "OpenGL"}},
        Refusal{"render_closure",
                {"render", "cube", "--operator", "dense:f32,closure=rows"},
                2,
                {"closure=rows", "CPU"}},
        Refusal{"render_two_numbers", {"render", "cube", "-o", "%d-%d.png"}, 2, {"%d-%d.png", "once"}},
        Refusal{"render_format", {"render", "cube", "-o", "new/%d.jpeg"}, 2, {"%d.jpeg", ".png"}},
        Refusal{"render_path_line",
                {"render", "cube", "--path", "path.txt", "-o", "new/%d.png"},
                2,
                {"path.txt, line 2", "2 numbers"}},
        Refusal{"render_path_end",
                {"render", "cube", "--path", "short.txt", "--frames", "2"},
                2,
                {"short.txt", "1 line"}}),
    refusal_name);

}  // namespace
}  // namespace radiosity::test
