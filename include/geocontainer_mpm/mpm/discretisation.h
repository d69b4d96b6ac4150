#pragma once
/// The choices of the spatial and temporal discretisation that a scene may make. Each is a compile-time branch inside
/// `mpm`: what is not chosen costs nothing.

namespace geocontainer_mpm::mpm {

/// bspline2: quadratic B-splines (Steffen, Kirby and Berzins 2008). linear_simplex: the founding paper's, three-node
/// triangles (two a cell) or four-node tetrahedra (six a cell). gimp: linear ones averaged over the particle's box
/// (Bardenhagen and Kober 2004), whose edges follow the stretch along the grid's axes (Wallstedt and Guilkey 2008, JCP
/// 227:9628: cpGIMP).
enum class Shape { bspline2, linear_simplex, gimp };

/// What stands for a shape where a point has no box, as the nodes of a sheet have none: gimp then averages over a cell,
/// which is bspline2.
constexpr Shape shape_of_points(Shape shape)
{
  return shape == Shape::gimp ? Shape::bspline2 : shape;
}

/// apic: affine (Jiang et al. 2015); a scene may not take it with linear_simplex, whose nodes at the edge of the
/// material have next to no mass: the affine matrix there is the element's velocity gradient, keeps what those nodes
/// do, and gains energy. flip: the grid's change of velocity, blended with its velocity by `flip_fraction` (Brackbill
/// and Ruppel 1986; Stomakhin et al. 2013). aflip: both, affine and blended (Fei, Guo, Wu, Huang and Gao 2021, ACM TOG
/// 40:109). What the grid does not see of a velocity, apic takes at every step, however short.
enum class Transfer { apic, flip, aflip };

/// Does a particle's velocity come with an affine matrix?
constexpr bool is_affine(Transfer transfer)
{
  return transfer != Transfer::flip;
}

/// Does a particle keep a part of what the grid does not see of its velocity?
constexpr bool is_blended(Transfer transfer)
{
  return transfer != Transfer::apic;
}

/// consistent: the full mass matrix of the particles, solved by conjugate gradients (Burgess, Sulsky and Brackbill
/// 1992); with flip only.
enum class MassMatrix { lumped, consistent };

/// When stress is updated (Bardenhagen 2002): last, from the grid's velocity after the forces; first, from the velocity
/// before them; last, from a velocity mapped back from the moved particles (Sulsky, Zhou and Schreyer 1995).
enum class UpdateOrder { usl, usf, musl };

/// Remedies of linear elements. cell_average: force from the mean stress of an element, integrated over the element
/// where it is full (Beuth, Wieckowski and Vermeer 2011: "mixed integration"). nodal_mixed: volumetric strain rate
/// averaged over the nodes (nodal mixed discretisation, Detournay and Dzik 2006).
enum class Smoothing { none, cell_average, nodal_mixed };

struct Discretisation {
  Shape shape = Shape::bspline2;
  Transfer transfer = Transfer::apic;
  double flip_fraction = 1.0;  ///< 1: pure FLIP, 0: pure PIC (with aflip: apic), [0, 1]
  MassMatrix mass = MassMatrix::lumped;
  UpdateOrder update = UpdateOrder::usl;
  Smoothing smoothing = Smoothing::none;
};

/// Does the law see other gradients than those at the particles? See smooth_gradients().
inline bool smooths_gradients(const Discretisation& d)
{
  return d.smoothing == Smoothing::nodal_mixed ||
         (d.smoothing == Smoothing::cell_average && d.shape != Shape::linear_simplex);
}

}  // namespace geocontainer_mpm::mpm
