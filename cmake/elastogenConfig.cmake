# find_package(elastogen): the targets
#   elastogen::runtime          what a simulator links
#   elastogen::default_kernels  hooke and stvk on tet4 and hexa8, for every processor of its kind
#   elastogen::elastogen        the program, unless the package was built without the generator
# and elastogen_add_kernels(), for kernels of other laws and elements.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
find_dependency(fmt)
find_dependency(OpenMP COMPONENTS CXX)
include("${CMAKE_CURRENT_LIST_DIR}/elastogenTargets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/ElastogenKernels.cmake")
