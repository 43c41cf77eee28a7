#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "database/format/field_codec.h"
#include "tests/support/same_bits.h"

namespace voussoir {
namespace {

Field random_field(Eigen::Index nodes) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> millimetres(0.0, 1e-3);
  return Field::NullaryExpr(2, nodes, [&] { return millimetres(random); });
}

}  // namespace

TEST_CASE("Rounding to the storage precision moves no displacement by more than half a step") {
  const Field field = random_field(1000);
  const Field rounded = to_storage_precision(field);
  CHECK((rounded - field).cwiseAbs().maxCoeff() <= 0.5 * kStorageStep);
  CHECK(test::same_bits(to_storage_precision(rounded), rounded));
}

TEST_CASE("Rounding leaves one bit pattern each for zero and for what is no number") {
  Field field(2, 2);
  field << -0.0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::quiet_NaN(), -1e-20;
  const Field rounded = to_storage_precision(field);
  CHECK_FALSE(std::signbit(rounded(0, 0)));
  CHECK_FALSE(std::signbit(rounded(1, 1)));
  CHECK(std::isnan(rounded(0, 1)));
  CHECK(std::memcmp(&rounded(1, 0), &rounded(0, 1), sizeof(double)) == 0);
}

TEST_CASE("A packed field comes back bit by bit and takes less room than before") {
  const Field field = to_storage_precision(random_field(1000));
  const Bytes packed = pack_field(field);
  const auto unpacked = unpack_field(packed, field.cols());
  REQUIRE(unpacked.has_value());
  CHECK(test::same_bits(*unpacked, field));
  CHECK(packed.size() < 0.75 * static_cast<double>(field.size()) * sizeof(double));
}

TEST_CASE("A packed field of another size, cut short or with something behind it is refused") {
  const Field field = to_storage_precision(random_field(50));
  Bytes packed = pack_field(field);
  CHECK_FALSE(unpack_field(packed, 49).has_value());
  CHECK_FALSE(unpack_field(packed, 51).has_value());
  CHECK_FALSE(unpack_field(ByteView(packed).first(packed.size() - 1), 50).has_value());
  packed.push_back(std::byte{0});
  CHECK_FALSE(unpack_field(packed, 50).has_value());
  CHECK_FALSE(unpack_field({}, 50).has_value());
}

}  // namespace voussoir
