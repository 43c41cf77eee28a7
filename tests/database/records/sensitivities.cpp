/// @file Sensitivities in a file. Oracles: what was written; sums done by hand; for forged files the refusal
/// that names what is wrong.

#include "database/records/sensitivities.h"

#include <hdf5.h>
#include <catch2/catch.hpp>
#include <limits>

#include "core/error.h"
#include "database/format/hdf5_handle.h"
#include "database/records/database.h"
#include "database/records/schema.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

constexpr std::size_t kStates = 2;

struct SmallDatabase {
  test::TemporaryFolder folder;
  BridgeFile file = test::small_bridge_file();
  Model bridge = make_model(file.description);
  std::vector<Scene> scenes = all_scenes(38, 1);
  Sensitivities made = test::made_up_sensitivities(bridge, scenes, kStates);

  Database write(const std::optional<Sensitivities>& sensitivities) {
    DatabaseContent content = test::made_up_content(file, bridge, scenes, KeepField::no, 1, kStates);
    content.sensitivities = sensitivities;
    test::write_made_up_records(folder / "small.h5", content);
    return Database::open(folder / "small.h5");
  }
  std::string refusal(const Sensitivities& sensitivities) {
    const Database database = write(sensitivities);
    try {
      static_cast<void>(database.sensitivities());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

void check_same(const SceneFactors& stored, const SceneFactors& expected) {
  REQUIRE(stored.known() == expected.known());
  if (!expected.known()) return;
  REQUIRE(stored.bridge == expected.bridge);
  REQUIRE(stored.epoch == expected.epoch);
}

}  // namespace

TEST_CASE("Sensitivities are read back as they were written, to the last bit") {
  SmallDatabase small;
  const Database database = small.write(small.made);
  const Sensitivities* stored = database.sensitivities();
  REQUIRE(stored != nullptr);
  CHECK(stored->parameters == small.made.parameters);
  CHECK(stored->basis == small.made.basis);
  CHECK(stored->scenes == small.made.scenes);
  REQUIRE(stored->states.size() == kStates);
  for (std::size_t state = 0; state < kStates; ++state) {
    const StateSensitivities& expected = small.made.states[state];
    for (std::size_t i = 0; i < small.made.scenes.size(); ++i) {
      check_same(stored->states[state].scenes[i], expected.scenes[i]);
      const SceneFactors* found = stored->find(state, small.made.scenes[i]);
      REQUIRE((found != nullptr) == expected.scenes[i].known());
      if (found != nullptr) check_same(*found, expected.scenes[i]);
    }
    CHECK(stored->states[state].residual.bridge == expected.residual.bridge);
    CHECK(stored->states[state].residual.epoch == expected.residual.epoch);
    CHECK(stored->states[state].residual.share == expected.residual.share);
    CHECK(stored->states[state].residual.common == expected.residual.common);
    CHECK(stored->states[state].residual.epoch_share == expected.residual.epoch_share);
    CHECK(stored->states[state].residual.epoch_common == expected.residual.epoch_common);
  }
  CHECK(stored->of_bridge() == 3);
  CHECK(stored->of_epoch() == 2);
}

TEST_CASE("A bridge without parameters of an epoch, or of its own, is read back as well") {
  SmallDatabase small;
  Sensitivities known = small.made;
  known.parameters = {{"temperature", "K", 10.0, true}};
  known.basis.resize(0, 0);
  for (StateSensitivities& state : known.states) {
    for (SceneFactors& scene : state.scenes)
      if (scene.known()) scene = {Eigen::MatrixXd(scene.bridge.rows(), 0), scene.epoch.leftCols(1)};
    state.residual.bridge.resize(state.residual.bridge.rows(), 0);
  }
  const Database database = small.write(known);
  const Sensitivities* stored = database.sensitivities();
  REQUIRE(stored != nullptr);
  CHECK(stored->of_bridge() == 0);
  CHECK(stored->find(0, Scene{})->bridge.cols() == 0);
  CHECK(stored->find(0, Scene{})->epoch == known.states[0].scenes[0].epoch);
  CHECK(stored->states[1].residual.bridge.cols() == 0);
}

TEST_CASE("A database without sensitivities says so") {
  SmallDatabase small;
  CHECK(small.write(std::nullopt).sensitivities() == nullptr);
}

TEST_CASE("Sensitivities that do not fit together are refused and named") {
  SmallDatabase small;
  CHECK(small.refusal(small.made).empty());
  Sensitivities wrong = small.made;
  wrong.parameters[2].of_epoch = true;
  wrong.parameters[3].of_epoch = false;
  CHECK_THAT(small.refusal(wrong),
             Catch::Contains("parameter_of_epoch': expected those of the bridge first"));
  wrong = small.made;
  wrong.parameters[1].sigma = 0.0;
  CHECK_THAT(small.refusal(wrong), Catch::Contains("parameter_sigma': expected positive numbers"));
  wrong = small.made;
  wrong.parameters[2].of_epoch = true;
  CHECK_THAT(small.refusal(wrong),
             Catch::Contains("'sensitivity/basis' has not the expected type and shape"));
  wrong = small.made;
  std::swap(wrong.scenes[3], wrong.scenes[4]);
  CHECK_THAT(small.refusal(wrong), Catch::Contains("removed': expected the intact bridge and then scenes"));
  wrong = small.made;
  wrong.scenes[38] = Scene{{BlockId{38}}};
  CHECK_THAT(small.refusal(wrong), Catch::Contains("removed' holds a row that is no scene"));
  wrong = small.made;
  wrong.states[1].scenes[2].bridge(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(small.refusal(wrong), Catch::Contains("bridge_factors' holds a number that is not finite"));
}

TEST_CASE("Datasets of sensitivities of another type or shape are refused and named") {
  for (const char* path :
       {dataset::kUncertainName, dataset::kUncertainUnit, dataset::kUncertainSigma,
        dataset::kUncertainOfEpoch, dataset::kSensitivityBasis, dataset::kSensitivityRemoved,
        dataset::kSensitivityKnown, dataset::kBridgeFactors, dataset::kEpochFactors, dataset::kResidualBridge,
        dataset::kResidualEpoch, dataset::kResidualShare}) {
    INFO(path);
    SmallDatabase small;
    static_cast<void>(small.write(small.made));
    {
      const auto lock = lock_hdf5();
      const Hdf5Handle file(H5Fopen((small.folder / "small.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                            H5Fclose);
      REQUIRE(H5Ldelete(file.get(), path, H5P_DEFAULT) >= 0);
      const hsize_t extents[] = {7, 2};
      const Hdf5Handle space(H5Screate_simple(2, extents, nullptr), H5Sclose);
      const Hdf5Handle made(
          H5Dcreate2(file.get(), path, H5T_IEEE_F32LE, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          H5Dclose);
      REQUIRE(made);
    }
    const Database database = Database::open(small.folder / "small.h5");
    CHECK_THROWS_WITH(database.sensitivities(), Catch::Contains(path));
  }
}

}  // namespace voussoir
