"""Eight adjacent numbers at once, in vector instructions for certain.

Of loops over the few strips of a wheel the compiler makes little but remainders, gathers and scatters. What
is written here is one load of each row, products and sums, and one store, whatever stands around.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numpy.typing import NDArray

from hh_exudyn.kernel import CONTRACTION, PLAIN_PYTHON, intrinsic, types

LANES = 8  # numbers of one vector: eight doubles fill the widest registers


def _vector_kernel(added: bool) -> Any:
    """`add_multiples`, or `set_multiples`, compiled."""

    @intrinsic
    def operation(typing_context: Any, other: Any, place: Any, factors: Any, rows: Any, start: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            vector = ir.VectorType(context.get_value_type(types.float64), LANES)
            nothing, number, flags = ir.Constant(vector, ir.Undefined), ir.IntType(32), tuple(CONTRACTION)

            def at(array: Any, kind: Any, index: Any) -> Any:
                data = context.make_array(kind)(context, builder, array).data
                return builder.bitcast(builder.gep(data, [index]), vector.as_pointer())

            target = at(arguments[0], signature.args[0], arguments[1])
            result = builder.load(target, align=8) if added else None
            for k, kind in enumerate(signature.args[3]):
                one = builder.insert_element(nothing, builder.extract_value(arguments[2], k), number(0))
                factor = builder.shuffle_vector(one, nothing, ir.VectorType(number, LANES)([0] * LANES))
                row = at(builder.extract_value(arguments[3], k), kind, arguments[4])
                product = builder.fmul(factor, builder.load(row, align=8), flags=flags)
                result = product if result is None else builder.fadd(result, product, flags=flags)
            builder.store(result, target, align=8)
            return context.get_dummy_value()

        return types.none(other, place, factors, rows, start), generate

    return operation


def _plain_set_multiples(other: NDArray[np.float64], place: int, factors: Any, rows: Any, start: int) -> None:
    terms = zip(factors, rows, strict=True)
    there = slice(int(start), int(start) + LANES)
    other[int(place) : int(place) + LANES] = sum(factor * row[there] for factor, row in terms)


def _plain_add_multiples(other: NDArray[np.float64], place: int, factors: Any, rows: Any, start: int) -> None:
    terms = zip(factors, rows, strict=True)
    there = slice(int(start), int(start) + LANES)
    other[int(place) : int(place) + LANES] += sum(factor * row[there] for factor, row in terms)


# `add_multiples(other, place, factors, rows, start)`: adds to other[place + i] the sum of
# factor * row[start + i] over tuples of factors and rows, for i from 0 to `LANES` - 1, without a look whether
# they exist; `set_multiples` sets.
add_multiples: Callable[..., None]
set_multiples: Callable[..., None]
if PLAIN_PYTHON:
    add_multiples, set_multiples = _plain_add_multiples, _plain_set_multiples
else:
    add_multiples, set_multiples = _vector_kernel(True), _vector_kernel(False)
