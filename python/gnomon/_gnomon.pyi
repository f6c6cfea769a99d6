from typing import Any

__version__: str

class Error(RuntimeError):
    """Gnomon could not do what it was asked for."""

class InputError(Error, ValueError):
    """An argument, file, study, mesh or shader is missing, malformed or out of range."""

class NoOpenGLError(Error):
    """This machine has no OpenGL 4.5."""

class Surface:
    """A smooth limit surface with texture coordinates. `make_shape`, `read_surface` and
    `make_surface` make it."""

    @property
    def face_count(self) -> int:
        """Faces, each a square of parameters (s, t) from 0 to 1."""

# All else is called by gnomon.arrays and gnomon.results alone, which check and document it.
def __getattr__(name: str) -> Any: ...
