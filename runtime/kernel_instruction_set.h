// The name of the instruction set that kernels are compiled for.
//
// What the headers of kernels and generated headers define lies in an inline namespace of this
// name, so that builds of a kernel for several instruction sets have no symbol in common. Of two
// inline functions of one name a linker keeps either: for all processors that of AVX-512, perhaps.
//
// For the same reason these headers call nothing inline of the standard library, whose names are
// the same in every build: at -O0 such functions are symbols, too.
#pragma once

#ifdef ELASTOGEN_INSTRUCTION_SET
// One of several builds: its functions that return tables end in its name, and the source that
// chooses one (kernel_selection.h) has the plain names.
#define ELASTOGEN_JOIN_EXPANDED(name, set) name##_##set
#define ELASTOGEN_JOIN(name, set) ELASTOGEN_JOIN_EXPANDED(name, set)
#define ELASTOGEN_TABLE_FUNCTION(name) ELASTOGEN_JOIN(name, ELASTOGEN_INSTRUCTION_SET)
#else
// The only build, for whatever its compiler was told.
#define ELASTOGEN_INSTRUCTION_SET native
#define ELASTOGEN_TABLE_FUNCTION(name) name
#endif

#define ELASTOGEN_TEXT_EXPANDED(set) #set
#define ELASTOGEN_TEXT(set) ELASTOGEN_TEXT_EXPANDED(set)

namespace elastogen::kernel {
inline namespace ELASTOGEN_INSTRUCTION_SET {

inline constexpr char instruction_set[] = ELASTOGEN_TEXT(ELASTOGEN_INSTRUCTION_SET);

}  // namespace ELASTOGEN_INSTRUCTION_SET
}  // namespace elastogen::kernel
