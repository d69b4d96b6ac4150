#pragma once
/// The processes that share an ensemble: those of `mpirun`, or this one alone.

#include <string>
#include <vector>

namespace geocontainer_mpm::program {

/// One object, before and after which nothing of MPI is called. Without MPI in the build, or not started by `mpirun`,
/// there is one rank, and MPI is not touched.
class Ranks {
public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool first() const { return rank_ == 0; }

  // Every rank calls these in the same order.
  /// Whether all say yes.
  bool all(bool yes) const;
  /// On the first rank the texts of all in order, on the others nothing.
  std::vector<std::string> gather(const std::string& text) const;

private:
  int rank_ = 0, size_ = 1;
};

}  // namespace geocontainer_mpm::program
