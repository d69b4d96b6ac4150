#pragma once
/// Upper bound on the largest frequency and damping rate of what hangs on one grid, from the present state: particles
/// and sheet segments with the nodes' true masses. Rigorous for the elastic stiffness of the present positions.
///
/// Method (Irons and Treharne 1971): hand each node's mass out to the elements that meet there; the assembled system
/// M^-1 K is then no stiffer than the stiffest element with its share alone. An element takes the share
///
///     m_i^e = m_i s_i^e / S_i,   s_i^e = x_e k_e b_i^e,   S_i = sum_e s_i^e
///
/// with stiffness k_e = V (lambda + 2 G) / h^2 and b_i = h |grad w_i|_1 of a particle, k_e = J / l0 and b_i = |dw_i| of
/// a segment (k_e and b_i of a membrane point: see add_fibre). Every x_e > 0 gives a bound. x_e = 1 first; then x_e is
/// what the element's own frequency came out as, which is one step of power iteration towards the Perron vector of the
/// matrix |B| M^-1 |B|^T (Collatz 1942): stiff places borrow mass from soft neighbours. A third round would gain 2 %
/// more, at a third more cost.
///
/// Where a method feels p M^-1 K (see stable_step), S_i / m_i becomes sum_j p_ij S_j / m_j. That is again rigorous:
/// take the particles' velocities for the unknowns, hand their masses out, and use Jensen's inequality on the sums over
/// nodes.
///
/// An element's own frequency: with A = sum_i grad w_i grad w_i^T / m_i^e the particle's largest eigenvalue is that of
/// V D^(1/2) T D^(1/2), T(sigma) = sym(A sigma), D isotropic elasticity. In A's axes it falls apart into normal
/// strains, whose characteristic polynomial has A's invariants in it alone, and shears, which matter only for
/// lambda < 0. For a segment it is sum_i k dw_i^2 / m_i^e.
///
/// sqrt(bound / truth), the loss in the step, against dense eigenvalues for nu = 0, 0.3, 0.45 (mean, largest; never
/// below 1), and of the bound that it replaces: the worst place of a single particle, plus the sheet:
///
///     case                                              bspline2      linear_simplex   replaced (bspline2)
///     one particle, anywhere                            1.00  1.00    1.00  1.00       1.14  1.33
///     regular cloud, 1 a cell                           1.18  1.27    1.02  1.11       1.44  1.67
///     regular cloud, 4 to 16 a cell                     1.28  1.40    1.09  1.34       1.56  1.80
///     jittered, half of the particles missing           1.19  1.34    1.03  1.20       1.42  1.61
///     sheet in a cloud, ratio 1 to 1e5, l 0.2 to 4 h    1.07  1.36    1.04  1.34       1.3   1.9
///     3-D, 1 and 8 a cell                               1.25  1.35    1.03  1.11       1.5   1.62
///
/// It costs 130 ns a particle in the plane (350 in space), body_to_grid 25 to 35 (60 to 80). For bspline2 it may serve
/// for several steps: after a travel of 0.1 cells, to random sides or all alike, omega had grown by 14 % at most over
/// 1300 clouds and by 11 % in 95 of 100 (0.05 cells: 11 and 7 %; 0.2 cells: 16 and 12 %). For
/// gimp too: 135 other, looser clouds gave 27 % at most, 12 % in 95 of 100, where bspline2 had 22 and 17 %. For
/// linear_simplex it holds for the step alone: nodes at the edge of the material have masses of any smallness, and
/// omega grows 10 times within 0.05 cells, unless the method feels only what particles hold.
///
/// Not covered: a consistent mass matrix (its frequencies are higher), and stress stiffness, which is of the order of
/// stress over modulus: for finite strain add the largest principal stress to `lame`.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geocontainer_mpm/mpm/discretisation.h"
#include "geocontainer_mpm/mpm/grid.h"
#include "geocontainer_mpm/mpm/particles.h"

namespace geocontainer_mpm::mpm {

/// Isotropic stiffness, Pa, or viscosity, Pa s. A fluid of viscosity eta: lame = -2/3 eta, shear = eta.
struct Moduli {
  double lame = 0.0;   ///< lambda, >= -2/3 shear
  double shear = 0.0;  ///< G, >= 0
  double constrained() const { return lame + 2.0 * shear; }
};

/// Velocity goes to the particles and back between two steps, and loses the part that particles cannot hold: a mode
/// keeps p in [0, 1] of its velocity, where M p is the particles' own mass matrix (flip; a larger one for apic). For
/// one mode with displacement u, velocity V as it comes from the particles, v after the forces, and viscous stress from
/// the velocity of the mid-step before, the roots of the step stay within the unit circle while
/// omega^2 dt^2 / 4 + c dt / 2 is below
///
///     usl, pic or apic:  (1 + p) / 2        v = p v0 - dt (omega^2 u + c v0), u' = u + dt v
///     usl, flip:         1 / (2 - p)        v = V - dt (omega^2 u + c v0), V' = V + p (v - V), u' = u + dt v
///     usf and musl:      (1 + q) / (2 p)    stress from V' instead of v; q = f + (1 - f) p with flip_fraction f,
///                                           q = p for apic
///
/// With p = 1 that is leapfrog, 1. The smallest over p is 1/2 for usl: a step sqrt(2) shorter than leapfrog's. It is
/// reached: one particle on B-splines with flip has p = 0 for every strain, and its stress changes sign and grows in
/// every step beyond sqrt(2) / omega. usf and musl with flip feel p omega^2 and p c, which FrequencyBound can bound
/// themselves. As matrices M, K, C and M p the same limits follow from the largest eigenvalues.
///
/// Whether it does so: then frequencies stay finite at nodes that hardly any mass reaches.
constexpr bool feels_what_particles_hold(const Discretisation& method)
{
  return method.update != UpdateOrder::usl && method.transfer == Transfer::flip;
}

/// Longest stable step of a method, s, from the bounds of FrequencyBound for it: largest squared frequency, rad^2/s^2,
/// and damping rate, 1/s. Infinite when both are zero.
double stable_step(double frequency_square, double damping_rate, const Discretisation& method);

template <int Dim>
class FrequencyBound {
public:
  struct Result {
    double frequency_square = 0.0;  ///< rad^2/s^2
    double damping_rate = 0.0;      ///< 1/s
  };

  /// A new state. The grid's nodal masses stand in it, and it and all particles outlive bound().
  void begin(const Grid<Dim>& grid, const Discretisation& method);
  /// Particles with an upper bound of their tangent stiffness, and of their viscosity.
  void add_body(const Particles<Dim>& particles, const Moduli& elastic, const Moduli& viscous = {});
  /// Particles that bring mass alone: the nodes of a sheet.
  void add_mass(const Particles<Dim>& particles);
  /// A segment from `a` to `b` (m) that pulls with `stiffness` = J / l0, N/m per m of relative displacement. Leave out
  /// what is slack and stays so.
  void add_segment(const Vec<Dim>& a, const Vec<Dim>& b, double stiffness);
  /// A point at which a span holds on to the grid, with its share in the span's lengthening.
  struct SpanPoint {
    Vec<Dim> place;
    double coefficient;
  };
  /// What resists a length that several points have a part in, such as that of the yarns in a triangle: with the
  /// lengthening b_i = sum_k c_k w_i(x_k) that node i gives, its stiffness is K_ij = stiffness b_i b_j P, P any matrix
  /// between 0 and the identity. A segment is one with the coefficients -1 and 1; to the rounds |b_i| is |dw_i|. It may
  /// bound stress stiffness too: tension T at a length l adds at most T / l (I - t (x) t).
  void add_span(const SpanPoint* points, std::size_t count, double stiffness);
  /// A membrane point at `x` that resists stretch along the unit vector `along`: K_ij = stiffness b_i b_j along (x)
  /// along, b_i = along . grad w_i. Stiffness is tangent modulus, N/m, times present length squared over unstretched
  /// length: N (N m in space). To the rounds it is a segment with |b_i| for |dw_i|.
  void add_fibre(const Vec<Dim>& x, const Vec<Dim>& along, double stiffness);
  /// Three rounds over particles and segments, and three more where anything is viscous. One thread; no allocation
  /// once it has seen as many elements.
  Result bound();

private:
  struct Body {
    const Particles<Dim>* particles;
    Moduli elastic, viscous;
  };
  struct Segment {
    double stiffness;
    std::size_t first, count;  ///< in segment_nodes_
  };
  struct SegmentNode {
    std::uint32_t node;
    double change;  ///< |b_i|: of a segment |w_i(b) - w_i(a)|
  };

  struct SegmentElement;

  /// The three rounds over all elements, for stiffness or viscosity: the bound, 1/s^2 or 1/s.
  double rounds(bool viscous);
  /// S_i / m_i from S_i; p times that where the method feels p.
  void divide_by_mass(std::vector<double>& nodal);
  void keep_what_particles_hold(std::vector<double>& nodal);
  /// Calls `visit(number, element)`.
  template <class Visitor>
  void for_each_element(bool viscous, Visitor&& visit) const;
  template <class Visitor>
  void for_each_node(Visitor&& visit) const;

  const Grid<Dim>* grid_ = nullptr;
  Discretisation method_;
  std::vector<Body> bodies_;  ///< those without stiffness bring mass alone
  std::vector<Segment> segments_;
  std::vector<SegmentNode> segment_nodes_;
  std::vector<double> first_, second_;  ///< nodal S_i, then S_i / m_i, of the first and second round
  std::vector<double> held_;            ///< scratch of keep_what_particles_hold()
  std::vector<double> own_;             ///< x_e of the second round
  std::vector<std::uint32_t> slot_;     ///< scratch of add_span(): per node its place in the span, from 1; else 0
};

}  // namespace geocontainer_mpm::mpm
