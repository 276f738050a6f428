"""Log and progress of runs."""
import logging

LOG = logging.getLogger("vcarve")


class Listener:
    """Keeps the counts of every stage, logs counts and notes, and reports progress."""

    def __init__(self, progress=None):
        self.counts = {}
        self.progress = progress

    def __call__(self, kind, name, value):
        if kind == "note":
            LOG.warning("%s", name)
            return
        if kind == "end":
            self.counts[name] = value
            LOG.info("%s: %s", name, value)
        if self.progress is not None:
            self.progress(name, {"begin": 0.0, "end": 1.0}.get(kind, value))
