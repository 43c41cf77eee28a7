#pragma once
/// @file How a field is stored: rounded to the storage precision, shuffled and deflated as HDF5's filters do
/// it.

#include <optional>

#include "core/structure/mesh.h"
#include "database/format/bytes.h"

namespace voussoir {

/// Stored displacements are whole multiples of this length [m]. A quarter of a picometre is far below
/// anything that can be measured, and an error of half of it times the stiffness of the stiffest element
/// (some 1e11 N/m) is still a small part of a block's weight, so that equilibrium can be checked on stored
/// fields; single precision (1e-10 m at a few millimetres) would not allow that. The zero bits that rounding
/// leaves are what makes fields compress.
inline constexpr double kStorageStep = 0x1p-42;

/// The field rounded to multiples of kStorageStep, with one bit pattern each for zero and for NaN; infinite
/// values become NaN. Rounding is the first thing that happens to a solved field, so that everything computed
/// from it comes out the same whether the field was just solved or was read from a file.
Field to_storage_precision(const Field& field);

/// The bytes of one chunk of fields/displacement: byte shuffle, then deflated at level 1, in zlib's format.
Bytes pack_field(const Field& field);

/// The inverse of pack_field for a field of `nodes` nodes; nothing if the bytes are no packed field of that
/// size. Allocates no more than one such field twice over, whatever the bytes say.
std::optional<Field> unpack_field(ByteView packed, Eigen::Index nodes);

/// The largest size [bytes] that a packed field of `nodes` nodes can have.
std::size_t most_packed_bytes(Eigen::Index nodes);

/// CRC-32 (zlib's) of the bytes.
std::uint32_t crc32_of(ByteView bytes);

}  // namespace voussoir
