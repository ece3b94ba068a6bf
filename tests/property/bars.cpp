#include "bars.h"

#include "element_samples.h"
#include "selector/scene/bar_mesh.h"
#include "tested_kernels.h"

namespace elastogen::test {

Mesh make_bar_mesh(const std::array<double, 3>& size, const std::array<int, 3>& cells,
                   const std::vector<std::string>& associations) {
  selector::BarDescription bar;
  bar.size = size;
  bar.cells = cells;
  for (std::size_t s = 0; s < associations.size(); ++s) {
    selector::SectionDescription section;
    section.path = "bar.section";
    section.until = static_cast<double>(s + 1) / static_cast<double>(associations.size());
    section.association = symgen::AssociationId::parse(associations[s]);
    section.region = "body";
    bar.sections.push_back(section);
  }
  return selector::make_bar(bar).mesh;
}

std::vector<ModelPart> parts_of(const Mesh& mesh, const std::vector<std::string>& associations,
                                double young, double poisson, double density) {
  std::vector<ModelPart> parts;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    ModelPart part;
    part.block = b;
    part.elements = elements_of_region(mesh.blocks[b], 0);
    part.kernels = kernels_of(associations[b]).double_table();
    const std::string law = symgen::AssociationId::parse(associations[b]).law;
    part.parameters = symgen::parameters_from_young_poisson(law_named(law), young, poisson);
    part.density = density;
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace elastogen::test
