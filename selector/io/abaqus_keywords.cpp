#include "selector/io/abaqus_keywords.h"

#include <algorithm>
#include <iterator>

namespace elastogen::selector {
namespace {

constexpr std::string_view silent_keywords[] = {
    // titles, and what is printed
    "HEADING", "PREPRINT", "FILE FORMAT", "MONITOR", "PRINT", "RESTART",
    // output
    "CONTACT FILE", "CONTACT OUTPUT", "CONTACT PRINT", "EL FILE", "EL PRINT", "ELEMENT OUTPUT",
    "ENERGY FILE", "ENERGY OUTPUT", "ENERGY PRINT", "FACE PRINT", "FILE OUTPUT",
    "INCREMENTATION OUTPUT", "NODE FILE", "NODE OUTPUT", "NODE PRINT", "OUTPUT", "SECTION FILE",
    "SECTION PRINT", "TIME POINTS",
    // of a *MATERIAL
    "CONDUCTIVITY", "CREEP", "CYCLIC HARDENING", "DAMAGE EVOLUTION", "DAMAGE INITIATION", "DAMPING",
    "DENSITY", "DEPVAR", "ELASTIC", "EXPANSION", "HYPERELASTIC", "HYPERFOAM", "PLASTIC",
    "SPECIFIC HEAT", "USER MATERIAL", "VISCOELASTIC",
    // of a *SURFACE INTERACTION
    "FRICTION", "SURFACE BEHAVIOR",
    // of a *COUPLING
    "DISTRIBUTING", "KINEMATIC",
    // of a *STEP
    "BUCKLE", "CONTROLS", "COUPLED TEMPERATURE-DISPLACEMENT", "DYNAMIC", "END STEP", "FREQUENCY",
    "HEAT TRANSFER", "MODAL DYNAMIC", "NO ANALYSIS", "SOLUTION TECHNIQUE", "STATIC",
    "STEADY STATE DYNAMICS", "UNCOUPLED TEMPERATURE-DISPLACEMENT", "VISCO"};

}  // namespace

bool is_left_out_silently(std::string_view keyword) {
  return std::find(std::begin(silent_keywords), std::end(silent_keywords), keyword) !=
         std::end(silent_keywords);
}

}  // namespace elastogen::selector
