// A simulator's own time loop on elastogen's forces: a clamped beam sinks under its weight and
// comes to rest. Symplectic Euler; positions, velocities and forces are plain arrays of the caller.
#include <cstdio>
#include <vector>

#include "runtime/model.h"
#include "stvk_hexa8_q8_none_tables.h"

int main() {
  using namespace elastogen;
  const int nx = 16, ny = 2, nz = 2;  // cubes along x, y, z
  const double edge = 0.1;            // m
  const auto node = [&](int i, int j, int k) { return (i * (ny + 1) + j) * (nz + 1) + k; };

  Mesh mesh;
  ElementBlock block{"hexa8", 8, {}, {}};
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      for (int k = 0; k <= nz; ++k) {
        mesh.positions.insert(mesh.positions.end(), {i * edge, j * edge, k * edge});
        if (i == nx || j == ny || k == nz) continue;
        for (int top = k; top <= k + 1; ++top) {
          block.nodes.insert(block.nodes.end(), {node(i, j, top), node(i + 1, j, top),
                                                 node(i + 1, j + 1, top), node(i, j + 1, top)});
        }
        block.region.push_back(0);
      }
    }
  }
  mesh.region_names = {"beam"};
  mesh.blocks = {block};

  const double lambda = 1.0e7, mu = 0.8e7, density = 1000;  // Pa, Pa, kg/m^3
  const ModelPart beam{0,
                       elements_of_region(block, 0),
                       elastogen_kernels_stvk_hexa8_q8_none_f64_simd(),
                       {lambda, mu},
                       density};
  Model model(mesh, {&beam, 1});

  const auto size = static_cast<Eigen::Index>(model.num_dofs());
  std::vector<double> positions = mesh.positions, velocities(size), forces(size);
  const Eigen::Map<Vector> x(positions.data(), size), f(forces.data(), size);
  const Eigen::Map<const Vector> rest(mesh.positions.data(), size);
  const double step = 2e-4, damping = 20, gravity = 9.81;  // s, 1/s, m/s^2
  for (int n = 0; n < 10000; ++n) {
    std::fill(forces.begin(), forces.end(), 0.0);
    model.forces(x - rest, f);
    for (Eigen::Index i = 3 * node(1, 0, 0); i < size; ++i) {  // nodes at x = 0 are held
      const double weight = i % 3 == 2 ? gravity : 0;
      velocities[i] +=
          step * (forces[i] / model.lumped_mass()[i / 3] - weight - damping * velocities[i]);
      positions[i] += step * velocities[i];
    }
  }
  std::printf("tip %.6f m, energy %.6f J\n", positions.back() - nz * edge, model.energy(x - rest));
}
