#!/usr/bin/python3
"""Generates FFCx's code of one law on one element into the current folder.

usage: forms.py LAW ELEMENT

  forces.c, product.c                  by FFCx, its functions renamed
  forces_lanes.cpp, product_lanes.cpp  the same functions with vectors of elements for numbers
  kernels.h                            what the driver has to know of them
"""

import logging
import re
import sys

import basix
import ffcx
import ffcx.compiler
import ffcx.parameters
import numpy
import ufl
from basix.ufl_wrapper import BasixElement

LAWS = ("hooke", "stvk", "neo_hookean")

# Points across the triangle, and along the axis.
PRISM_POINTS = [
    [x, y, 0.5 + side * 0.5 / numpy.sqrt(3)]
    for side in (-1, 1)
    for x, y in ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3))
]

# Quadratures by the degree that they are exact to: FFCx takes Gauss' rules on hexahedra.
# Its nodes are ordered by vertices, edges and faces of its reference cells: `vtk_nodes` says which
# of VTK's nodes they are.
ELEMENTS = {
    "tet4": dict(
        cell="tetrahedron", degree=1, vtk_nodes=[0, 1, 2, 3], quadrature={"quadrature_degree": 1}
    ),
    "tet10": dict(
        cell="tetrahedron",
        degree=2,
        vtk_nodes=[0, 1, 2, 3, 9, 8, 5, 7, 6, 4],
        quadrature={"quadrature_degree": 2},
    ),
    "prism6": dict(
        cell="prism",
        degree=1,
        vtk_nodes=[0, 1, 2, 3, 4, 5],
        quadrature={
            "quadrature_rule": "custom",
            "quadrature_points": numpy.array(PRISM_POINTS),
            "quadrature_weights": numpy.full(6, 1 / 12),
        },
    ),
    "hexa8": dict(
        cell="hexahedron",
        degree=1,
        vtk_nodes=[0, 1, 3, 2, 4, 5, 7, 6],
        quadrature={"quadrature_degree": 3},
    ),
    "hexa20": dict(
        cell="hexahedron",
        degree=2,
        vtk_nodes=[0, 1, 3, 2, 4, 5, 7, 6, 8, 11, 16, 9, 17, 10, 19, 18, 12, 15, 13, 14],
        quadrature={"quadrature_degree": 5},
    ),
}


def nodal_serendipity():
    """The hexahedron of 20 nodes: Basix' own has moments on its edges instead of nodes."""
    cell = basix.CellType.hexahedron
    moments = basix.create_element(
        basix.ElementFamily.serendipity,
        cell,
        2,
        basix.LagrangeVariant.legendre,
        basix.DPCVariant.legendre,
    )
    vertices = basix.geometry(cell)
    middles = [
        [vertices[entity].mean(axis=0, keepdims=True) for entity in entities]
        for entities in basix.topology(cell)
    ]
    has_node = (True, True, False, False)  # vertices, edges, faces, inside
    points = [
        [middle if node else numpy.zeros((0, 3)) for middle in of_dimension]
        for node, of_dimension in zip(has_node, middles)
    ]
    values = [[numpy.ones((len(x), 1, len(x), 1)) for x in of_dimension] for of_dimension in points]
    element = BasixElement(
        basix.create_custom_element(
            cell,
            [],
            moments.wcoeffs,
            points,
            values,
            0,
            basix.MapType.identity,
            False,
            1,
            moments.highest_degree,
        )
    )
    element._variant = "nodal"  # FFCx asks every element of a mesh's geometry for it
    return element


def stress(law, gradient, lam, mu):
    """First Piola-Kirchhoff stress of a displacement gradient."""
    identity = ufl.Identity(3)
    deformation = identity + gradient
    if law == "hooke":
        strain = ufl.sym(gradient)
        return lam * ufl.tr(strain) * identity + 2 * mu * strain
    if law == "stvk":
        strain = (deformation.T * deformation - identity) / 2
        return deformation * (lam * ufl.tr(strain) * identity + 2 * mu * strain)
    inverse = ufl.inv(deformation)
    return mu * deformation + (lam * ufl.ln(ufl.det(deformation)) - mu) * inverse.T


def make_forms(law, element):
    """The energy's derivative, and that one's in a direction."""
    cell = ufl.Cell(element["cell"])
    if element["cell"] == "hexahedron" and element["degree"] == 2:
        field = ufl.VectorElement(nodal_serendipity(), dim=3)
    else:
        field = ufl.VectorElement("Lagrange", cell, element["degree"])
    mesh = ufl.Mesh(field)  # isoparametric
    space = ufl.FunctionSpace(mesh, field)
    displacement = ufl.Coefficient(space)
    direction = ufl.Coefficient(space)
    test = ufl.TestFunction(space)
    lam, mu = ufl.Constant(mesh), ufl.Constant(mesh)
    dx = ufl.dx(metadata=element["quadrature"])
    forces = ufl.inner(stress(law, ufl.grad(displacement), lam, mu), ufl.grad(test)) * dx
    return {"forces": forces, "product": ufl.derivative(forces, displacement, direction)}


def compile_form(name, form):
    """FFCx's C code of a form, its function renamed tabulate_NAME."""
    parameters = ffcx.parameters.get_parameters()
    # The prefix goes into FFCx's names: both codes are linked into one program.
    _, code = ffcx.compiler.compile_ufl_objects([form], {}, prefix=name, parameters=parameters)
    function = re.search(r"void (tabulate_tensor_\w+)\(", code).group(1)
    return code.replace(function, f"tabulate_{name}")


def on_lanes(name, code):
    """The function of compile_form(), its numbers vectors; its tables stay numbers."""
    function = re.search(rf"^void tabulate_{name}\(.*?^}}", code, re.MULTILINE | re.DOTALL).group(0)
    function = function.replace(" restrict ", " __restrict__ ")
    function = re.sub(r"\bdouble (\w+) = 0\.0;", r"double \1 = {};", function)
    function = function.replace(" = {0};", " = {};")
    function = re.sub(r"(?<!static const )\bdouble\b", "Lanes", function)
    return (
        '#include "bench/peers/lanes.h"\n\nusing namespace elastogen::peers;\n\n' + function + "\n"
    )


def depends_on_displacement(code):
    """Whether the first coefficient, the displacement, is one of those that FFCx has kept."""
    kept = re.search(r"original_coefficient_position_\w+\[\d+\] = \{(.*?)\}", code).group(1)
    return 0 in [int(position) for position in kept.split(",")]


def kernels_header(law, name, element, product):
    order = ", ".join(map(str, element["vtk_nodes"]))
    return f"""// Written by forms.py: {law} on {name}.
#pragma once

inline constexpr char ffcx_version[] = "{ffcx.__version__}";
inline constexpr int num_nodes = {len(element["vtk_nodes"])};
/// VTK's numbers of FFCx's nodes
inline constexpr int vtk_nodes[num_nodes] = {{{order}}};
/// A linear law's product needs the direction alone.
inline constexpr bool product_depends_on_displacement = {
        str(depends_on_displacement(product)).lower()};
"""


def write(path, text):
    with open(path, "w") as file:
        file.write(text)


def main():
    law, name = sys.argv[1:]
    if not ffcx.__version__.startswith("0.5."):
        sys.exit(f"written for FFCx 0.5, found {ffcx.__version__}: its interface changes often")
    logging.disable(logging.WARNING)  # UFL warns of any quadrature of one's own
    element = ELEMENTS[name]
    codes = {name: compile_form(name, form) for name, form in make_forms(law, element).items()}
    for operation, code in codes.items():
        write(f"{operation}.c", code)
        write(f"{operation}_lanes.cpp", on_lanes(operation, code))
    write("kernels.h", kernels_header(law, name, element, codes["product"]))


main()
