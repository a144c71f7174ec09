"""One function, several gears, all from the same source. The only room that talks to Numba, and only when it must.

========================  ==========================================================  =============================
``f(...)``                compiled, releases the GIL, cached on disk                  hot loops, the user's too
``f.at(n)(...)``          compiled, or interpreted while `n` is small and nothing     library calls: a small mesh
                          has been compiled yet                                       never waits for a compiler
``f.interpreted(...)``    plain Python over the same arrays                           debugging, tests
``f.plain``               the bare function with the kernels it calls bare too        handles, vectorised rules
========================  ==========================================================  =============================

A *carrier* is an object whose arrays a kernel may read, write and replace by larger ones. In compiled code it is a
Numba structref; in interpreted code it is an ordinary object with the same attribute names.

::

    circulators . rules . room . natives
       |
    kernels       what is decorated
       |
    carriers      structrefs that compiled code borrows; imports Numba, as does
       |
    compiler      dispatchers, the disk cache
       |
    intrinsics    what Numba has no words for
       |
    loops . plain . fingerprint . arguments . threads . gears
"""

from halfmesh._jit.arguments import Carrier, Views, array_of, lowered, view
from halfmesh._jit.carriers import CarrierAt, CarrierType, declare_carrier
from halfmesh._jit.circulators import Circulator, circulator, declared
from halfmesh._jit.compiler import cache_folder
from halfmesh._jit.gears import compiling_always
from halfmesh._jit.intrinsics import (
    apart,
    bit_count,
    bit_length,
    c_function,
    real_at,
    set_real,
    set_word,
    word_at,
)
from halfmesh._jit.kernels import Kernel, Operation, all_kernels, inline_kernel, kernel, operation, twofold
from halfmesh._jit.natives import Native, Record, are_possible, maker_of, native, record_of, slots_of
from halfmesh._jit.room import filled, grown
from halfmesh._jit.rules import Rule, asking, rule
from halfmesh._jit.threads import in_succession, n_threads, parallel

__all__ = [
    "Carrier",
    "CarrierAt",
    "CarrierType",
    "Circulator",
    "Kernel",
    "Native",
    "Operation",
    "Record",
    "Rule",
    "Views",
    "all_kernels",
    "apart",
    "are_possible",
    "array_of",
    "asking",
    "bit_count",
    "bit_length",
    "c_function",
    "cache_folder",
    "circulator",
    "compiling_always",
    "declare_carrier",
    "declared",
    "filled",
    "grown",
    "in_succession",
    "inline_kernel",
    "kernel",
    "lowered",
    "maker_of",
    "n_threads",
    "native",
    "operation",
    "parallel",
    "real_at",
    "record_of",
    "rule",
    "set_real",
    "set_word",
    "slots_of",
    "twofold",
    "view",
    "word_at",
]
