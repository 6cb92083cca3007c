"""The methods and their settings, as the library lists them."""
from . import _library

_METHODS = _library.methods()


def methods():
    """The names of all methods, each with a sentence on what it is."""
    return {name: summary for name, (summary, _, _) in _METHODS.items()}


def settings(method):
    """The settings of a method: name -> (what it may be, unit, default, what it means)."""
    if method not in _METHODS:
        raise ValueError(f"there is no method '{method}'; there are {', '.join(_METHODS)}")
    return {name: (expected, unit, default, text)
            for name, unit, expected, default, text in _METHODS[method][2]}


def as_text(method, given):
    """Settings as the library reads them: pairs of names and texts."""
    known = settings(method)
    pairs = []
    for name, value in given.items():
        if name not in known:
            raise TypeError(f"{method} has no setting '{name}'; it has {', '.join(known)}")
        pairs.append((name, text_of(value)))
    return pairs


def text_of(value):
    """A value as the library reads it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, int)):
        return str(value)
    return repr(float(value))


def table(method):
    """The settings of a method as text, a line each."""
    rows = []
    for name, (expected, unit, default, text) in settings(method).items():
        of = f", {unit}" if unit else ""
        rows.append(f"    {name}: {text} [{expected}{of}; default {default}]")
    return "\n".join(rows)
