#pragma once
/// @file The figures and tables of the page.

#include <vector>

#include "tools/reproduction/experiments.h"
#include "tools/reproduction/subject.h"
#include "tools/reproduction/wall_test.h"

namespace voussoir {

inline constexpr double kBridgeWidth = 1040.0;  ///< of drawings of the whole bridge [CSS pixels]

/// Figs. 1 and 2: blocks with their indices and control points; triangles.
std::vector<Exhibit> geometry_exhibits(const Subject& subject);

/// Fig. 3: the wall's cracks, force against displacement, Tresca stress; if its greatest force misses the
/// published one, what would have to move (as many runs as quantities).
std::vector<Exhibit> wall_exhibits(const WallTest& test);

/// Fig. 4: the example's displacements, intact, damaged, damaged with noise.
Exhibit example_exhibit(const Subject& subject);

/// Figs. 8 to 16: a scene's displacement field and profiles.
Exhibit field_exhibit(const Subject& subject, const FieldCase& field);

/// Fig. 6: Eq. 1 for every block, when the example's block is missing.
Exhibit objective_exhibit(const Subject& subject);

/// Fig. 7: noise against generations.
Exhibit generations_exhibit(const Subject& subject, const std::vector<GenerationsAtNoise>& runs);

/// Table 2 or 3, and the same cases by exact posterior.
Exhibit table_exhibit(const Subject& subject, const std::vector<CaseResult>& results, const std::string& id,
                      const std::string& title);
Exhibit posterior_exhibit(const std::vector<CaseResult>& results, const std::string& id,
                          const std::string& title);

/// Shares of success against noise.
Exhibit operating_exhibit(const std::vector<OperatingPoint>& curve, const std::string& id,
                          const std::string& title);

/// Success of each course's blocks.
Exhibit course_exhibit(const std::vector<CourseSuccess>& courses);

/// True if at least half of the seeds end at the truth, which is what "found" means on the page.
bool found(const CaseResult& result);

/// What became of a scene: "stands", "collapses (locally, 3 blocks move away; ..)".
std::string outcome_in_words(const Subject& subject, const std::string& scene);

}  // namespace voussoir
