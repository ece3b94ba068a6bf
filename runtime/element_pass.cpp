#include "runtime/element_pass.h"

namespace elastogen {

template <class Scalar>
Workspace<Scalar>::Workspace(const std::vector<ElementGroup<Scalar>>& groups, bool matrices) {
  std::size_t vector_size = 0;
  std::size_t output_size = 0;
  for (const ElementGroup<Scalar>& group : groups) {
    const std::size_t values = group.values_per_batch();
    vector_size = std::max(vector_size, values);
    const std::size_t dofs = static_cast<std::size_t>(group.num_nodes * group.dim);
    output_size = std::max(output_size, matrices ? values * dofs : values);
  }
  displacement.resize(vector_size);
  direction.resize(vector_size);
  output.resize(output_size);
}

template struct Workspace<double>;
template struct Workspace<float>;

}  // namespace elastogen
