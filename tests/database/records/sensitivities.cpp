/// @file Sensitivities in a file. Oracles: what was written; sums done by hand; for forged files the refusal
/// that names what is wrong.

#include "database/records/sensitivities.h"

#include <hdf5.h>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
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
      static_cast<void>(are_factors_sound(*database.sensitivities()));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

/// Changes one number of a dataset that has been written.
template <class T>
void change(const std::filesystem::path& path, const char* dataset, hid_t type, std::size_t at, T number) {
  const auto lock = lock_hdf5();
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const Hdf5Handle opened(H5Dopen2(file.get(), dataset, H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(opened.get()), H5Sclose);
  std::vector<T> numbers(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  REQUIRE(H5Dread(opened.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0);
  numbers.at(at) = number;
  REQUIRE(H5Dwrite(opened.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0);
}

bool is_finite(const StoredSignals::Columns& loss) {
  try {
    for (const StoredColumns& columns : {loss.own, loss.intact, loss.lead, loss.epoch}) columns.all();
    return true;
  } catch (const InputError&) {
    return false;
  }
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
  CHECK(stored->known == small.made.known);
  REQUIRE(stored->residuals.size() == kStates);
  for (std::size_t state = 0; state < kStates; ++state) {
    for (const Scene& scene : small.made.scenes) {
      const auto found = stored->find(state, scene), expected = small.made.find(state, scene);
      REQUIRE(found.has_value() == expected.has_value());
      if (!found) continue;
      REQUIRE(found->bridge == expected->bridge);
      REQUIRE(found->epoch == expected->epoch);
      REQUIRE(found->left == expected->left);
      CHECK(found->left.isZero() == scene.removed.empty());
    }
    const FirstOrderResidual& expected = small.made.residuals[state];
    CHECK(stored->residuals[state].bridge == expected.bridge);
    CHECK(stored->residuals[state].epoch == expected.epoch);
    CHECK(stored->residuals[state].share == expected.share);
    CHECK(stored->residuals[state].common == expected.common);
    CHECK(stored->residuals[state].epoch_share == expected.epoch_share);
    CHECK(stored->residuals[state].epoch_common == expected.epoch_common);
  }
  CHECK(stored->unevenness == small.made.unevenness);
  CHECK(stored->load.places == small.made.load.places);
  CHECK(stored->load.readings == small.made.load.readings);
  CHECK_FALSE(stored->find(0, Scene{{BlockId{1}, BlockId{2}}}));
  CHECK_FALSE(stored->find(kStates - 1, small.made.scenes[4]));
  CHECK(stored->of_bridge() == 3);
  CHECK(stored->of_epoch() == 2);
}

TEST_CASE("What falls but may stand is read back, and a bridge that is not quite known shows it") {
  SmallDatabase small;
  const Database database = small.write(small.made);
  const Scene& scene = small.made.scenes[test::kMadeUpFall];
  const std::size_t state = kStates - 1, row = database.find(scene).value();
  const auto fall = database.sensitivities()->find_fall(state, scene);
  REQUIRE(fall);
  CHECK(fall->standing_share == 0.25);
  const Eigen::VectorXd expected = small.made.find_fall(state, scene)->if_standing;
  CHECK(fall->if_standing == expected);
  CHECK_FALSE(database.sensitivities()->find_fall(0, scene));
  CHECK_FALSE(database.sensitivities()->find_fall(state, small.made.scenes[1]));
  const SceneTable stored = database.table(kNominalVariant, state), shown = database.table_if_standing(state);
  CHECK_FALSE(stored.may_stand(row));
  CHECK(shown.may_stand(row));
  CHECK(shown.weight(row) == 0.25);
  for (std::size_t other = 0; other < stored.rows; ++other)
    for (std::size_t i = 0; i < stored.points; ++i) {
      const bool is_gone = database.control_points()[i].is_on(scene.removed.front());
      const double now = shown.row(other)[i];
      if (other == row)
        CHECK((is_gone ? std::isnan(now) : now == expected[static_cast<Eigen::Index>(i)]));
      else
        CHECK((now == stored.row(other)[i] || (std::isnan(now) && std::isnan(stored.row(other)[i]))));
    }
  CHECK(database.table_if_standing(0).vertical.data() == database.table(kNominalVariant, 0).vertical.data());
}

TEST_CASE("A bridge without parameters of an epoch, or of its own, is read back as well") {
  SmallDatabase small;
  Sensitivities known = small.made;
  known.parameters = {{"temperature", "K", 10.0, true}};
  known.basis.resize(0, 0);
  known.make_room(kStates, small.made.bridge.rows());
  for (std::size_t state = 0; state < kStates; ++state) {
    for (std::size_t i = 0; i < known.scenes.size(); ++i)
      if (const auto scene = small.made.find(state, known.scenes[i]))
        known.set(state, i, {Eigen::MatrixXd(scene->bridge.rows(), 0), scene->epoch.leftCols(1)});
    known.residuals[state].bridge.resize(known.bridge.rows(), 0);
  }
  known.unevenness.clear();
  known.load = {};
  const Database database = small.write(known);
  const Sensitivities* stored = database.sensitivities();
  REQUIRE(stored != nullptr);
  CHECK(stored->of_bridge() == 0);
  CHECK(stored->find(0, Scene{})->bridge.cols() == 0);
  CHECK(stored->find(0, Scene{})->epoch == known.find(0, Scene{})->epoch);
  CHECK(stored->residuals[1].bridge.cols() == 0);
  CHECK(stored->unevenness.empty());
  CHECK(stored->load.places.empty());
  CHECK(are_factors_sound(*stored));
  CHECK(are_signals_right(*stored));
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
  wrong.bridge.own(wrong.scenes.size() + 2)(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(small.refusal(wrong), Catch::Contains("bridge_factors' holds a number that is not finite"));
  wrong = small.made;
  wrong.unevenness[1](2, 3) = std::numeric_limits<double>::infinity();
  CHECK_THAT(small.refusal(wrong), Catch::Contains("unevenness' holds a number that is not finite"));
  wrong = small.made;
  wrong.load.readings(1, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(small.refusal(wrong), Catch::Contains("load_influence' holds a number that is not finite"));
  wrong = small.made;
  wrong.load.readings(1, 2) = 1e200;
  CHECK_THAT(small.refusal(wrong), Catch::Contains("load_influence' holds a number that is not below"));
  wrong = small.made;
  wrong.load.places[1] = wrong.load.places[0];
  CHECK_THAT(small.refusal(wrong), Catch::Contains("load_place': expected places in ascending order"));
}

TEST_CASE("Shares of bridges that stand are refused of scenes that do not fall, and where they are none") {
  SmallDatabase small;
  Sensitivities wrong = small.made;
  const std::size_t place = wrong.scenes.size() + test::kMadeUpFall;
  for (const double share : {0.0, -0.5, 1.5}) {
    wrong.standing_share[place] = share;
    CHECK_THAT(small.refusal(wrong),
               Catch::Contains(fmt::format("standing_share' says {} of a scene of which "
                                           "'sensitivity/known' says 2",
                                           share)));
  }
  wrong.standing_share[place] = 0.25;
  wrong.standing_share[place + 1] = 0.25;
  CHECK_THAT(small.refusal(wrong), Catch::Contains("'sensitivity/known' says 1"));
}

TEST_CASE("Datasets of sensitivities of another type or shape are refused and named") {
  for (const char* path :
       {dataset::kUncertainName,    dataset::kUncertainUnit,    dataset::kUncertainSigma,
        dataset::kUncertainOfEpoch, dataset::kSensitivityBasis, dataset::kSensitivityRemoved,
        dataset::kSensitivityKnown, dataset::kBridgeFactors,    dataset::kEpochFactors,
        dataset::kStandingShare,    dataset::kIfStanding,       dataset::kSignalLeft,
        dataset::kResidualBridge,   dataset::kResidualEpoch,    dataset::kResidualShare,
        dataset::kUnevenness,       dataset::kLoadPlace,        dataset::kLoadInfluence,
        dataset::kSignalFirst,      dataset::kSignalOwn,        dataset::kSignalIntact,
        dataset::kSignalLead,       dataset::kSignalEpoch}) {
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

TEST_CASE("Signals are stored of every loss that is known, as they are made from the factors") {
  SmallDatabase small;
  const Database database = small.write(small.made);
  const Sensitivities* stored = database.sensitivities();
  REQUIRE(stored->signals);
  const std::size_t scenes = small.made.scenes.size();
  int compared = 0;
  for (std::size_t state = 0; state < kStates; ++state) {
    const auto intact = small.made.find(state, Scene{}).value();
    for (std::size_t i = 0; i < scenes; ++i) {
      const StoredSignals::Columns loss = (*stored->signals)[state * scenes + i];
      const auto found = small.made.find(state, small.made.scenes[i]);
      if (i == 0 || !found) {
        CHECK(loss.own.columns() == 0);
        CHECK(loss.lead.all().isZero(0.0));
        CHECK(loss.epoch.all().isZero(0.0));
        continue;
      }
      const SignalFactors expected = signal_factors(intact.bridge, found->bridge - intact.bridge);
      REQUIRE(loss.own.all() == expected.own);
      REQUIRE(loss.own.leading(1) == expected.own.leftCols(1));
      REQUIRE(loss.intact.all() == expected.intact);
      REQUIRE(loss.lead.all() == found->bridge - intact.bridge);
      REQUIRE(loss.epoch.all() == found->epoch - intact.epoch);
      ++compared;
    }
  }
  CHECK(compared == 69);  // of 76 singles in two states seven have none
  CHECK(are_signals_right(*stored));
}

TEST_CASE("Factors and signals that have been changed are found") {
  SmallDatabase small;
  const std::filesystem::path path = small.folder / "small.h5";
  const auto block = static_cast<std::size_t>(2 * small.made.bridge.rows());
  const std::size_t scenes = small.made.scenes.size(), unknown = scenes + 4;
  const auto read = [&] { return Database::open(path); };
  static_cast<void>(small.write(small.made));
  CHECK(are_factors_sound(*read().sensitivities()));
  change(path, dataset::kEpochFactors, H5T_NATIVE_DOUBLE, unknown * block, 1e-9);
  CHECK_FALSE(are_factors_sound(*read().sensitivities()));
  for (const std::size_t nothing_is_left : {std::size_t{0}, unknown}) {
    static_cast<void>(small.write(small.made));
    change(path, dataset::kSignalLeft, H5T_NATIVE_DOUBLE, nothing_is_left * block, 1e-9);
    CHECK_FALSE(are_factors_sound(*read().sensitivities()));
  }
  static_cast<void>(small.write(small.made));
  for (const char* numbers :
       {dataset::kSignalOwn, dataset::kSignalIntact, dataset::kSignalLead, dataset::kSignalEpoch}) {
    change(path, numbers, H5T_NATIVE_DOUBLE, 5, 2e-4);
    CHECK_FALSE(are_signals_right(*read().sensitivities()));
    change(path, numbers, H5T_NATIVE_DOUBLE, 5, std::numeric_limits<double>::infinity());
    const Database database = read();
    CHECK_THROWS_WITH(are_signals_right(*database.sensitivities()),
                      Catch::Contains(numbers) && Catch::Contains("not finite"));
    const StoredSignals& signals = *database.sensitivities()->signals;
    CHECK(std::ranges::any_of(std::array{0, 1}, [&](std::size_t loss) { return !is_finite(signals[loss]); }));
    static_cast<void>(small.write(small.made));
  }
  for (const std::int32_t number : {-1, 3, 1 << 30}) {
    change(path, dataset::kSignalFirst, H5T_NATIVE_INT, 2 * scenes, number);
    CHECK_THROWS_WITH(read().sensitivities(), Catch::Contains("'signals/"));
  }
}

TEST_CASE("Factors that are not finite are refused by those who ask for them, and by nobody else") {
  SmallDatabase small;
  const std::filesystem::path path = small.folder / "small.h5";
  static_cast<void>(small.write(small.made));
  const auto block = static_cast<std::size_t>(2 * small.made.bridge.rows());
  const double none = std::numeric_limits<double>::quiet_NaN();
  change(path, dataset::kBridgeFactors, H5T_NATIVE_DOUBLE, 3 * block + 1, none);  // of the second column
  const Database database = Database::open(path);
  const Sensitivities& stored = *database.sensitivities();
  CHECK(stored.find(0, small.made.scenes[2]));
  CHECK_THROWS_WITH(
      stored.find(0, small.made.scenes[3]),
      Catch::Contains("small.h5") && Catch::Contains("bridge_factors' holds a number that is not finite"));
  CHECK_THROWS_AS(are_factors_sound(stored), InputError);
}

}  // namespace voussoir
