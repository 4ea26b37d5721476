// Runs the program as a user does and looks at exit codes and files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "meshing/io/mesh_io.h"
#include "tests/apps/command_line_fixture.h"
#include "tests/meshing/box_mesh.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(CommandLine, UnpackSaysWhatItLacksAndWritesNothingIntoTheScan) {
  std::filesystem::create_directories(folder_ / "scan" / "rgb");
  const Outcome nothing = Run("unpack scan -o images");
  EXPECT_EQ(nothing.exit_code, 3);
  EXPECT_THAT(nothing.output, testing::HasSubstr("nothing to unpack"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "images"));
  EXPECT_EQ(Run("unpack scan -o scan/images").exit_code, 2);
}

TEST_F(CommandLine, HelpAndVersionAreDone) {
  EXPECT_EQ(Run("--help").exit_code, 0);
  EXPECT_EQ(Run("--version").exit_code, 0);
  for (const char* command :
       {"reconstruct", "check", "contract", "mesh", "graph", "config", "experiment"}) {
    const Outcome help = Run(std::string(command) + " --help");
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_THAT(help.output, HasSubstr(std::string("Example:\n  curvefusion ") + command));
  }
}

TEST_F(CommandLine, HelpWorksAsAWord) {
  EXPECT_EQ(Run("help").output, Run("--help").output);
  EXPECT_EQ(Run("help mesh").output, Run("mesh --help").output);
  EXPECT_EQ(Run("help mesh").exit_code, 0);
  const Outcome mistyped = Run("help mehs");
  EXPECT_EQ(mistyped.exit_code, 2);
  EXPECT_THAT(mistyped.output, HasSubstr("did you mean mesh?"));
}

TEST_F(CommandLine, UnitsOfMeshesAreListedAsTheyAreWritten) {
  EXPECT_THAT(Run("mesh --help").output, HasSubstr("{m,mm}"));
  const Outcome wrong = Run("mesh a.json -o a.ply --unit cm");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("cm not in {m,mm}"));
}

// None of the inputs is there: the format is refused before anything is read.
TEST_F(CommandLine, FilesOfUnknownFormatsAreRefusedBeforeWork) {
  const std::string graphs = ".json, .graphml, .swc, .ply, .obj, .dxf, .svg or .usda";
  const std::string meshes = ".ply, .obj, .stl, .glb or .3mf";
  for (const auto& [command, choices] :
       std::map<std::string, std::string>{{"contract cloud.ply -o x.txt", graphs},
                                          {"graph a.json --convert x.txt", graphs},
                                          {"graph a.json --smooth 60 -o x.txt", graphs},
                                          {"mesh a.json -o x.txt", meshes}}) {
    const Outcome outcome = Run(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_THAT(outcome.output, HasSubstr("x.txt")) << command;
    EXPECT_THAT(outcome.output, HasSubstr(choices)) << command;
  }
  ASSERT_EQ(SimulateCube(1).exit_code, 0);
  EXPECT_EQ(Run("reconstruct scan -o out --save-volume x.txt").exit_code, 2);
}

TEST_F(CommandLine, CheckPrintsOneJsonObject) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  for (const char* scan : {"scan", "none"}) {
    RunShell("\"$CURVEFUSION\" check --json " + std::string(scan) + " >output.txt 2>errors.txt");
    const auto json = nlohmann::json::parse(Text("output.txt"), nullptr, false);
    ASSERT_FALSE(json.is_discarded()) << Text("output.txt");
    EXPECT_EQ(json["figures"]["frames"], std::string(scan) == "scan" ? 3 : 0);
    EXPECT_EQ(json["usable"], std::string(scan) == "scan");
  }
}

TEST_F(CommandLine, CheckRepairsAWrongDepthUnit) {
  ASSERT_EQ(Run("simulate cubeframe -o scan --sensor ideal --poses true --frame-rate 5 --quiet "
                "--frames 12")
                .exit_code,
            0);
  ASSERT_EQ(RunShell("sed -i s/5000/2500/ scan/intrinsics.json").exit_code, 0);
  const Outcome wrong = Run("check scan");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_NE(wrong.output.find("write \"depth_scale\": 5000"), std::string::npos) << wrong.output;

  const Outcome repair = Run("check scan --repair repaired");
  EXPECT_EQ(repair.exit_code, 0) << repair.output;
  EXPECT_NE(repair.output.find("Wrote repaired with 12 frames"), std::string::npos);
  EXPECT_EQ(Run("check repaired").exit_code, 0);
  // The scan stays as it was.
  EXPECT_NE(Text("scan/intrinsics.json").find("2500"), std::string::npos);
}

TEST_F(CommandLine, MeshCheckTellsDefectsByExitCodeOne) {
  const std::string open = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  std::ofstream(folder_ / "open.obj") << open;
  std::ofstream(folder_ / "closed.obj") << open << "f 2 3 4\n";
  const Outcome sound = Run("mesh --check closed.obj");
  EXPECT_EQ(sound.exit_code, 0) << sound.output;
  EXPECT_THAT(sound.output, HasSubstr("vertices 4, faces 4, separate pieces 1, genus 0"));
  EXPECT_THAT(sound.output, HasSubstr("volume 166667 cm3"));
  const Outcome defect = Run("mesh --check open.obj");
  EXPECT_EQ(defect.exit_code, 1) << defect.output;
  EXPECT_THAT(defect.output, HasSubstr("3 boundary edges"));
  EXPECT_EQ(Run("mesh closed.obj").exit_code, 2);
  // A file that does not tell its unit: what size it would have is said.
  EXPECT_THAT(sound.output, HasSubstr("size 1000.0 x 1000.0 x 1000.0 mm (coordinates taken as me"));
  EXPECT_THAT(Run("mesh --check closed.obj --unit mm").output,
              HasSubstr("size 1.0 x 1.0 x 1.0 mm\n"));
  EXPECT_EQ(Run("mesh --check none.obj").exit_code, 3);
}

TEST_F(CommandLine, MeshWritesEveryFormatWithAnyRadii) {
  std::ofstream(folder_ / "skeleton.json")
      << R"({"format": "curvefusion-skeleton", "version": 1, "units": "m",
             "nodes": [{"position": [0, 0, 0]}, {"position": [0.1, 0, 0]},
                       {"position": [0, 0.05, 0]}, {"position": [0.1, 0.05, 0]}],
             "edges": [{"nodes": [0, 1], "points": [[0, 0, 0], [0.1, 0, 0]],
                        "radii": [0.003, 0.005]},
                       {"nodes": [2, 3], "points": [[0, 0.05, 0], [0.1, 0.05, 0]],
                        "radius": 0.002}]})";
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a.glb", "a.3mf"}) {
    const Outcome outcome = Run(std::string("mesh skeleton.json --check -o ") + name);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("separate pieces 2, genus 0")) << name;
    EXPECT_THAT(outcome.output, HasSubstr("watertight")) << name;
  }
  // The mean of the first is 4 mm, and both are equally long: the median is the thinner one.
  const auto volume = [&](const std::string& options) {
    const std::string output = Run("mesh skeleton.json -o b.ply " + options).output;
    return std::atof(output.c_str() + output.find("volume") + 6);
  };
  const double pi = 3.14159265;
  const auto capsule = [&](double r) { return pi * r * r * (10 + 4.0 / 3 * r); };
  // Six digits are printed; a cone has more volume than its mean cylinder.
  EXPECT_NEAR(volume("--radius-from edge"), capsule(0.4) + capsule(0.2), 0.02);
  EXPECT_NEAR(volume("--radius-from global"), 2 * capsule(0.2), 0.01);
  EXPECT_NEAR(volume("--radius 3"), 2 * capsule(0.3), 0.02);
  EXPECT_GT(volume(""), 1.005 * (capsule(0.4) + capsule(0.2)));
  EXPECT_EQ(Run("mesh skeleton.json -o a.glb --unit mm").exit_code, 2);
  // A cone of 6 to 10 mm and a tube of 4 mm that lie 50 mm apart: 105 + 3 mm long, 50 + 5 + 2 wide.
  for (const char* name : {"print.stl", "print.3mf"}) {
    const Outcome print = Run(std::string("mesh skeleton.json --for print --check -o ") + name);
    EXPECT_EQ(print.exit_code, 0) << print.output;
    EXPECT_THAT(print.output, HasSubstr("size 108."));
    EXPECT_THAT(print.output, HasSubstr(" mm, at full scale"));
    EXPECT_THAT(print.output, HasSubstr("(mm)"));
    EXPECT_THAT(Run(std::string("mesh --check ") + name).output, HasSubstr("size 108."));
  }
  const Outcome thin = Run("mesh skeleton.json --for print --min-diameter 5 -o thin.stl");
  EXPECT_EQ(thin.exit_code, 3);
  EXPECT_THAT(thin.output, HasSubstr("curve 1 (its number on the report page and for graph "
                                     "--remove) is 4.00 mm thick, less than the 5 mm"));
  EXPECT_THAT(Run("mesh skeleton.json -o wires.stl").output, HasSubstr("add --for print"));
  EXPECT_THAT(Run("mesh skeleton.json -o wires.stl --radius 2mm").output,
              HasSubstr("2mm is no positive number; write it without a unit"));
  for (const char* number : {"0", "-2", "inf", "nan"}) {
    EXPECT_EQ(Run(std::string("mesh skeleton.json -o wires.stl --radius ") + number).exit_code, 2)
        << number;
  }
  EXPECT_EQ(Run("mesh skeleton.json --for print --min-diameter 5 --radius 3 -o b.stl").exit_code,
            0);
  EXPECT_EQ(Run("mesh skeleton.json --for print -o a.ply").exit_code, 2);
  EXPECT_EQ(Run("mesh skeleton.json --for print --unit m -o a.stl").exit_code, 2);
  EXPECT_EQ(Run("mesh skeleton.json --min-diameter 5 -o a.stl").exit_code, 2);
  EXPECT_EQ(Run("mesh skeleton.json -o a.ply --radius 3 --radius-from edge").exit_code, 2);
}

TEST_F(CommandLine, WrongUsageIsTwo) {
  EXPECT_EQ(Run("").exit_code, 2);
  EXPECT_EQ(Run("reconstruct").exit_code, 2);
  EXPECT_EQ(Run("reconstruct scan -o out --no-such-option").exit_code, 2);
  EXPECT_EQ(Run("config --set volume.voxel_size=99").exit_code, 2);
  EXPECT_EQ(Run("config --profile papper").exit_code, 2);
  EXPECT_EQ(Run("experiment objects objekts -o out").exit_code, 2);
  EXPECT_EQ(Run("experiment objects -o out --set volume.voxel_size=99").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));  // refused before anything is begun
  const Outcome mistyped = Run("reconstrut scan -o out");
  EXPECT_EQ(mistyped.exit_code, 2);
  EXPECT_THAT(mistyped.output, HasSubstr("did you mean reconstruct?"));
}

TEST_F(CommandLine, ThePageOfClaimsNeedsNoRuns) {
  const Outcome page = Run("experiment reproduction -o out --quick");
  EXPECT_EQ(page.exit_code, 0) << page.output;
  EXPECT_THAT(Text("out/reproduction.md"),
              HasSubstr("experiment table1 -o DIR --quick`: 0 of 2 runs finished"));
  EXPECT_EQ(CountFiles("out", "run.json"), 0);  // nothing is measured for it
}

TEST_F(CommandLine, BadInputIsThree) {
  fs::create_directories(folder_ / "empty");
  EXPECT_EQ(Run("check empty").exit_code, 3);
  EXPECT_EQ(Run("reconstruct empty -o out").exit_code, 3);
  EXPECT_EQ(CountFiles("out", "."), 0);
  std::ofstream(folder_ / "bad.json") << "{";
  EXPECT_EQ(Run("graph bad.json").exit_code, 3);
  EXPECT_EQ(Run("mesh bad.json -o a.ply").exit_code, 3);
  EXPECT_EQ(Run("contract none.ply -o a.json").exit_code, 3);
}

TEST_F(CommandLine, NothingThinIsFourWithAReport) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  // The object has less than 10 m of curve.
  const Outcome outcome = Run("reconstruct scan -o out --set ridge_skeleton.min_component=10");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.output, HasSubstr("nothing thin"));
  EXPECT_TRUE(fs::exists(folder_ / "out/report.json"));
  EXPECT_THAT(Text("out/report.html"), HasSubstr(R"("nothing_found":")"));
  EXPECT_TRUE(fs::exists(folder_ / "out/config.toml"));
  EXPECT_EQ(CountFiles("out", "skeleton"), 0);
}

TEST_F(CommandLine, ACubeGivesAllFilesAndItsThirteenJunctions) {
  ASSERT_EQ(SimulateCube(45).exit_code, 0);
  const Outcome outcome = Run("reconstruct scan -o out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("13 junctions, 1 free end"));
  for (const char* name : {"skeleton.json", "trajectory.txt", "mesh.ply", "preview.png",
                           "report.html", "report.json", "config.toml"}) {
    EXPECT_EQ(CountFiles("out", name), 1) << name;
  }
  EXPECT_EQ(CountFiles("out", ""), 7);  // and nothing half-written beside them
}

TEST_F(CommandLine, AHybridMeshIsThePlantWithItsPot) {
  ASSERT_EQ(Run("simulate pot_plant -o scan --sensor ideal --poses true --frame-rate 4 --quiet "
                "--frames 24")
                .exit_code,
            0);
  const Outcome outcome = Run("reconstruct scan -o out --hybrid");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("out/hybrid.ply"));
  EXPECT_EQ(Run("mesh --check out/hybrid.ply").exit_code, 0);
  EXPECT_EQ(Run("mesh --check out/hybrid.stl").exit_code, 0);
  const nlohmann::json hybrid = nlohmann::json::parse(Text("out/report.json"))["hybrid"];
  EXPECT_EQ(hybrid["watertight"], true);
  EXPECT_EQ(hybrid["components"], 1);
  EXPECT_EQ(hybrid["solid_parts"], 1);
  // The pot has 1690 cm3, the plant 25; some of its back was not seen. The table would have more.
  EXPECT_GT(hybrid["volume"], 1.2e-3);
  EXPECT_LT(hybrid["volume"], 1.9e-3);

  // Made again from the skeleton it is the same; of an edited one the rest of it.
  EXPECT_EQ(Run("mesh out/skeleton.json --solids out/solid_parts.ply -o again.ply").exit_code, 0);
  EXPECT_TRUE(Text("again.ply") == Text("out/hybrid.ply"));
  EXPECT_EQ(Run("graph out/skeleton.json --remove 0 -o edited.json").exit_code, 0);
  EXPECT_EQ(Run("mesh edited.json --solids out/solid_parts.ply -o edited.stl --for print --check")
                .exit_code,
            0);
  EXPECT_FALSE(Text("edited.stl") == Text("out/hybrid.stl"));
  EXPECT_EQ(Run("mesh out/skeleton.json --solids out/missing.ply -o again.ply").exit_code, 3);
}

TEST_F(CommandLine, SolidsMustBeClosedAndMayBeSeveral) {
  ASSERT_EQ(SimulateCube(1).exit_code, 0);
  const auto write_box = [&](const char* name, float x, bool open) {
    TriangleMesh box = BoxMesh({x, 0, 0}, {x + 0.02f, 0.02f, 0.02f});
    if (open) box.triangles.pop_back();
    WriteMesh(folder_ / name, box, {.require_watertight = false});
  };
  write_box("near.ply", 0, false);
  write_box("far.ply", 5, false);
  write_box("open.ply", 5, true);
  const Outcome both =
      Run("mesh scan/truth/skeleton.json --solids near.ply --solids far.ply -o both.ply");
  EXPECT_EQ(both.exit_code, 0);
  EXPECT_THAT(both.output, HasSubstr("pieces that do not touch"));
  const Outcome open = Run("mesh scan/truth/skeleton.json --solids open.ply -o both.ply");
  EXPECT_EQ(open.exit_code, 3);
  EXPECT_THAT(open.output, HasSubstr("open.ply: --solids takes closed meshes"));
}

TEST_F(CommandLine, ScansWithoutDepthAreCheckedAndNotTakenForOthers) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  std::filesystem::remove_all(folder_ / "scan/depth");
  const Outcome listed = Run("reconstruct scan -o out --depth wires");
  EXPECT_EQ(listed.exit_code, 3);
  EXPECT_THAT(listed.output, HasSubstr("is not there; copy it again"));
  for (const char* list : {"depth.txt", "associations.txt"})
    std::filesystem::remove(folder_ / "scan" / list);
  const Outcome check = Run("check scan");
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_THAT(check.output, HasSubstr("depth        none"));
  for (const char* depth : {"wires", "background"}) {
    const Outcome outcome = Run(std::string("reconstruct scan -o out --depth ") + depth);
    EXPECT_EQ(outcome.exit_code, 3) << depth;
    EXPECT_THAT(outcome.output, HasSubstr("no depth images"));
  }
  EXPECT_EQ(Run("reconstruct scan -o out --depth some").exit_code, 2);
  EXPECT_EQ(Run("reconstruct scan -o out --depth none --hybrid").exit_code, 2);
  const Outcome tracked = Run("reconstruct scan -o out --track");
  EXPECT_EQ(tracked.exit_code, 3);
  EXPECT_THAT(tracked.output, HasSubstr("neither depth images nor camera poses"));
}

TEST_F(CommandLine, AFolderThatCannotBeWrittenIsFive) {
  ASSERT_EQ(SimulateCube(1).exit_code, 0);
  std::ofstream(folder_ / "file") << "not a folder";
  const Outcome outcome = Run("reconstruct scan -o file/out");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.output, HasSubstr("file/out"));
}

TEST_F(CommandLine, AnInterruptedRunIs130AndLeavesNoResult) {
  ASSERT_EQ(SimulateCube(25).exit_code, 0);
  // The folder for stages is made right before the first frame is read.
  const Outcome outcome = RunAndInterrupt("reconstruct scan -o out --save-stages stages", "stages");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.output, HasSubstr("interrupted"));
  EXPECT_EQ(CountFiles("out", "."), 0);
}

TEST_F(CommandLine, AnInterruptedSimulationLeavesNothing) {
  const auto start = std::chrono::steady_clock::now();
  // Some minutes of frames.
  const Outcome outcome = RunAndInterrupt("simulate cage -o scan --frames 5000", "scan.partial-*");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.output, HasSubstr("interrupted"));
  EXPECT_EQ(CountFiles(".", "scan"), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

// The L1 axis of a cube full of points takes minutes, beyond the time limit of tests, and shows no
// progress.
TEST_F(CommandLine, ALongComputationWithoutProgressIsInterrupted) {
  std::ofstream cloud(folder_ / "cloud.xyz");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(0, 0.5);
  for (int i = 0; i < 300'000; ++i) {
    cloud << coordinate(random) << ' ' << coordinate(random) << ' ' << coordinate(random) << '\n';
  }
  cloud.close();
  // The folder is made right before the computation.
  const Outcome outcome =
      RunAndInterrupt("contract cloud.xyz -o made/a.json --method l1 --neighbourhood 50", "made");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(CountFiles(".", "a.json"), 0);
}

TEST_F(CommandLine, TheConfigItPrintsIsTheConfigItReads) {
  ASSERT_EQ(Run("config --profile paper --set volume.voxel_size=0.006").exit_code, 0);
  fs::rename(folder_ / "output.txt", folder_ / "a.toml");
  const Outcome again = Run("config --config a.toml");
  EXPECT_EQ(again.output, Text("a.toml"));
  EXPECT_THAT(again.output, HasSubstr("voxel_size = 0.006"));
}

TEST_F(CommandLine, QuietPrintsNothing) { EXPECT_EQ(SimulateCube(1).output, ""); }

}  // namespace
}  // namespace curvefusion
