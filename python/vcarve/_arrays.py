"""Arrays from users: converted only if every number keeps its value."""
import numpy as np

from ._vcarve import UsageError


def _refuse(name, values, wrong, wanted):
    index = np.argwhere(wrong)[0]
    place = f"[{', '.join(map(str, index))}]" if len(index) else ""
    raise UsageError(f"{name} must be {wanted}, but {name}{place} is {values[tuple(index)]}")


def numbers(name, values, dtype, finite=True):
    """Converts values to an array of a dtype, in C order.

    Raises UsageError with the index of the first value that does not fit: integers must be in the
    range of the dtype, floats and booleans are not integers, and floats must be finite, unless
    `finite` is False. Arrays of uint8 are colors: integers from 0 to 255 are kept, and floats from
    0 to 1 are multiplied by 255.
    """
    values, dtype = np.asarray(values), np.dtype(dtype)
    kind = values.dtype.kind
    if dtype.kind == "f":
        if values.size and kind not in "iuf":
            _refuse(name, values, np.full(values.shape, True), "real numbers")
        with np.errstate(over="ignore"):
            converted = np.ascontiguousarray(values, dtype).reshape(values.shape)
        if finite and not np.isfinite(converted).all():
            _refuse(name, values, ~np.isfinite(converted), "finite")
        return converted
    low, high = np.iinfo(dtype).min, np.iinfo(dtype).max
    wanted = f"integers from {low} to {high}"
    if dtype == np.uint8 and kind == "f":
        wrong = ~((values >= 0.0) & (values <= 1.0))
        if wrong.any():
            _refuse(name, values, wrong, f"{wanted} or floats from 0 to 1")
        return np.rint(values * 255.0).astype(dtype)
    wrong = (values < low) | (values > high) if kind in "iu" else np.full(values.shape, True)
    if wrong.any():
        _refuse(name, values, wrong, wanted)
    return np.ascontiguousarray(values, dtype).reshape(values.shape)


def fill(name, target, values, finite=True):
    """Copies values into an array of a scene. None keeps the array."""
    if values is None:
        return
    values = numbers(name, values, target.dtype, finite)
    if values.shape != target.shape:
        raise UsageError(f"{name} must be an array of shape {target.shape}, not {values.shape}")
    target[...] = values
