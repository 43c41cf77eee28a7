#pragma once
/// @file The evidence of scenes of a bridge that is not exactly known.

#include <array>
#include <span>
#include <vector>

#include "lookup/unknown/case_noise.h"
#include "lookup/unknown/scatter_density.h"

namespace voussoir {

/// CaseNoise in the form that densities are made of.
struct CaseTerms {
  double conditions = 1.0;
  double spread = 0.0;
  LowerTriangle noise;
};
CaseTerms case_terms(const CaseNoise& noise);

/// The same of several cases.
std::vector<CaseTerms> case_terms(const UnknownBridge& bridge, const Observation& observation,
                                  std::span<const UnknownCase> cases);

/// What need not be worked out, as cases with wider covariances show.
struct CasePruning {
  std::span<const double> least;  ///< of each row: densities below do not matter
  Eigen::MatrixXd rise;  ///< by how much a logarithm is larger at most in a case (column) than in one before
                         ///< it (row); infinity where nothing is known
};

/// Works scenes out. What a loss adds to the covariance is kept for all scenes that have it.
class SceneLikelihoods {
 public:
  /// All of them outlive this.
  SceneLikelihoods(const UnknownBridge& bridge, const Observation& observation, const SceneTable& table);

  /// log p(readings | scene, case, kappa) of these rows of a table, for each of kScatterFactors: row by row,
  /// for each of the cases; -infinity for impossible scenes and where it is not `wanted` (the same order;
  /// empty: all are). Silent sensors are left out. What is pruned is -infinity, too. Works on so many
  /// threads; their number changes no result.
  std::vector<ScatterLogs> operator()(std::span<const CaseTerms> cases, std::span<const std::size_t> rows,
                                      std::span<const std::uint8_t> wanted, int threads,
                                      const CasePruning* pruning = nullptr);

  /// C^-1 (y - mean) of a possible scene in a case, in rows of y, with the scatter that the file states.
  Eigen::VectorXd pull(const CaseTerms& one, std::size_t row);

 private:
  /// What no case changes of a loss's part of A A^T: alone; and beside another loss, where the leading
  /// columns of both together come on top.
  struct Products {
    LowerTriangle alone, beside;
    Eigen::MatrixXd lead;  // rows of y, filled up (add_lower_product), x leading columns
  };
  void prepare(std::span<const std::size_t> rows, int threads);
  Products products_of(const Loss& loss) const;
  void store_bridge(std::size_t row, LowerTriangle& sum) const;

  const UnknownBridge& bridge_;
  const Observation& observation_;
  const SceneTable& table_;
  LowerTriangle intact_;          // A A^T of the intact bridge where it is the same in both epochs
  std::vector<Products> losses_;  // of UnknownBridge::losses; empty until they are needed
};

}  // namespace voussoir
