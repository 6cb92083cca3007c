"""The methods and their settings, as the library lists them."""
from . import _library

_METHODS = _library.methods()
_TABLES = _library.tables()
# Tables of the part that is loaded at its first use.
_OF_FILES = {"gbuffer": "view_settings", "mesh_visibility": "mesh_point_settings",
             "truth": "truth_settings",
             "read_depth": "depth_file_settings", "volume_picture": "picture_settings"}


def methods():
    """The names of all methods, each with a sentence on what it is."""
    return {name: summary for name, (summary, _, _) in _METHODS.items()}


def settings(name):
    """The settings of a method, or of a function such as "terrain" or "sweep_distance": name ->
    (what it may be, unit, default, what it means)."""
    return {row[0]: (row[2], row[1], row[3], row[4]) for row in rows(name)}


def rows(name):
    """(name, unit, what it may be, default, help, type) of every setting, as the library has them."""
    if name in _METHODS:
        return _METHODS[name][2]
    if name in _OF_FILES and name not in _TABLES:
        from . import _files
        _TABLES[name] = getattr(_files, _OF_FILES[name])()
    if name not in _TABLES:
        raise ValueError(f"there is no method '{name}'; there are {', '.join(_METHODS)}")
    return _TABLES[name]


def as_text(name, given):
    """Settings as the library reads them: pairs of names and texts."""
    known = settings(name)
    pairs = []
    for key, value in given.items():
        if key not in known:
            raise TypeError(f"{name} has no setting '{key}'; it has {', '.join(known)}")
        pairs.append((key, text_of(value)))
    return pairs


def text_of(value):
    """A value as the library reads it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, int)):
        return str(value)
    if isinstance(value, (tuple, list)):
        return ",".join(text_of(v) for v in value)
    return repr(float(value))


def table(name):
    """The settings of a method or function as text, a line each."""
    lines = []
    for key, (expected, unit, default, text) in settings(name).items():
        of = f", {unit}" if unit else ""
        lines.append(f"    {key}: {text} [{expected}{of}; default {default}]")
    return "\n".join(lines)
