#include "selector/bench/element_look.h"

namespace elastogen::selector {

std::string_view element_like(std::string_view element) {
  if (element == "C3D4") return "tet4";
  if (element == "C3D10") return "tet10";
  if (element == "C3D6") return "prism6";
  if (element == "C3D15") return "prism15";
  if (element.starts_with("C3D8")) return "hexa8";
  if (element.starts_with("C3D20")) return "hexa20";
  return element;
}

std::string element_colour(std::string_view element) {
  const std::string_view ours = element_like(element);
  if (ours == "tet4" || ours == "tri3") return "#5aa9e6";
  if (ours == "tet10") return "#1d4f91";
  if (ours == "hexa8" || ours == "quad4") return "#f2a922";
  if (ours == "hexa20") return "#b8500b";
  if (ours == "prism6") return "#35b8b0";
  if (ours == "prism15") return "#0f6b66";
  if (ours == "pyramid5") return "#ea7fb8";
  if (ours == "pyramid13") return "#a3236f";
  return "#7a7f87";
}

}  // namespace elastogen::selector
