// The bones that engines know compiled once, for float and double.

#include <skelgen/applications/impl/engine_bones.hpp>

namespace skelgen::applications {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Rig<Scalar> with_engine_bones(Rig<Scalar>, const EngineBones&);                                           \
    template Animation<Scalar> with_engine_bones(Animation<Scalar>, const Rig<Scalar>&, const Rig<Scalar>&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::applications
