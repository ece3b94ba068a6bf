// The constants of the mass-tensor method of G. Picinbono, H. Delingette and N. Ayache, Non-linear
// anisotropic elasticity for real-time surgery simulation, Graphical Models 65 (2003), on one
// tetrahedron.
//
// With the displacements U_j of its vertices and the gradients a_j of their shape functions,
// Saint Venant-Kirchhoff's energy per volume is the sum over vertices j, k, l, m of
//
//   1/2 U_j B^jk U_k  +  (U_k . U_l) C^jkl . U_j  +  D^jklm (U_j . U_k) (U_l . U_m)
//
//   B^jk   = lambda a_j a_k^T + mu a_k a_j^T + mu (a_j . a_k) I
//   C^jkl  = lambda/2 a_j (a_k . a_l) + mu/2 a_l (a_j . a_k) + mu/2 a_k (a_j . a_l)
//   D^jklm = lambda/8 (a_j . a_k) (a_l . a_m) + mu/4 (a_j . a_m) (a_k . a_l)
//
// Hooke's energy is the first term. Here every tensor is multiplied by -volume, for forces.
#pragma once

namespace elastogen::peers {

/// Vertices as pairs: each with itself, and the edges.
struct VertexPair {
  int first, second;
};
inline constexpr int num_pairs = 10;
inline constexpr VertexPair pairs[num_pairs] = {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1},
                                                {1, 2}, {1, 3}, {2, 2}, {2, 3}, {3, 3}};
inline constexpr int pair_of[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};

/// Where each D^jklm is stored: to exchange j with k and l with m at once, or the first two indices
/// with the last two, does not change it.
struct QuarticPlaces {
  int place[4][4][4][4] = {};
  int count = 0;
};
constexpr QuarticPlaces number_quartic_tensors() {
  QuarticPlaces places;
  auto& place = places.place;
  bool has_place[4][4][4][4] = {};
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      for (int l = 0; l < 4; ++l) {
        for (int m = 0; m < 4; ++m) {
          if (has_place[j][k][l][m]) continue;
          place[j][k][l][m] = place[k][j][m][l] = places.count;
          place[l][m][j][k] = place[m][l][k][j] = places.count;
          has_place[k][j][m][l] = has_place[l][m][j][k] = has_place[m][l][k][j] = true;
          ++places.count;
        }
      }
    }
  }
  return places;
}
inline constexpr QuarticPlaces quartic_places = number_quartic_tensors();

template <class Number>
struct HookeTensors {
  Number b[num_pairs][3][3];  // B^jk of each pair; B^kj is its transpose
};

/// 286 numbers. Picinbono counts 280: not the 6 D^jklm of four different vertices.
template <class Number>
struct StvkTensors {
  HookeTensors<Number> linear;
  Number c[num_pairs][4][3];  // C^jkl: pair of k and l, j
  Number d[quartic_places.count];
};
static_assert(sizeof(HookeTensors<double>) == 90 * sizeof(double));
static_assert(sizeof(StvkTensors<double>) == 286 * sizeof(double));

/// What the tensors of a tetrahedron are made from.
struct TetrahedronGeometry {
  double gradients[4][3];  // of the shape functions
  double products[4][4];   // of the gradients
  double volume;
};

/// @param x  positions of the vertices
TetrahedronGeometry measure_tetrahedron(const double* const (&x)[4]);

void make_tensors(const TetrahedronGeometry& geometry, double lambda, double mu,
                  HookeTensors<double>& tensors);
void make_tensors(const TetrahedronGeometry& geometry, double lambda, double mu,
                  StvkTensors<double>& tensors);

}  // namespace elastogen::peers
