/// A bridge that is given as polygons with labels, not laid in courses, on its whole way: mesh, equilibrium,
/// record, database, search, words.

#include <catch2/catch.hpp>

#include "core/solve/combined_solver.h"
#include "database/format/field_codec.h"
#include "database/records/variant_parameters.h"
#include "database/records/writer.h"
#include "lookup/lookup.h"
#include "lookup/report/words.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// Three rows of blocks of 1 m x 0.5 m in bond, all called by a letter and a number.
std::vector<Block> labelled_wall() {
  std::vector<Block> blocks;
  const auto add = [&](const std::string& label, double left, double right, double bottom) {
    Block& block = blocks.emplace_back();
    block.label = label;
    block.polygon = {{left, bottom}, {right, bottom}, {right, bottom + 0.5}, {left, bottom + 0.5}};
  };
  for (int i = 0; i < 4; ++i) add(fmt::format("foot {}", i + 1), i, i + 1, 0.0);
  for (int i = 0; i <= 4; ++i)
    add(fmt::format("middle {}", i + 1), std::max(0.0, i - 0.5), std::min(4.0, i + 0.5), 0.5);
  for (int i = 0; i < 4; ++i) add(fmt::format("top {}", i + 1), i, i + 1, 1.0);
  return blocks;
}

/// Held at its foot and its sides, measured at the upper corners of the top row.
Model labelled_model() {
  Structure structure = assemble(labelled_wall(), {.mesh = {}, .mirror_axis = 2.0});
  structure.supports = box_supports(structure.mesh, {}, 4.0);
  for (int i = 0; i < 4; ++i) {
    const BlockId block = structure.layout.find_label(fmt::format("top {}", i + 1)).value();
    for (const double x : {i + 0.0, i + 1.0})
      structure.control_points.push_back(
          point_at(fmt::format("P{}", structure.control_points.size() + 1), structure.mesh, block, {x, 1.5}));
  }
  return with_nominal_parameters(std::move(structure), {});
}

void build(const Model& model, const std::vector<Scene>& scenes, const std::filesystem::path& path) {
  std::vector<StageTask> tasks;
  for (const Scene& scene : scenes) tasks.push_back({.stage = {.scene = scene}});
  const std::vector<Solution> solutions = CombinedSolver(model).solve(tasks);
  const DatabaseContent content{
      .provenance = make_provenance({"polygons", "", {}}, "solver = test\n", "test"),
      .bridge = model,
      .variants = {variant_parameters(model.parameters)},
      .keys = keys_of(kNominalVariant, scenes)};
  write_database(path, content, [&](std::size_t row) {
    Solution rounded = solutions[row];
    rounded.displacement = to_storage_precision(rounded.displacement);
    return make_record(content.keys[row], std::span(&rounded, 1), model.control_points, KeepField::yes,
                       KeepField::yes);
  });
}

}  // namespace

TEST_CASE(
    "A bridge of labelled polygons is meshed, solved, kept, read and located (the block that was taken "
    "out)") {
  const test::TemporaryFolder folder;
  const Model model = labelled_model();
  const std::vector<Scene> scenes = all_scenes(model.layout.size(), 1);
  build(model, scenes, folder / "wall.h5");
  const Database database = Database::open(folder / "wall.h5");
  REQUIRE(database.layout().blocks[5].label == "middle 2");
  CHECK(database.layout().blocks[5].index.course < 0);
  CHECK(database.joints().size() == model.joints.size());

  int located = 0;
  for (const char* name : {"foot 2", "middle 2", "foot 3", "middle 4"}) {
    const Scene truth = parse_scene(name, database.layout());
    const std::size_t row = database.find(truth).value();
    if (database.table().outcome[row] != static_cast<std::uint8_t>(Outcome::standing)) continue;
    LookupSettings settings;
    settings.prior.missing = {0, 1};
    const Answer answer = locate_damage(
        absolute_readings(library_of(database), as_measurements(database.table().row(row))), settings);
    CHECK(to_string(answer.candidates.front().scene, database.layout()) == name);
    settings.search = Search::genetic;
    settings.objective = Objective::paper;
    const Answer bred = locate_damage(
        absolute_readings(library_of(database), as_measurements(database.table().row(row))), settings);
    CHECK(to_string(bred.candidates.front().scene, database.layout()) == name);
    CHECK_THAT(place_in_words(truth, database.layout()), Catch::Contains(fmt::format("block {}, x ", name)));
    ++located;
  }
  CHECK(located >= 2);
}

}  // namespace voussoir
