"""The options of the library as keywords: signatures and documentation from the declarations."""
import inspect

from . import _vcarve

DECLARED = _vcarve.declared_options()


def default_of(option):
    """Returns the default as a Python value."""
    text = option["default"]
    if option["kind"] == "flag":
        return text == "yes"
    if option["kind"] in ("float", "int") and text not in option["words"]:
        return float(text) if option["kind"] == "float" else int(text)
    return text or None


def described(option):
    """Returns one line of documentation, not wrapped."""
    said = "True or False" if option["kind"] == "flag" else option["accepted"]
    return f"{option['name']}: {option['help']} Accepts {said}; default {default_of(option)}."


def split(given, group):
    """Splits keywords into two dictionaries: those of the group unless None, and all others."""
    names = {option["name"] for option in DECLARED[group]}
    return ({name: value for name, value in given.items() if name in names and value is not None},
            {name: value for name, value in given.items() if name not in names})


def takes(*groups):
    """Adds the options of the groups to the signature and docstring of a function(**options)."""
    options = [option for group in groups for option in DECLARED[group]]

    def with_options(function):
        signature = inspect.signature(function)
        own = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
        keywords = [inspect.Parameter(option["name"], inspect.Parameter.KEYWORD_ONLY,
                                      default=default_of(option)) for option in options]
        function.__signature__ = signature.replace(parameters=own + keywords)
        function.__doc__ += "\n    Options:\n\n" + "\n".join(
            f"    {described(option)}" for option in options) + "\n"
        return function

    return with_options
