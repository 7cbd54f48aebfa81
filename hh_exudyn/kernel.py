"""The only importer of numba: decorators of kernels, `kernel_value`, `memory`, `Bundle` of many arrays.

Numba's file cache does not notice when a kernel in ANOTHER file changes, and then runs old code without a
warning. Here the cache folder of a kernel is named by the hash of every source that it can depend on: all
files, in every subfolder, of its own part of the project and of those that part may import (`_PARTS`). Any
change of one starts an empty cache. It lies under the user's cache directory; where that cannot be written,
kernels are compiled in every process and one warning says so. Folders not used for some time are
deleted. Two processes may compile at once, and one may be killed: numba renames whole files into place. A
file that is broken all the same (`_KernelCache`) is compiled anew.

A kernel never raises: it returns a status or NaN, and its caller raises with wheel, time and position.
"""

import hashlib
import math
import os
import pickle
import shutil
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, TypeVar, cast

import numba
import numpy as np
from numba import types as types
from numba.core import cgutils
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.experimental import (
    function_type,  # noqa: F401 (registers the types that `kernel_value` needs)
    structref,
)
from numba.extending import intrinsic as intrinsic
from numba.np.arrayobj import populate_array
from numpy.typing import NDArray

F = TypeVar("F", bound=Callable[..., Any])

PLAIN_PYTHON = bool(numba.config.DISABLE_JIT)  # whether kernels run as plain Python
PLAIN_PYTHON_FACTOR = 200.0 if PLAIN_PYTHON else 1.0  # time of kernels over compiled ones, about

_ROOT = Path(__file__).resolve().parent.parent
_PACKAGES = ("hh_exudyn", "vehicles", "track", "damage")
_BASE = ("hh_exudyn/*.py",)  # this file, constants, units
_CONTACT = ("hh_exudyn/contact/**/*.py",)
_PARTS = {  # part of the project: sources of its kernels beside `_BASE`; for other parts all sources
    "hh_exudyn.contact": _CONTACT,
    "vehicles": ("vehicles/**/*.py", *_CONTACT),
    "track": ("track/**/*.py", *_CONTACT),
    "damage": ("damage/**/*.py", "hh_exudyn/log/**/*.py", *_CONTACT),
    "hh_exudyn.multibody": (
        "hh_exudyn/multibody/**/*.py",
        "hh_exudyn/case/**/*.py",
        "hh_exudyn/log/**/*.py",
        "vehicles/**/*.py",
        "track/**/*.py",
        *_CONTACT,
    ),
}
_EVERYTHING = tuple(f"{package}/**/*.py" for package in _PACKAGES)
_UNUSED_SECONDS = 14 * 24 * 3600.0  # after which a cache folder is deleted
_MOST_FOLDERS = 40  # of these the oldest are deleted earlier, if they have not been used for an hour
_IN_USE_SECONDS = 3600.0


def source_hash(part: str = "") -> str:
    """Hash (hexadecimal, 16 digits) of every source of a part of `_PARTS`, and of numba's version.

    For any other name, or an empty one, of every source of the project.
    """
    digest = hashlib.sha256(numba.__version__.encode())
    patterns = (*_BASE, *_PARTS[part]) if part in _PARTS else _EVERYTHING
    for path in sorted({path for pattern in patterns for path in _ROOT.glob(pattern)}):
        digest.update(path.relative_to(_ROOT).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _part_of(module: str) -> str:
    """The part of `_PARTS` in which a module lies, "" for none."""
    return next((part for part in _PARTS if module == part or module.startswith(part + ".")), "")


@cache
def _cache_base() -> Path | None:
    """Folder of the cache folders; None (after one warning) where it cannot be written."""
    base = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    folder = Path(base) / "hh_exudyn"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f"probe-{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        warnings.warn(
            f"no kernel cache: {folder} cannot be written ({error.strerror}); kernels are compiled anew "
            "in every process. Set XDG_CACHE_HOME to a writable folder.",
            RuntimeWarning,
            stacklevel=2,
        )
        return None
    _prune(folder)
    return folder


def _prune(base: Path) -> None:
    """Delete cache folders that are no longer used, as far as they can be deleted."""
    now = time.time()
    ages = []
    for folder in base.iterdir():
        try:
            ages.append((now - folder.stat().st_mtime, folder))
        except OSError:  # deleted by another process just now
            continue
    ages.sort(key=lambda item: item[0])
    for place, (age, folder) in enumerate(ages):
        if age > _UNUSED_SECONDS or (place >= _MOST_FOLDERS and age > _IN_USE_SECONDS):
            shutil.rmtree(folder, ignore_errors=True)


@cache
def _cache_folder(part: str) -> Path | None:
    """The cache folder of a part, made if necessary and marked as used now."""
    base = _cache_base()
    if base is None:
        return None
    folder = base / source_hash(part)
    try:
        folder.mkdir(exist_ok=True)
        os.utime(folder)
    except OSError as error:
        _warn_once("full", f"no kernel cache: {folder} cannot be made ({error.strerror})")
        return None
    return folder


_warned: set[str] = set()


def _warn_once(what: str, text: str) -> None:
    """One warning a process of a kind."""
    if what not in _warned:
        _warned.add(what)
        warnings.warn(text, RuntimeWarning, stacklevel=4)


class _CheckedFiles(IndexDataCacheFile):
    """Numba's index and data files of one kernel; every data file begins with the hash of its content.

    Machine code with a hole, as a power failure may leave it, could be loaded otherwise, and crash.
    """

    _DIGEST = 16  # bytes

    def _save_data(self, name: str, data: Any) -> None:
        content = self._dump(data)
        with self._open_for_write(self._data_path(name)) as stream:
            stream.write(self._hash(content) + content)

    def _load_data(self, name: str) -> Any:
        stored = Path(self._data_path(name)).read_bytes()
        if self._hash(stored[self._DIGEST :]) != stored[: self._DIGEST]:
            raise ValueError(f"{name} is not what was written")
        return pickle.loads(stored[self._DIGEST :])

    def _hash(self, content: bytes) -> bytes:
        return hashlib.blake2b(content, digest_size=self._DIGEST).digest()


class _KernelCache(FunctionCache):
    """Numba's cache of one kernel, that outlives broken files and full disks.

    What is broken is compiled again, and what cannot be written is not cached. One warning a process says so.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        locator = self._impl.locator
        self._cache_file = _CheckedFiles(
            cache_path=self.cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=locator.get_source_stamp(),
        )

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled kernel for a signature; None where it must be compiled."""
        try:
            return super().load_overload(sig, target_context)
        except Exception as error:  # a broken pickle may raise any
            _warn_once(
                "broken",
                f"the kernel cache in {self.cache_path} is broken ({type(error).__name__}): what is "
                "broken is compiled again",
            )
            with suppress(OSError):
                self.flush()  # an empty index; the data files are written over
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Write a compiled kernel."""
        try:
            super().save_overload(sig, data)
        except OSError as error:
            _warn_once(
                "full",
                f"no kernel cache: {self.cache_path} cannot be written ({error.strerror}); kernels are "
                "compiled anew in every process",
            )


# Code written out for four or eight adjacent numbers becomes vector instructions, which is off by default in
# numba. It changes the order of no sum, so no result.
numba.config.SLP_VECTORIZE = 1
# A product and the sum behind it are rounded once instead of twice (fused multiply-add): an evaluation of a
# vehicle at rest takes 7 to 12 % less, a whole run hardly. No sum changes its order, and no other freedom is
# given to the compiler.
CONTRACTION = {"contract"}


def _compiled(function: F, **options: bool) -> F:
    """The function compiled, with the cache folder of its part."""
    folder = _cache_folder(_part_of(function.__module__))
    if folder is not None:
        numba.config.CACHE_DIR = str(folder)  # numba reads it here, where the function is decorated
    result: Any = numba.njit(error_model="numpy", nogil=True, fastmath=CONTRACTION, **options)(function)
    if folder is not None and not numba.config.DISABLE_JIT:
        try:
            result._cache = _KernelCache(function)  # as `enable_caching` of numba sets its own
        except RuntimeError as error:  # numba can make no file there
            _warn_once("full", f"no kernel cache: {error}")
    return cast(F, result)


def kernel(function: F) -> F:
    """Compile a function to machine code (numba, no Python objects), cached by the hash of their sources.

    It cannot allocate arrays nor return any, and so counts no references to those it takes: the counts of
    the tables that the contact's kernels hand on would take an eighth of the time of a run. Divisions by zero
    give infinities or NaN as in numpy instead of exceptions. Set NUMBA_DISABLE_JIT=1 to run kernels as plain
    Python.
    """
    return _compiled(function, _nrt=False)


def allocating_kernel(function: F) -> F:
    """`kernel` for a function that allocates arrays or opens a `Bundle`.

    It must not call a kernel that returns arrays, alone or in a NamedTuple: those are not counted.
    """
    return _compiled(function, _nrt=True)


def inlined_kernel(function: F) -> F:
    """`kernel` for a function that is always inlined in the kernels that call it.

    For small functions that are called often and take a NamedTuple of tables: every call would copy some
    fifty numbers to the stack and back, which takes longer than the function itself.
    """
    return _compiled(function, forceinline=True, _nrt=False)


class _KernelValue(types.WrapperAddressProtocol):
    """A compiled kernel as a value: the address of its machine code for one signature."""

    def __init__(self, function: Any, signature: Any) -> None:
        self._function, self._signature = function, signature

    def signature(self) -> Any:
        """Signature of the call, for the compilation of kernels that take the value."""
        return self._signature

    def __wrapper_address__(self) -> int:
        compiled = self._function.get_compile_result(self._signature)
        if compiled.signature.return_type != types.none:
            raise TypeError(f"kernel {self._function.py_func.__qualname__} must return nothing")
        address: int = compiled.library.get_pointer_to_function(compiled.fndesc.llvm_cfunc_wrapper_name)
        return address


def kernel_value(function: Callable[..., None], *arguments: Any) -> Any:
    """A kernel as a value that other kernels take as an argument, alone or in a NamedTuple, and call.

    A kernel that takes it is compiled once for all kernels of that signature, and calls them by address: so a
    law of another package runs inside loops that were compiled without it.

    Parameters
    ----------
    function
        The kernel; it returns nothing. Compiled at its first use.
    arguments
        An example of every argument, of its type.
    """
    if numba.config.DISABLE_JIT:
        return function
    return _KernelValue(function, types.none(*(numba.typeof(argument) for argument in arguments)))


@intrinsic(prefer_literal=True)
def _on_stack(typing_context: Any, count: Any) -> Any:
    """Pointer to `count` floats (a constant) on the stack of the calling kernel."""
    if not isinstance(count, types.IntegerLiteral):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        number = context.get_constant(types.intp, count.literal_value)
        slot = cgutils.alloca_once(builder, context.get_value_type(types.float64), size=number)
        slot.align = 64  # a vector register of any processor
        return slot

    return types.CPointer(types.float64)(count), generate


@intrinsic(prefer_literal=True)
def _array_at(typing_context: Any, place: Any, shape: Any) -> Any:
    """Array of a constant shape at a pointer: as `numba.carray`, which needs reference counts."""
    if not all(isinstance(size, types.IntegerLiteral) for size in shape):
        return None
    result = types.Array(types.float64, len(shape), "C")
    sizes = [size.literal_value for size in shape]

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        word = context.get_value_type(types.intp)
        strides = [8 * math.prod(sizes[axis + 1 :]) for axis in range(len(sizes))]
        array = context.make_array(result)(context, builder)
        populate_array(
            array,
            data=builder.bitcast(arguments[0], array.data.type),
            shape=[word(size) for size in sizes],
            strides=[word(stride) for stride in strides],
            itemsize=word(8),
            meminfo=None,
        )
        return array._getvalue()

    return result(place, shape), generate


def _plain_memory(count: int) -> NDArray[np.float64]:
    return np.empty(count)


def _plain_shaped(place: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    return place[: math.prod(shape)].reshape(shape)


# `memory(count)`: uninitialised memory for `count` floats (a constant) on the stack, gone when the kernel
# returns. `shaped(place, shape)`: the array of a constant shape lying there. A shape known to the compiler
# shows which parts cannot overlap, on which vector instructions depend. An array passed to another kernel
# loses its shape: so the memory is passed, and shaped again.
memory: Callable[[int], Any] = _plain_memory if numba.config.DISABLE_JIT else _on_stack
shaped: Callable[[Any, tuple[int, ...]], NDArray[np.float64]] = (
    _plain_shaped if numba.config.DISABLE_JIT else _array_at
)


@structref.register
class _BundleType(types.StructRef):
    """Numba's type of `Bundle`."""

    def preprocess_fields(self, fields: Any) -> Any:
        """Literal types would make every value a type of its own."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class _PlainBundle(NamedTuple):
    """A `Bundle` where kernels run as plain Python."""

    model: Any
    work: Any


class Bundle(structref.StructRefProxy):
    """Two NamedTuples, `model` and `work`, that enter a kernel as one pointer.

    A NamedTuple of arrays is unpacked at every call from Python, a third of a microsecond per array: with
    fifty arrays that is more than the time of all springs of a wagon. Inside a kernel ``bundle.model`` and
    ``bundle.work`` are the tuples themselves.
    """

    def __new__(cls, model: Any, work: Any) -> "Bundle":
        bundle: Any = _PlainBundle(model, work) if numba.config.DISABLE_JIT else _new_bundle(model, work)
        return bundle


structref.define_proxy(Bundle, _BundleType, ["model", "work"])


@allocating_kernel
def _new_bundle(model: Any, work: Any) -> Any:
    """A `Bundle`, made by a cached kernel: the proxy's own constructor would be compiled in every process."""
    return Bundle(model, work)
