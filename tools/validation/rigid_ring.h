#pragma once
/// @file Statics of a semicircular ring of rigid voussoirs under its own weight: an independent answer to
/// what stands.

#include <optional>

namespace voussoir::validation {

/// Voussoirs are straight-edged (joint points joined by chords) as the blocks of a bridge are, or curved, or
/// curved with their weight on the ring's mean line, as Heyman simplifies.
enum class VoussoirShape { straight, curved, weight_on_mean_line };

/// Can the thrust pass through all joints within the ring and within the friction cone (the safe theorem of
/// limit analysis)? `thickness` over the mean radius. By symmetry the thrust at the crown is horizontal: its
/// size and height are the two unknowns, and every joint bounds them by four straight lines.
bool ring_stands(int voussoirs, double thickness, double friction, VoussoirShape shape);

/// Least thickness over the mean radius that stands; nothing if none up to 0.6 does.
std::optional<double> least_thickness(int voussoirs, double friction, VoussoirShape shape);

}  // namespace voussoir::validation
