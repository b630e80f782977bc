"""Vectors of LANES doubles, integers and truths for jitted functions, with their operators.

For `solver_lanes` alone. LLVM makes machine vectors of them: of what array loops it would.
"""

import operator

from llvmlite import ir
from numba import njit, types
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model

LANES = 8
LONG = ir.IntType(64)


class Vector(types.Type):
    def __init__(self, name, element):
        self.llvm = ir.VectorType(element, LANES)
        super().__init__(name)


F, I, B = Vector("F", ir.DoubleType()), Vector("I", LONG), Vector("B", ir.IntType(1))  # noqa: E741


@register_model(Vector)
class VectorModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, kind.llvm)


def spread(b, value, kind):
    none, first = ir.Constant(kind.llvm, ir.Undefined), ir.Constant(ir.IntType(32), 0)
    order = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return b.shuffle_vector(b.insert_element(none, value, first), none, order)


def define(operation, result, operands, build):
    infer_global(operation)(
        type(
            "Typing", (ConcreteTemplate,), {"cases": [signature(result or operands[0], *operands)]}
        )
    )

    def lower(_, b, sig, args):
        kind = next(kind for kind in sig.args if isinstance(kind, Vector))
        both = [
            value if isinstance(given, Vector) else spread(b, value, kind)
            for value, given in zip(args, sig.args, strict=True)
        ]
        return build(b, *both)

    lower_builtin(operation, *operands)(lower)


for kinds in ((F, F), (F, types.float64), (types.float64, F)):
    define(operator.add, F, kinds, lambda b, x, y: b.fadd(x, y))
    define(operator.sub, F, kinds, lambda b, x, y: b.fsub(x, y))
    define(operator.mul, F, kinds, lambda b, x, y: b.fmul(x, y))
    define(operator.truediv, F, kinds, lambda b, x, y: b.fdiv(x, y))
    for sign, compare in (("<", operator.lt), (">", operator.gt), ("<=", operator.le)):
        define(compare, B, kinds, lambda b, x, y, sign=sign: b.fcmp_ordered(sign, x, y))
define(operator.and_, B, (B, B), lambda b, x, y: b.and_(x, y))
define(operator.or_, B, (B, B), lambda b, x, y: b.or_(x, y))
define(operator.invert, B, (B,), lambda b, x: b.not_(x))


@intrinsic
def floats(_, value):
    return F(types.float64), lambda c, b, sig, args: spread(b, args[0], F)


@intrinsic
def whole(_, first):
    """Lanes first, first + 1, ..."""

    def build(c, b, sig, args):
        return b.add(spread(b, args[0], I), ir.Constant(I.llvm, list(range(LANES))))

    return I(types.int64), build


@intrinsic
def where(_, choice, yes, no):
    return yes(B, yes, yes), lambda c, b, sig, args: b.select(*args)


@intrinsic
def count(_, choice):
    bits = ir.IntType(LANES)
    return types.int64(B), lambda c, b, sig, args: b.zext(b.ctpop(b.bitcast(args[0], bits)), LONG)


@intrinsic
def lane(_, x, k):
    part = types.float64 if x is F else types.int64
    return part(x, types.int64), lambda c, b, sig, args: b.extract_element(*args)


@intrinsic
def root(_, x):
    def build(c, b, sig, args):
        kind = ir.FunctionType(F.llvm, [F.llvm])
        name = f"llvm.sqrt.v{LANES}f64"
        return b.call(b.module.globals.get(name) or ir.Function(b.module, kind, name), args)

    return F(F), build


@intrinsic
def gather(_, a, i):
    def build(c, b, sig, args):
        start = b.ptrtoint(c.make_array(sig.args[0])(c, b, args[0]).data, LONG)
        eight = ir.Constant(I.llvm, [8] * LANES)
        at = ir.VectorType(ir.DoubleType().as_pointer(), LANES)
        kind = ir.FunctionType(F.llvm, [at, ir.IntType(32), B.llvm, F.llvm])
        name = f"llvm.masked.gather.v{LANES}f64.v{LANES}p0f64"
        fetch = b.module.globals.get(name) or ir.Function(b.module, kind, name)
        where_ = b.inttoptr(b.add(spread(b, start, I), b.mul(args[1], eight)), at)
        every, none = ir.Constant(B.llvm, [1] * LANES), ir.Constant(F.llvm, [0.0] * LANES)
        return b.call(fetch, [where_, ir.Constant(ir.IntType(32), 8), every, none])

    return F(a, I), build


@njit(forceinline=True)
def least(x, y):
    return where(x < y, x, y)


@njit(forceinline=True)
def most(x, y):
    return where(x > y, x, y)
