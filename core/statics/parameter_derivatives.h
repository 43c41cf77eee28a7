#pragma once
/// @file Derivatives of one stage's equations by the uncertain parameters and by the joints' memory.

#include <Eigen/SparseCore>

#include "core/statics/equilibrium.h"
#include "core/structure/uncertain_parameters.h"

namespace voussoir {

/// Columns: uncertain parameters as UncertainParameters::all() has them, per standard deviation; or the two
/// ends of each joint's memory. Displacements have no NaN.
using ColumnMatrix = Eigen::SparseMatrix<double>;

/// d unbalanced forces / d parameters: components x parameters [N]. `movements`: components x parameters of
/// an epoch, the displacements of held components per standard deviation.
ColumnMatrix forces_by_parameters(const StageEquations& equations, const Field& displacement,
                                  const UncertainParameters& uncertain, const ColumnMatrix& movements);

/// d unbalanced forces / d memory: components x (2 joints) [N/m].
ColumnMatrix forces_by_memory(const StageEquations& equations, const Field& displacement);

/// How what the joints remember at the end changes: rows 2 joint and 2 joint + 1 are its two ends.
struct MemoryJacobian {
  ColumnMatrix by_displacement;  ///< (2 joints) x components
  ColumnMatrix by_memory;        ///< (2 joints) x (2 joints)
  ColumnMatrix by_parameters;    ///< (2 joints) x parameters [m]
};

MemoryJacobian memory_jacobian(const StageEquations& equations, const Field& displacement,
                               const UncertainParameters& uncertain);

}  // namespace voussoir
